#include "draw/mesh_levels.h"

#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"

namespace viewcell {
namespace {

// The triangles of a level with the vertices that they use, numbered by first use.
TriMesh extract_level(const TriMesh& mesh, const std::vector<Triangle>& triangles) {
  const std::vector<std::uint32_t> place = make_fetch_order(triangles, mesh.positions.size());
  std::size_t n_used = 0;
  TriMesh out;
  out.triangles.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    out.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
    for (const std::uint32_t v : out.triangles.back())
      n_used = std::max(n_used, static_cast<std::size_t>(v) + 1);
  }
  out.positions.resize(n_used);
  out.normals.resize(n_used);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (place[v] >= n_used) continue;
    out.positions[place[v]] = mesh.positions[v];
    out.normals[place[v]] = mesh.normals[v];
  }
  return out;
}

}  // namespace

TriMesh optimize_order(const TriMesh& mesh) {
  VIEWCELL_CHECK(mesh.normals.size() == mesh.positions.size(), mesh.normals.size(),
                 mesh.positions.size());
  return extract_level(mesh, optimize_index_order(mesh.triangles, mesh.positions.size()));
}

MeshLevels make_single_level(const TriMesh& mesh) {
  MeshLevels levels(1);
  levels[0].mesh = optimize_order(mesh);
  return levels;
}

MeshLevels build_mesh_levels(const TriMesh& mesh, const DetailOptions& options) {
  MeshLevels levels;
  for (const DetailLevel& level : build_meshopt_levels(mesh, options))
    levels.push_back({extract_level(mesh, level.triangles), level.error});
  return levels;
}

std::vector<MeshLevels> build_scene_levels(const Scene& scene, bool with_lod,
                                           const DetailOptions& options, int n_threads) {
  std::vector<MeshLevels> levels(scene.meshes.size());
  parallel_for(scene.meshes.size(), n_threads, [&](std::size_t i) {
    const TriMesh& mesh = scene.meshes[i].mesh;
    levels[i] = with_lod ? build_mesh_levels(mesh, options) : make_single_level(mesh);
  });
  return levels;
}

}  // namespace viewcell

#include "draw/mesh_levels.h"

#include "base/error.h"
#include "base/parallel.h"
#include "mesh/used_vertices.h"

namespace viewcell {
namespace {

// The triangles of a level with the vertices that they use, numbered by first use.
TriMesh extract_level(const TriMesh& mesh, const std::vector<Triangle>& triangles) {
  const UsedVertices used =
      find_used_vertices(triangles, mesh.positions.size(), VertexOrder::first_use);
  TriMesh out;
  out.positions = used.pick(mesh.positions);
  out.normals = used.pick(mesh.normals);
  out.triangles = used.renumber(triangles);
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

MeshLevels build_mesh_levels(const TriMesh& mesh, const DetailOptions& options,
                             const VertexWeld& weld) {
  MeshLevels levels;
  TriMesh welded;
  if (!weld.is_empty())
    welded.positions = mesh.positions, welded.triangles = weld.weld(mesh.triangles);
  for (const DetailLevel& level : build_meshopt_levels(weld.is_empty() ? mesh : welded, options))
    levels.push_back(
        {extract_level(mesh, choose_drawn_vertices(mesh, weld, level.triangles)), level.error});
  if (!weld.is_empty()) levels[0].mesh = optimize_order(mesh);
  return levels;
}

std::vector<MeshLevels> build_scene_levels(const Scene& scene, bool with_lod,
                                           const DetailOptions& options, int n_threads) {
  std::vector<MeshLevels> levels(scene.meshes.size());
  parallel_for(scene.meshes.size(), n_threads, [&](std::size_t i) {
    const SceneMesh& mesh = scene.meshes[i];
    levels[i] =
        with_lod ? build_mesh_levels(mesh.mesh, options, mesh.weld) : make_single_level(mesh.mesh);
  });
  return levels;
}

}  // namespace viewcell

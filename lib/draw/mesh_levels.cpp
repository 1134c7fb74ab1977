#include "draw/mesh_levels.h"

#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"
#include "mesh/used_vertices.h"

namespace viewcell {
namespace {

// The triangles of a level with the vertices that they use, numbered by first use.
MeshLevel extract_level(const TriMesh& mesh, const VertexLooks& looks,
                        std::vector<Triangle> triangles, double error = 0) {
  MeshLevel out;
  out.error = error;
  out.slots = group_by_slot(looks, triangles);
  const UsedVertices used =
      find_used_vertices(triangles, mesh.positions.size(), VertexOrder::first_use);
  out.mesh.positions = used.pick(mesh.positions);
  out.mesh.normals = used.pick(mesh.normals);
  out.mesh.colors = used.pick(mesh.colors);
  out.texcoords = used.pick(looks.texcoords);
  out.mesh.triangles = used.renumber(triangles);
  return out;
}

// Of vertices at one position, only those of the same looks are one.
VertexWeld weld_alike(const VertexWeld& weld, const VertexLooks& looks) {
  if (weld.is_empty() || looks.is_empty()) return weld;
  const auto are_alike = [&](std::uint32_t a, std::uint32_t b) {
    return (looks.texcoords.empty() || looks.texcoords[a] == looks.texcoords[b]) &&
           (looks.slots.empty() || looks.slots[a] == looks.slots[b]);
  };
  VertexWeld out = weld;
  for (std::uint32_t v = 0; v < weld.welded.size(); ++v) out.welded[v] = v;
  for (std::uint32_t v = 0; v < weld.welded.size(); ++v)
    for (const std::uint32_t other : weld.members.of(v)) {
      const auto members = weld.members.of(v);
      out.welded[other] = *std::find_if(members.begin(), members.end(), [&](std::uint32_t first) {
        return are_alike(first, other);
      });
    }
  out.members = fill_buckets<std::uint32_t>(weld.welded.size(), [&](const auto& emit) {
    for (std::uint32_t v = 0; v < weld.welded.size(); ++v)
      for (const std::uint32_t other : weld.members.of(v)) emit(out.welded[other], other);
  });
  return out;
}

}  // namespace

MeshLevel optimize_order(const TriMesh& mesh, const VertexLooks& looks) {
  VIEWCELL_CHECK(mesh.normals.size() == mesh.positions.size(), mesh.normals.size(),
                 mesh.positions.size());
  return extract_level(mesh, looks, optimize_index_order(mesh.triangles, mesh.positions.size()));
}

MeshLevels make_single_level(const TriMesh& mesh, const VertexLooks& looks) {
  return {optimize_order(mesh, looks)};
}

MeshLevels build_mesh_levels(const TriMesh& mesh, const DetailOptions& options,
                             const VertexWeld& weld, const VertexLooks& looks) {
  const VertexWeld alike = weld_alike(weld, looks);
  MeshLevels levels;
  TriMesh welded;
  if (!alike.is_empty())
    welded.positions = mesh.positions, welded.triangles = alike.weld(mesh.triangles);
  for (const DetailLevel& level : build_meshopt_levels(alike.is_empty() ? mesh : welded, options))
    levels.push_back(extract_level(mesh, looks, choose_drawn_vertices(mesh, alike, level.triangles),
                                   level.error));
  if (!alike.is_empty()) levels[0] = optimize_order(mesh, looks);
  return levels;
}

std::vector<MeshLevels> build_scene_levels(const Scene& scene, bool with_lod,
                                           const DetailOptions& options, int n_threads) {
  std::vector<MeshLevels> levels(scene.meshes.size());
  parallel_for(scene.meshes.size(), n_threads, [&](std::size_t i) {
    const SceneMesh& mesh = scene.meshes[i];
    levels[i] = with_lod ? build_mesh_levels(mesh.mesh, options, mesh.weld, mesh.looks)
                         : make_single_level(mesh.mesh, mesh.looks);
  });
  return levels;
}

}  // namespace viewcell

#include "mesh/used_vertices.h"

namespace viewcell {

std::vector<Triangle> UsedVertices::renumber(std::span<const Triangle> triangles) const {
  std::vector<Triangle> out;
  out.reserve(triangles.size());
  for (const Triangle& t : triangles) out.push_back(renumber(t));
  return out;
}

UsedVertices find_used_vertices(std::span<const Triangle> triangles, std::size_t n_vertices,
                                VertexOrder order) {
  UsedVertices out;
  out.new_index.assign(n_vertices, kUnusedVertex);
  const auto number = [&](std::uint32_t v) {
    out.new_index[v] = static_cast<std::uint32_t>(out.source.size());
    out.source.push_back(v);
  };
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) {
      if (out.new_index[v] != kUnusedVertex) continue;
      if (order == VertexOrder::first_use)
        number(v);
      else
        out.new_index[v] = 0;
    }
  for (std::uint32_t v = 0; order == VertexOrder::old && v < n_vertices; ++v)
    if (out.new_index[v] != kUnusedVertex) number(v);
  return out;
}

Box surface_box(const TriMesh& mesh) {
  std::vector<char> is_used(mesh.positions.size(), 0);  // bytes: quicker than bits
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) is_used[v] = 1;
  Box box;
  for (std::size_t v = 0; v < is_used.size(); ++v)
    if (is_used[v]) box.add(mesh.positions[v]);
  return box;
}

CompactMesh compact(const TriMesh& mesh, std::span<const Triangle> triangles) {
  UsedVertices used = find_used_vertices(triangles, mesh.positions.size());
  CompactMesh out;
  out.mesh.positions = used.pick(mesh.positions);
  out.mesh.normals = used.pick(mesh.normals);
  out.mesh.colors = used.pick(mesh.colors);
  out.mesh.triangles = used.renumber(triangles);
  out.mesh.offset = mesh.offset;
  out.source_vertex = std::move(used.source);
  return out;
}

}  // namespace viewcell

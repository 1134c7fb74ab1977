#include "play/ready_cell.h"

#include <cmath>

namespace viewcell {
namespace {

// Bit k: a corner of the box lies on or beyond the line of side face k. What an eye in the cell
// sees through face k lies there, so the test is conservative.
std::uint8_t find_windows(const CellSet& cells, CellId cell, const BundleObject& o) {
  const glm::dvec2 centre = centre_of(cells.grid, coord_of(cells.grid, cell));
  const double apothem = std::sqrt(0.75) * cells.grid.size;
  unsigned windows = 0;
  for (int face = 0; face < 6; ++face) {
    const double angle = glm::radians(30.0 + 60.0 * face);
    const glm::dvec2 normal(std::cos(angle), std::sin(angle));
    const glm::dvec2 farthest(normal.x > 0 ? o.hi[0] : o.lo[0], normal.y > 0 ? o.hi[1] : o.lo[1]);
    if (glm::dot(farthest - centre, normal) >= apothem * (1 - 1e-6)) windows |= 1u << face;
  }
  return static_cast<std::uint8_t>(windows);
}

}  // namespace

ReadyCell make_ready_cell(const Scene& scene, const CellSet& cells, CellId cell,
                          const CellGeometry& g) {
  ReadyCell out;
  out.cell = cell;
  out.origin = eye_of(cells, cell);
  out.vertices.reserve(g.source_vertices.size());
  out.indices.reserve(g.indices.size());
  std::size_t v = 0, i = 0;
  for (const BundleObject& o : g.objects) {
    const SceneObject& object = scene.objects[static_cast<std::size_t>(o.object)];
    const SceneMesh& of_scene = scene.mesh_of(object);
    const TriMesh& mesh = of_scene.mesh;
    const std::vector<glm::vec3>& directions =
        of_scene.weld.is_empty() ? mesh.normals : of_scene.weld.normals;
    const auto first_vertex = static_cast<std::uint32_t>(out.vertices.size());
    out.objects.push_back({ObjectId(o.object), Representation(o.kind),
                           static_cast<std::uint32_t>(out.indices.size()), 3 * o.n_triangles,
                           glm::vec3(o.lo[0], o.lo[1], o.lo[2]),
                           glm::vec3(o.hi[0], o.hi[1], o.hi[2]), find_windows(cells, cell, o)});
    for (std::uint32_t k = 0; k < o.n_vertices; ++k, ++v) {
      const std::uint32_t source = g.source_vertices[v];
      const glm::dvec3 n = object.rotation * glm::dvec3(mesh.normals[source]);
      const glm::dvec3 p =
          object.world_from_model(glm::dvec3(mesh.positions[source])) +
          kOffsetUnit * g.offsets[v] * (object.rotation * glm::dvec3(directions[source]));
      out.vertices.push_back(make_lit_vertex(glm::vec3(p - out.origin), n));
    }
    for (std::uint32_t k = 0; k < 3 * o.n_triangles; ++k, ++i)
      out.indices.push_back(first_vertex + g.indices[i]);
  }
  return out;
}

}  // namespace viewcell

#include "play/ready_cell.h"

#include <algorithm>
#include <cmath>

#include "scene/lighting.h"
#include "scene/surface.h"

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

glm::vec3 lo_of(const BundleObject& o) {
  return {o.lo[0], o.lo[1], o.lo[2]};
}
glm::vec3 hi_of(const BundleObject& o) {
  return {o.hi[0], o.hi[1], o.hi[2]};
}

// An object's vertices: its original's, moved along the surface's normals.
class PlacedVertices {
 public:
  PlacedVertices(const Scene& scene, const SceneObject& object)
      : object_(object),
        mesh_(scene.mesh_of(object).mesh),
        directions_(scene.mesh_of(object).weld.is_empty() ? mesh_.normals
                                                          : scene.mesh_of(object).weld.normals) {}

  glm::dvec3 position(std::uint32_t source, std::int16_t offset) const {
    return object_.world_from_model(glm::dvec3(mesh_.positions[source])) +
           kOffsetUnit * offset * (object_.rotation * glm::dvec3(directions_[source]));
  }
  glm::dvec3 normal(std::uint32_t source) const {
    return object_.rotation * glm::dvec3(mesh_.normals[source]);
  }

 private:
  const SceneObject& object_;
  const TriMesh& mesh_;
  const std::vector<glm::vec3>& directions_;
};

Rgba8 color_of(const Scene& scene, const glm::vec3& base_color, const glm::dvec3& normal) {
  const glm::vec3 lit = srgb_encode(shade(scene.lighting, base_color, glm::vec3(normal)));
  const auto code = [](float x) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.0f, 1.0f)));
  };
  return {code(lit.x), code(lit.y), code(lit.z), 255};
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
    const PlacedVertices placed(scene, object);
    const bool is_unseen = Representation(o.kind) == Representation::unseen;
    std::vector<std::uint32_t>& indices = is_unseen ? out.unseen_indices : out.indices;
    const auto first_vertex =
        static_cast<std::uint32_t>(is_unseen ? out.unseen_vertices.size() : out.vertices.size());
    const auto first_index = static_cast<std::uint32_t>(indices.size());
    const std::uint8_t windows = find_windows(cells, cell, o);
    if (is_unseen)
      out.unseen.push_back({first_index, 3 * o.n_triangles, lo_of(o), hi_of(o), windows});
    else
      out.objects.push_back({ObjectId(o.object), Representation(o.kind), first_index,
                             3 * o.n_triangles, lo_of(o), hi_of(o), windows});
    const glm::vec3 color = mean_color(scene, scene.material_of(object, 0));
    for (std::uint32_t k = 0; k < o.n_vertices; ++k, ++v) {
      const std::uint32_t source = g.source_vertices[v];
      const glm::vec3 p(placed.position(source, g.offsets[v]) - out.origin);
      const glm::dvec3 normal = placed.normal(source);
      if (is_unseen)
        out.unseen_vertices.push_back({p, color_of(scene, color, normal)});
      else
        out.vertices.push_back(make_lit_vertex(p, normal));
    }
    for (std::uint32_t k = 0; k < 3 * o.n_triangles; ++k, ++i)
      indices.push_back(first_vertex + g.indices[i]);
  }
  return out;
}

}  // namespace viewcell

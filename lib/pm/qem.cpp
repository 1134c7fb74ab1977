#include "pm/qem.h"

#include "pm/border_edges.h"

namespace viewcell {
namespace {

// Half the cross product of two sides; at(v): the position of vertex v.
template <typename At>
glm::dvec3 area_vector(const At& at, const Triangle& t) {
  return 0.5 * glm::cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
}

}  // namespace

LargeVector<Quadric> sum_border_planes(const std::vector<BorderEdge>& edges,
                                       std::span<const glm::vec3> positions,
                                       std::span<const Triangle> triangles,
                                       const glm::dvec3& centre, const QemOptions& options) {
  LargeVector<Quadric> quadrics(positions.size());
  const auto at = [&](std::uint32_t v) { return glm::dvec3(positions[v]) - centre; };
  for (const BorderEdge& edge : edges) {
    const glm::dvec3 along = at(edge.b) - at(edge.a);
    const glm::dvec3 across = glm::cross(along, area_vector(at, triangles[edge.triangle]));
    const double length = glm::length(across);
    if (!(length > 0)) continue;
    const double weight =
        options.boundary_weight * (options.area_weighted ? glm::dot(along, along) / 6 : 1);
    for (const std::uint32_t v : {edge.a, edge.b})
      quadrics[v].add_plane(across / length, at(v), weight);
  }
  return quadrics;
}

glm::dvec3 box_centre(std::span<const glm::vec3> positions) {
  Box box;
  for (const glm::vec3& p : positions) box.add(p);
  return positions.empty() ? glm::dvec3(0) : box.centre();
}

QuadricScale make_quadric_scale(std::span<const glm::vec3> positions,
                                std::span<const Triangle> triangles, const QemOptions& options) {
  QuadricScale scale{options.mean};
  if (options.mean || !options.area_weighted) return scale;
  double area = 0;
  const auto at = [&](std::uint32_t v) { return glm::dvec3(positions[v]); };
  for (const Triangle& t : triangles) area += glm::length(area_vector(at, t));
  if (area > 0) scale.whole = area;
  return scale;
}

LargeVector<Quadric> make_boundary_quadrics(std::span<const glm::vec3> positions,
                                            std::span<const Triangle> triangles,
                                            const glm::dvec3& centre, const QemOptions& options) {
  return sum_border_planes(find_border_edges(triangles, positions.size()), positions, triangles,
                           centre, options);
}

LargeVector<Quadric> make_quadrics(std::span<const glm::vec3> positions,
                                   std::span<const Triangle> triangles, const glm::dvec3& centre,
                                   const QemOptions& options) {
  LargeVector<Quadric> quadrics(positions.size());
  const auto at = [&](std::uint32_t v) { return glm::dvec3(positions[v]) - centre; };
  for (const Triangle& t : triangles) {
    const glm::dvec3 normal = area_vector(at, t);
    const double area = glm::length(normal);
    if (!(area > 0)) continue;
    const double weight = options.area_weighted ? area / 3 : 1;
    for (const std::uint32_t v : t) quadrics[v].add_plane(normal / area, at(v), weight);
  }
  const std::vector<BorderEdge> edges = find_border_edges(triangles, positions.size());
  if (edges.empty()) return quadrics;
  const LargeVector<Quadric> boundaries =
      sum_border_planes(edges, positions, triangles, centre, options);
  for (std::size_t v = 0; v < quadrics.size(); ++v) quadrics[v].add(boundaries[v]);
  return quadrics;
}

}  // namespace viewcell

#include "scene/convex2.h"

#include <algorithm>
#include <glm/gtx/exterior_product.hpp>
#include <limits>

#include "mesh/closest_on_segment.h"

namespace viewcell {
namespace {

double cross(const glm::dvec2& o, const glm::dvec2& a, const glm::dvec2& b) {
  return glm::cross(a - o, b - o);
}

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  return glm::length(p - (a + closest_on_segment(p, a, b) * (b - a)));
}

double distance_to_edges(const glm::dvec2& p, const ConvexPolygon& polygon) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i)
    least = std::min(least, distance_to_segment(p, polygon[i], polygon[(i + 1) % polygon.size()]));
  return least;
}

// Whether some edge of `a` has all of `b` strictly outside.
bool is_separated_by_edge_of(const ConvexPolygon& a, const ConvexPolygon& b) {
  for (std::size_t i = 0; a.size() > 2 && i < a.size(); ++i) {
    const glm::dvec2 from = a[i], to = a[(i + 1) % a.size()];
    if (std::all_of(b.begin(), b.end(), [&](const auto& p) { return cross(from, to, p) < 0; }))
      return true;
  }
  return false;
}

}  // namespace

bool contains(const ConvexPolygon& polygon, const glm::dvec2& p) {
  if (polygon.size() < 3) return !polygon.empty() && distance_to_edges(p, polygon) == 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    if (cross(polygon[i], polygon[(i + 1) % polygon.size()], p) < 0) return false;
  return true;
}

// Two convex polygons that do not meet are nearest at a corner of one of them.
double distance(const ConvexPolygon& a, const ConvexPolygon& b) {
  if (a.empty() || b.empty()) return std::numeric_limits<double>::infinity();
  const bool full = a.size() > 2 && b.size() > 2;
  if (full && !is_separated_by_edge_of(a, b) && !is_separated_by_edge_of(b, a)) return 0;
  if (!full && (contains(a, b[0]) || contains(b, a[0]))) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (const glm::dvec2& p : a) least = std::min(least, distance_to_edges(p, b));
  for (const glm::dvec2& p : b) least = std::min(least, distance_to_edges(p, a));
  return least;
}

}  // namespace viewcell

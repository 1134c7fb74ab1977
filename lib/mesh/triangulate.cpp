// Follows: [Hertel83]: a sweep from left to right, which keeps for each stretch of the sweep line
// inside the polygon the chain of corners that it has not got past yet.
// Differs: corners at one position are tied into rings anew first, which takes ways to holes out.
#include "mesh/triangulate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "mesh/sweep_polygon.h"

namespace viewcell {
namespace {

// Twice the polygon's area, by its projections onto the planes x, y and z = 0 [Newell].
glm::dvec3 doubled_areas(std::span<const glm::vec3> corners) {
  glm::dvec3 sum(0);
  const glm::dvec3 origin(corners[0]);
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum += glm::cross(glm::dvec3(corners[k]) - origin, glm::dvec3(corners[k + 1]) - origin);
  return sum;
}

// Along the axis nearest to the normal, which drops a coordinate: the others stay exact. The
// polygon runs counter-clockwise.
std::vector<glm::dvec2> project(std::span<const glm::vec3> corners, const glm::dvec3& areas) {
  const glm::dvec3 size = glm::abs(areas);
  const int along = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  int u = (along + 1) % 3, v = (along + 2) % 3;
  if (areas[along] < 0) std::swap(u, v);
  std::vector<glm::dvec2> out;
  out.reserve(corners.size());
  for (const glm::vec3& p : corners) out.emplace_back(p[u], p[v]);
  return out;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

double reach_of(const glm::dvec2& v) {
  return std::max(std::abs(v.x), std::abs(v.y));
}

// Whether the corners, seen from the first, follow each other counter-clockwise and less than once
// around. What a rounding of the coordinates to floats may have turned counts as straight: polygons
// that are convex in their file stay fans.
bool is_fan(const std::vector<glm::dvec2>& points) {
  double most = 0;
  for (const glm::dvec2& p : points) most = std::max(most, reach_of(p));
  const double slack = 4 * std::ldexp(most, -23);  // lengths; 4: two ends of two directions
  const auto turn = [&](const glm::dvec2& from, const glm::dvec2& to) {
    const double area = cross(from, to);
    return std::abs(area) <= slack * std::max(reach_of(from), reach_of(to)) ? 0 : area;
  };
  glm::dvec2 first(0);
  bool is_past_half = false;
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    const glm::dvec2 from = points[k] - points[0], to = points[k + 1] - points[0];
    if (turn(from, to) < 0) return false;
    if (first == glm::dvec2(0)) first = from;
    const double side = turn(first, to);
    if (side > 0 && is_past_half) return false;
    is_past_half = is_past_half || side < 0;
  }
  return true;
}

double covered(const std::vector<glm::dvec2>& points, std::span<const Triangle> triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles)
    sum += std::abs(cross(points[b] - points[a], points[c] - points[a]));
  return sum;
}

void append_fan(std::size_t n, std::vector<Triangle>& out) {
  for (std::uint32_t k = 1; k + 1 < n; ++k) out.push_back({0, k, k + 1});
}

}  // namespace

PolygonCut triangulate_polygon(std::span<const glm::vec3> corners, std::vector<Triangle>& out) {
  const std::size_t n = corners.size(), old = out.size();
  if (n == 3) return append_fan(n, out), PolygonCut::fan;
  const glm::dvec3 areas = doubled_areas(corners);
  const double area = std::max({std::abs(areas.x), std::abs(areas.y), std::abs(areas.z)});
  if (!(area > 0)) return append_fan(n, out), PolygonCut::crossed;
  const std::vector<glm::dvec2> points = project(corners, areas);
  if (is_fan(points)) return append_fan(n, out), PolygonCut::fan;
  constexpr double kRounding = 1e-7;  // of the area: what sums of it may be off
  if (sweep_polygon(points, out) &&
      std::abs(covered(points, std::span(out).subspan(old)) - area) <= kRounding * area)
    return PolygonCut::sweep;
  out.resize(old);
  append_fan(n, out);
  return PolygonCut::crossed;
}

}  // namespace viewcell

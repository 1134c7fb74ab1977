// Convex hulls of the plane.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <glm/gtx/exterior_product.hpp>
#include <vector>

namespace viewcell {

/// Corners counter-clockwise, from the leftmost on, without collinear points; of points on one line
/// the two ends, of equal ones one. Andrew's monotone chain, in the precision of the points.
/// O(n log n).
template <typename Real>
std::vector<glm::vec<2, Real>> convex_hull(std::vector<glm::vec<2, Real>> points) {
  using Vec2 = glm::vec<2, Real>;
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull;
  const auto turns_left = [&](const Vec2& p) {
    const Vec2 &o = hull.end()[-2], &a = hull.back();
    return glm::cross(a - o, p - o) > 0;
  };
  const auto add_chain = [&](auto first, auto last) {
    const std::size_t start = hull.size();
    for (auto p = first; p != last; ++p) {
      while (hull.size() >= start + 2 && !turns_left(*p)) hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();  // the first of the other chain
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

}  // namespace viewcell

#include "cells/self_occluding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/closest_point.h"

namespace viewcell {
double self_occluding_error_px(double c, double d, double l, double image_res) {
  if (!(d > 0)) return std::numeric_limits<double>::infinity();
  return std::sqrt(3.0) * c * l / (2 * d * (d + l)) * image_res;
}

ObjectDepth measure_depth(const glm::dvec3& eye, std::span<const glm::vec3> positions,
                          std::span<const Triangle> triangles,
                          const std::vector<bool>& is_back_facing) {
  Box box;
  double nearest = std::numeric_limits<double>::infinity();
  const auto at = [&](std::uint32_t v) { return glm::dvec3(positions[v]); };
  const auto for_each_front = [&](auto&& visit) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (!is_back_facing[t]) visit(at(triangles[t][0]), at(triangles[t][1]), at(triangles[t][2]));
  };
  for_each_front([&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    box.add(a), box.add(b), box.add(c);
    nearest = std::min({nearest, glm::length(a - eye), glm::length(b - eye), glm::length(c - eye)});
  });
  // The nearest point of a large triangle may be far from its corners; none of a small one is.
  for_each_front([&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double reach = std::max(glm::length(b - a), glm::length(c - a));
    if (glm::length(a - eye) - reach < nearest)
      nearest = std::min(nearest, glm::distance(eye, closest_point_on_triangle(eye, a, b, c)));
  });
  if (!std::isfinite(nearest)) return {};
  const glm::dvec3 toward = box.centre() - eye;
  const double length = glm::length(toward);
  if (!(length > 0)) return {nearest, glm::length(box.size())};
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  for_each_front([&](const auto&... corners) {
    for (const glm::dvec3& p : {corners...}) {
      const double along = glm::dot(p - eye, toward) / length;
      lo = std::min(lo, along);
      hi = std::max(hi, along);
    }
  });
  return {nearest, hi - lo};
}

double focal_of_face(int resolution_px) {
  return 0.5 * resolution_px / std::tan(glm::radians(30.0));
}

}  // namespace viewcell

#include "cells/self_occluding.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
  const auto for_each_front = [&](auto&& visit) {
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (!is_back_facing[t])
        for (const std::uint32_t v : triangles[t]) visit(glm::dvec3(positions[v]));
  };
  for_each_front([&](const glm::dvec3& p) {
    box.add(p);
    nearest = std::min(nearest, glm::length(p - eye));
  });
  if (!std::isfinite(nearest)) return {};
  const glm::dvec3 toward = box.centre() - eye;
  const double length = glm::length(toward);
  if (!(length > 0)) return {nearest, glm::length(box.size())};
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  for_each_front([&](const glm::dvec3& p) {
    const double along = glm::dot(p - eye, toward) / length;
    lo = std::min(lo, along);
    hi = std::max(hi, along);
  });
  return {nearest, hi - lo};
}

}  // namespace viewcell

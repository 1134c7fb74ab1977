#include "bake/view_metric.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viewcell {

ViewMetric::ViewMetric(const ViewVertices& vertices, std::span<const Triangle> triangles,
                       const ViewMetricOptions& options)
    : vertices_(vertices), options_(options), quadrics_(vertices.positions.size()) {
  const std::size_t n = vertices.positions.size();
  origin_ = n > 0 ? glm::dvec3(vertices.positions[0]) : glm::dvec3(0);
  const auto at = [&](std::uint32_t v) { return glm::dvec3(vertices.positions[v]) - origin_; };
  for (const Triangle& t : triangles) {
    const glm::dvec3 normal = glm::cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
    const double length = glm::length(normal);
    if (!(length > 0)) continue;
    for (const std::uint32_t v : t) quadrics_[v].add_plane(normal / length, at(v), length / 6);
  }
  px_per_unit_.reserve(n);
  for (const glm::vec3& p : vertices.positions) {
    const double distance =
        glm::length(glm::dvec3(p) - options.region_centre) - options.region_radius;
    px_per_unit_.push_back(static_cast<float>(options.focal_px / std::max(distance, 1.0)));
  }
  directions_.reserve(n * options.eyes.size());
  for (const glm::dvec3& eye : options.eyes)
    for (const glm::vec3& p : vertices.positions)
      directions_.emplace_back(options.focal_px * glm::normalize(glm::dvec3(p) - eye));
}

float ViewMetric::projected_length_px(std::uint32_t u, std::uint32_t v) const {
  const std::size_t n = vertices_.positions.size();
  float most = 0;
  for (std::size_t first = 0; first < directions_.size(); first += n) {
    const glm::vec3 d = directions_[first + u] - directions_[first + v];
    most = std::max(most, glm::dot(d, d));
  }
  return std::sqrt(most);
}

double ViewMetric::drift_px(std::uint32_t u, std::uint32_t v) const {
  const glm::dvec3 p = glm::dvec3(vertices_.positions[v]) - origin_;
  const double weight = quadrics_[u].weight + quadrics_[v].weight;
  const double value = quadrics_[u].value(p) + quadrics_[v].value(p);
  if (!(weight > 0)) return 0;
  return std::sqrt(std::max(value, 0.0) / weight) * px_per_unit_[v];
}

float ViewMetric::cost(std::uint32_t u, std::uint32_t v) const {
  constexpr float kNever = std::numeric_limits<float>::infinity();
  if (vertices_.weights[u] > vertices_.weights[v]) return kNever;
  if (options_.keep_common_views) {
    const unsigned a = vertices_.views[u], b = vertices_.views[v];
    if ((a & b) == 0 && (a | b) != 0) return kNever;
  }
  const float away = 1.5f - glm::dot(vertices_.normals[u], vertices_.normals[v]);
  const float cost =
      away * away * projected_length_px(u, v) * (vertices_.weights[u] + vertices_.weights[v]);
  return drift_px(u, v) > options_.max_drift_px ? kNever : cost;
}

// A triangle whose corners share a view must not come to share none (trap 16).
bool ViewMetric::allows(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v) const {
  if (!options_.keep_common_views) return true;
  const auto& views = vertices_.views;
  bool keeps = true;
  mesh.for_each_triangle(u, [&](std::uint32_t a, std::uint32_t b) {
    const unsigned others = views[a] & views[b];
    if (a != v && b != v && (others & views[u]) != 0 && (others & views[v]) == 0) keeps = false;
  });
  return keeps;
}

}  // namespace viewcell

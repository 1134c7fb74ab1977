#include "bake/view_metric.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bake/start_levels.h"
#include "pm/qem.h"

namespace viewcell {
namespace {

// Least distance in averages: an eye nearer to a surface would see nothing else, and must not
// dominate them.
constexpr double kLeastDistance = 5;
// Cosine between normal and line of sight over which a surface comes from edge-on to facing.
constexpr double kEdgeOnWidth = 0.3;
constexpr double kPatchPx = 50;      // area for which drift is the root mean square itself, px^2
constexpr double kOwnShare = 0.5;    // of the drift of what collapses, in that of the whole patch
constexpr float kRimWeight = 0.39f;  // the paper's for silhouettes is 0.4 or 0.5

}  // namespace

ViewMetric::ViewMetric(const ViewVertices& vertices, std::span<const Triangle> triangles,
                       const ViewMetricOptions& options)
    : vertices_(vertices),
      options_(options),
      origin_(vertices.positions.empty() ? glm::dvec3(0) : glm::dvec3(vertices.positions[0])),
      quadrics_(vertices.positions.size()) {
  add_views();
  add_quadrics(triangles);
  if (options.has_rim) add_rims(triangles);
  find_small_parts(triangles);
}

// Planes through the edges of rims at right angles to their triangles; a rim that no view shows may
// go as it likes.
void ViewMetric::add_rims(std::span<const Triangle> triangles) {
  rims_ = make_boundary_quadrics(vertices_.positions, triangles, origin_, {});
  for (std::size_t v = 0; v < rims_.size(); ++v)
    if (vertices_.views[v] == 0) rims_[v] = {};
}

void ViewMetric::find_small_parts(std::span<const Triangle> triangles) {
  std::vector<double> px(options_.part_diagonals.begin(), options_.part_diagonals.end());
  std::vector<float> scale(px.size(), 0);
  std::vector<bool> is_shown(px.size(), false);
  for (std::size_t v = 0; v < options_.parts.size(); ++v) {
    const std::uint32_t part = options_.parts[v];
    scale[part] = std::max(scale[part], px_per_unit_[v]);
    if (vertices_.views[v] != 0) is_shown[part] = true;
  }
  std::vector<bool> small(px.size());
  bool any = false;
  for (std::size_t p = 0; p < px.size(); ++p) {
    small[p] = is_shown[p] && px[p] * scale[p] < kSmallPart * options_.max_drift_px;
    any |= small[p];
  }
  if (!any) return;
  is_small_part_ = std::move(small);
  for (const Triangle& t : triangles)
    if (is_small(t[0])) most_lost_px2_ += kMostLost * area_px2(t[0], t[1], t[2]);
}

double ViewMetric::area_px2(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  const glm::dvec3 at(vertices_.positions[a]);
  const glm::dvec3 across =
      glm::cross(glm::dvec3(vertices_.positions[b]) - at, glm::dvec3(vertices_.positions[c]) - at);
  return 0.5 * glm::length(across) * px_per_unit_[a] * px_per_unit_[a];
}

// What the star of u covers less when it collapses into v, by its area, whichever way it faces.
double ViewMetric::loss_px2(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v) const {
  double loss = 0;
  mesh.for_each_triangle(u, [&](std::uint32_t a, std::uint32_t b) {
    loss += area_px2(u, a, b);
    if (a != v && b != v) loss -= area_px2(v, a, b);
  });
  return loss;
}

void ViewMetric::add_quadrics(std::span<const Triangle> triangles) {
  const auto at = [&](std::uint32_t v) { return glm::dvec3(vertices_.positions[v]) - origin_; };
  for (const Triangle& t : triangles) {
    const glm::dvec3 normal = glm::cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
    const double length = glm::length(normal);
    if (!(length > 0)) continue;
    for (const std::uint32_t v : t) {
      // weight: area * show; value: distance^2 * area * show^2
      Quadric plane;
      plane.add_plane(normal / length, at(v), length / 6 * show_[v] * show_[v]);
      plane.weight = length / 6 * show_[v];
      quadrics_[v].add(plane);
    }
  }
}

void ViewMetric::add_views() {
  const std::size_t n = vertices_.positions.size();
  px_per_unit_.reserve(n), directions_.reserve(n), spread_.reserve(n), show_.reserve(n);
  for (std::size_t v = 0; v < n; ++v) {
    const glm::dvec3 p(vertices_.positions[v]);
    double sum = 0;  // of 1 / distance^2
    for (const glm::dvec3& eye : options_.samples)
      sum += 1 / std::max(glm::dot(p - eye, p - eye), kLeastDistance * kLeastDistance);
    const double inverse = std::sqrt(sum / static_cast<double>(options_.samples.size()));
    px_per_unit_.push_back(static_cast<float>(options_.focal_px * inverse));
    const glm::dvec3 direction = glm::normalize(p - options_.centre);
    const double spread =
        std::min(1.0, options_.radius / std::max(glm::length(p - options_.centre), 1e-9));
    directions_.emplace_back(direction);
    spread_.push_back(static_cast<float>(spread));
    const double facing = std::abs(glm::dot(direction, glm::dvec3(vertices_.normals[v])));
    const double parallax = std::min(1.0, 0.5 * options_.radius * inverse);
    const double edge_on = std::clamp(1 - (facing - spread) / kEdgeOnWidth, 0.0, 1.0);
    const double rim = vertices_.weights[v] >= kRimWeight ? 1.0 : 0.0;
    show_.push_back(static_cast<float>(std::max({edge_on * edge_on, parallax, rim})));
  }
}

// The edge's projected length: perpendicular to the line of sight, and of the part along it what
// other points of the cell see (root of the sum of squares).
float ViewMetric::projected_length_px(std::uint32_t u, std::uint32_t v) const {
  const glm::vec3 edge = vertices_.positions[v] - vertices_.positions[u];
  const float along = glm::dot(edge, directions_[u]);
  const float squared = std::max(glm::dot(edge, edge) - along * along, 0.0f);
  const float turned = along * spread_[u];
  return px_per_unit_[u] * std::sqrt(squared + turned * turned);
}

double ViewMetric::drift_px(std::uint32_t u, std::uint32_t v) const {
  const glm::dvec3 p = glm::dvec3(vertices_.positions[v]) - origin_;
  const auto rms_px = [&](double value, double weight) {
    return weight > 0 ? std::sqrt(std::max(value, 0.0) / weight) * px_per_unit_[v] : 0.0;
  };
  const double of_u = quadrics_[u].value(p);
  const double weight = quadrics_[u].weight + quadrics_[v].weight;
  const double area_px = weight * px_per_unit_[v] * px_per_unit_[v];
  const double of_patch = std::max(
      rms_px(of_u + quadrics_[v].value(p), weight) * std::sqrt(std::sqrt(area_px / kPatchPx)),
      kOwnShare * rms_px(of_u, quadrics_[u].weight));
  if (rims_.empty() || !(rims_[u].weight > 0)) return of_patch;
  const double of_rim = rims_[u].value(p);
  return std::max({of_patch, kOwnShare * rms_px(of_rim, rims_[u].weight),
                   rms_px(of_rim + rims_[v].value(p), rims_[u].weight + rims_[v].weight)});
}

float ViewMetric::cost(std::uint32_t u, std::uint32_t v) const {
  constexpr float kNever = std::numeric_limits<float>::infinity();
  if (vertices_.weights[u] > vertices_.weights[v]) return kNever;
  if (!options_.is_shared.empty() && options_.is_shared[u]) return kNever;
  if (options_.keep_common_views) {
    const unsigned a = vertices_.views[u], b = vertices_.views[v];
    if ((a & b) == 0 && (a | b) != 0) return kNever;
  }
  const float away = 1.5f - glm::dot(vertices_.normals[u], vertices_.normals[v]);
  const float paper =
      away * away * projected_length_px(u, v) * (vertices_.weights[u] + vertices_.weights[v]);
  const double drift = options_.tl_px * drift_px(u, v) / options_.max_drift_px;
  return std::max(paper, static_cast<float>(drift));
}

// The least of a quadric on a line p + t n: its derivative is linear in t.
float ViewMetric::offset(std::uint32_t v) const {
  if (!options_.is_shared.empty() && options_.is_shared[v]) return 0;
  const Quadric& q = quadrics_[v];
  const glm::dvec3 n(vertices_.normals[v]);
  const glm::dvec3 p = glm::dvec3(vertices_.positions[v]) - origin_;
  const double curvature = q.value(p + n) + q.value(p - n) - 2 * q.value(p);
  if (!(curvature > 1e-6 * q.weight)) return 0;
  const double t = (q.value(p - n) - q.value(p + n)) / (2 * curvature);
  const double most = options_.max_drift_px / px_per_unit_[v];
  return static_cast<float>(std::clamp(t, -most, most));
}

bool ViewMetric::allows(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v) const {
  if (!keeps_common_views(mesh, u, v)) return false;
  asked_px2_ = 0;
  if ((vertices_.views[u] | vertices_.views[v]) != 0 && mesh.is_lone_triangle(u, v)) return false;
  if (!is_small(u)) return true;
  asked_px2_ = loss_px2(mesh, u, v);
  return lost_px2_ + asked_px2_ <= most_lost_px2_;
}

// A triangle whose corners share a view must not come to share none: no view could texture it.
bool ViewMetric::keeps_common_views(const CollapseMesh& mesh, std::uint32_t u,
                                    std::uint32_t v) const {
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

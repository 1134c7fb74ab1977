#include "play/hybrid_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/gtx/exterior_product.hpp>
#include <optional>

namespace viewcell {
namespace {

// Lower bound of an angle, so that weight 1 / angle stays finite.
constexpr double kLeastAngle_rad = 2e-5;

// Of the two views' weights about a half.
constexpr double kContrast = 1.5;

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Half the widest azimuth from the camera's that some ray of the frame has; pi when the frame holds
// a vertical direction or nearly.
double half_azimuth_rad(const Camera& camera) {
  const double up = std::tan(glm::radians(camera.fov_y_deg) / 2), side = up * camera.aspect;
  const PictureAxes axes = picture_axes(camera.forward);
  const glm::dvec2 ahead = glm::normalize(glm::dvec2(camera.forward));
  double widest = 0;
  for (const double y : {-up, up}) {
    const glm::dvec2 ray(camera.forward + side * axes.right + y * axes.up);
    const double along = glm::dot(ray, ahead);
    if (along < 0.05) return 3.2;
    widest = std::max(widest, std::atan2(std::abs(glm::cross(ray, ahead)), along));
  }
  return widest;
}

// slots ascending when they come: ties stay in that order.
template <typename Draw>
std::vector<Draw> front_to_back(std::vector<std::pair<double, Draw>> draws) {
  std::stable_sort(draws.begin(), draws.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Draw> out;
  for (const auto& [distance, draw] : draws) out.push_back(draw);
  return out;
}

// By windows first, then by the frustum.
class Culling {
 public:
  Culling(const CellSet& cells, CellId cell, const Camera& camera)
      : frustum_(make_frustum(camera)),
        windows_(find_visible_windows(cells.grid, cell, camera)),
        eye_(camera.eye) {}

  const Frustum& frustum() const { return frustum_; }
  // The distance of the box' middle; nothing where the frame shows none of it.
  template <typename Object>
  std::optional<double> find(const Object& o) const {
    if (o.n_indices == 0 || (o.windows & windows_) == 0) return {};
    const Box box{glm::dvec3(o.lo), glm::dvec3(o.hi)};
    if (!may_meet(frustum_, make_corners(box))) return {};
    return glm::distance(eye_, box.centre());
  }

 private:
  Frustum frustum_;
  std::uint8_t windows_;
  glm::dvec3 eye_;
};

}  // namespace

ViewChoice choose_views(const glm::dvec3& eye, const glm::dvec3& middle,
                        const std::array<glm::dvec3, kViews>& centres, unsigned available) {
  std::vector<std::pair<double, int>> order;
  for (int k = 0; k < kViews; ++k)
    if (available >> k & 1)
      order.emplace_back(
          angle_between(eye - middle, centres[static_cast<std::size_t>(k)] - middle) +
              kLeastAngle_rad,
          k);
  std::sort(order.begin(), order.end());
  const std::size_t n = order.size();
  ViewChoice choice;
  for (std::size_t i = 0; i < std::min<std::size_t>(n, 2); ++i) choice.view[i] = order[i].second;
  if (n < 2) return choice;
  const double third = n > 2 ? 1 / order[2].first : 0;
  const double a = 1 / order[0].first - third, b = 1 / order[1].first - third;
  const double sum = a + b;
  const double share = sum > 0 ? a / sum : 0.5;
  choice.weight[0] = static_cast<float>(std::min(1.0, 0.5 + kContrast * (share - 0.5)));
  choice.weight[1] = 1 - choice.weight[0];
  return choice;
}

std::uint8_t find_visible_windows(const HexGrid& grid, CellId cell, const Camera& camera) {
  const double half = half_azimuth_rad(camera);
  if (half >= glm::radians(90.0)) return 0x3f;
  const glm::dvec2 eye(camera.eye), ahead = glm::normalize(glm::dvec2(camera.forward));
  const ConvexPolygon corners = corners_of(grid, coord_of(grid, cell));
  unsigned visible = 0;
  for (std::size_t face = 0; face < 6; ++face) {
    // Face k joins corners k and k + 1. It is out of sight when both lie outside the same side of
    // the wedge.
    const auto outside = [&](double sign) {
      const double c = std::cos(half), s = sign * std::sin(half);
      const glm::dvec2 edge(c * ahead.x - s * ahead.y, s * ahead.x + c * ahead.y);
      const auto beyond = [&](const glm::dvec2& p) {
        const glm::dvec2 d = p - eye;
        return sign * glm::cross(edge, d) > 1e-9 * grid.size;
      };
      return beyond(corners[face]) && beyond(corners[(face + 1) % 6]);
    };
    if (!outside(1) && !outside(-1)) visible |= 1u << face;
  }
  return static_cast<std::uint8_t>(visible);
}

HybridPlan plan_hybrid(const PlanScene& scene, const CellSet& cells, const ReadyCell& cell,
                       const ViewsAvailable& views, const Camera& camera) {
  HybridPlan plan;
  const Culling culling(cells, cell.cell, camera);
  std::array<glm::dvec3, kViews> centres;
  const auto ids = views_of(cells.grid, cell.cell);
  for (std::size_t k = 0; k < ids.size(); ++k) centres[k] = eye_of(cells, ids[k]);

  std::vector<std::pair<double, HybridDraw>> draws;
  for (std::size_t slot = 0; slot < cell.objects.size(); ++slot) {
    const ReadyObject& o = cell.objects[slot];
    const std::optional<double> distance = culling.find(o);
    if (!distance) continue;
    const glm::dvec3 middle = Box{glm::dvec3(o.lo), glm::dvec3(o.hi)}.centre();
    const bool is_single = o.kind == Representation::single_view;
    const unsigned available = views[slot] & (is_single ? 1u : 0x7fu);
    const HybridDraw draw{static_cast<std::uint16_t>(slot),
                          choose_views(camera.eye, middle, centres, available)};
    draws.emplace_back(*distance, draw);
    plan.n_triangles += o.n_indices / 3;
  }
  plan.outside = front_to_back(std::move(draws));
  std::vector<std::pair<double, std::uint16_t>> unseen;
  for (std::size_t slot = 0; slot < cell.unseen.size(); ++slot) {
    const std::optional<double> distance = culling.find(cell.unseen[slot]);
    if (!distance) continue;
    unseen.emplace_back(*distance, static_cast<std::uint16_t>(slot));
    plan.n_triangles += cell.unseen[slot].n_indices / 3;
  }
  plan.unseen = front_to_back(std::move(unseen));
  plan.originals = select_visible(scene, culling.frustum(), camera, originals_of(cells, cell.cell));
  return plan;
}

}  // namespace viewcell

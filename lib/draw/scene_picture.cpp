#include "draw/scene_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "draw/frame_plan.h"

namespace viewcell {
namespace {

constexpr double kMargin = 1.04;
constexpr double kBehind = 1e-6;  // of clip w: nearer is behind the eye

// The part of a segment that is before the eye.
std::optional<std::pair<glm::dvec4, glm::dvec4>> cut_behind(glm::dvec4 a, glm::dvec4 b) {
  if (a.w < kBehind && b.w < kBehind) return {};
  if (a.w < kBehind) a = glm::mix(a, b, (kBehind - a.w) / (b.w - a.w));
  if (b.w < kBehind) b = glm::mix(b, a, (kBehind - b.w) / (a.w - b.w));
  return std::pair(a, b);
}

// The part of a segment in the rectangle from 0 to size, widened by a margin [Liang 1984].
bool cut_outside(glm::dvec2& a, glm::dvec2& b, const glm::dvec2& size, double margin) {
  const glm::dvec2 along = b - a;
  double from = 0, to = 1;
  for (int axis = 0; axis < 2; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const double edge = side < 0 ? margin : size[axis] + margin;
      const double step = side * along[axis], room = edge - side * a[axis];
      if (step == 0 && room < 0) return false;
      if (step > 0) to = std::min(to, room / step);
      if (step < 0) from = std::max(from, room / step);
    }
  if (!(from < to)) return false;
  b = a + to * along, a = a + from * along;
  return true;
}

// Each pixel as much as its middle is near the segment.
void draw_segment(ImageRgba8& image, const glm::dvec2& a, const glm::dvec2& b, const Rgba8& color,
                  double width_px) {
  const double reach = 0.5 * width_px + 1, length2 = glm::dot(b - a, b - a);
  const auto pixels = [&](double from, double to, int n) {
    return std::pair(std::clamp(static_cast<int>(std::floor(from - reach)), 0, n),
                     std::clamp(static_cast<int>(std::ceil(to + reach)), 0, n));
  };
  const auto [y0, y1] = pixels(std::min(a.y, b.y), std::max(a.y, b.y), image.height_px);
  for (int y = y0; y < y1; ++y) {
    // The stretch of the row that may be near: where the segment is within reach in height.
    double lo = std::min(a.x, b.x), hi = std::max(a.x, b.x);
    if (std::abs(b.y - a.y) > 1) {
      const auto x_at = [&](double height) {
        return a.x + std::clamp((height - a.y) / (b.y - a.y), 0.0, 1.0) * (b.x - a.x);
      };
      const double x_above = x_at(y + 0.5 - 2 * reach), x_below = x_at(y + 0.5 + 2 * reach);
      lo = std::min(x_above, x_below), hi = std::max(x_above, x_below);
    }
    const auto [x0, x1] = pixels(lo - reach, hi + reach, image.width_px);
    for (int x = x0; x < x1; ++x) {
      const glm::dvec2 p(x + 0.5, y + 0.5);
      const double t = length2 > 0 ? std::clamp(glm::dot(p - a, b - a) / length2, 0.0, 1.0) : 0;
      const double away = glm::distance(p, a + t * (b - a));
      const double share = std::clamp(0.5 * width_px + 0.5 - away, 0.0, 1.0) * color[3] / 255;
      Rgba8& pixel = image.at(x, y);
      for (std::size_t c = 0; c < 3; ++c)
        pixel[c] = static_cast<std::uint8_t>(
            std::lround(pixel[c] + share * (double(color[c]) - pixel[c])));
    }
  }
}

}  // namespace

Camera look_from_corner(const Box& box, double fov_y_deg, double aspect) {
  const double azimuth = glm::radians(50.0), elevation = glm::radians(35.0);
  Camera camera = with_frame({}, fov_y_deg, aspect);  // its eye at the origin
  camera.forward = {std::cos(elevation) * std::cos(azimuth),
                    std::cos(elevation) * std::sin(azimuth), -std::sin(elevation)};
  // In axes of the picture a corner is in the frame when |x - eye.x| <= slope (z - eye.z), and so
  // in y: the eye is where the outermost planes of such slopes meet.
  const PictureAxes axes = picture_axes(camera.forward);
  const double half = std::tan(glm::radians(fov_y_deg) / 2) / kMargin;
  double depth = 1e300;
  for (const auto& [axis, slope] : {std::pair(axes.right, aspect * half), {axes.up, half}}) {
    double above = -1e300, below = -1e300;
    for (const glm::dvec3& corner : make_corners(box)) {
      const double along = slope * glm::dot(corner, camera.forward), aside = glm::dot(corner, axis);
      above = std::max(above, aside - along), below = std::max(below, -aside - along);
    }
    camera.eye += 0.5 * (above - below) * axis;
    depth = std::min(depth, -0.5 * (above + below) / slope);
  }
  camera.eye += depth * camera.forward;
  return camera;
}

glm::dmat4 clip_from_above(const Box& box, double aspect) {
  const glm::dvec3 size = glm::max(box.size(), glm::dvec3(1e-9)), middle = box.centre();
  const double half_height = 0.5 * kMargin * std::max(size.y, size.x / aspect);
  const glm::dvec3 scale(1 / (aspect * half_height), 1 / half_height, 0.9 / size.z);
  glm::dmat4 clip(1);
  for (int axis = 0; axis < 3; ++axis) clip[axis][axis] = scale[axis];
  clip[3] = glm::dvec4(-scale.x * middle.x, -scale.y * middle.y, 0.05 - scale.z * box.lo.z, 1);
  return clip;
}

void draw_over(ImageRgba8& image, const glm::dmat4& clip_from_world,
               std::span<const glm::dvec3> points, bool is_closed, const Rgba8& color,
               double width_px) {
  const glm::dvec2 size(image.width_px, image.height_px);
  const std::size_t n = points.size();
  const auto clip = [&](std::size_t i) { return clip_from_world * glm::dvec4(points[i % n], 1); };
  const auto pixel = [&](const glm::dvec4& p) {
    return 0.5 * size * glm::dvec2(1 + p.x / p.w, 1 - p.y / p.w);
  };
  for (std::size_t i = 0; i + (is_closed ? 0 : 1) < n; ++i) {
    const auto seen = cut_behind(clip(i), clip(i + 1));
    if (!seen) continue;
    glm::dvec2 a = pixel(seen->first), b = pixel(seen->second);
    if (cut_outside(a, b, size, width_px)) draw_segment(image, a, b, color, width_px);
  }
}

}  // namespace viewcell

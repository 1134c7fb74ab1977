#include "capture/categories.h"

#include <algorithm>
#include <cmath>

namespace viewcell {
namespace {

// Window-depth-like value along a row or column: larger is nearer. Steps of (dx, dy).
struct Line {
  const CaptureTile& tile;
  double near;
  int dx, dy;

  bool is_seen(int x, int y, int step) const {
    const int i = x + step * dx, j = y + step * dy;
    return i >= 0 && j >= 0 && i < tile.crop.width_px && j < tile.crop.height_px &&
           tile.is_seen(i, j);
  }
  double value(int x, int y, int step) const {
    return near * static_cast<double>(tile.inverse_depth.at(x + step * dx, y + step * dy));
  }
};

// How far the step from (x, y) to its next pixel departs from what the slope on either side says.
double jump(const Line& line, int x, int y) {
  const double here = line.value(x, y, 0), next = line.value(x, y, 1);
  double least = std::abs(next - here);
  if (line.is_seen(x, y, -1))
    least = std::min(least, std::abs(next - (2 * here - line.value(x, y, -1))));
  if (line.is_seen(x, y, 2))
    least = std::min(least, std::abs(here - (2 * next - line.value(x, y, 2))));
  return least;
}

PixelCategory classify_along(const Line& line, int x, int y, const CategoryOptions& options) {
  const bool before = line.is_seen(x, y, -1), after = line.is_seen(x, y, 1);
  if (!before || !after) return PixelCategory::exterior_silhouette;
  const double here = line.value(x, y, 0);
  const double last = line.value(x, y, -1), next = line.value(x, y, 1);
  const Line back{line.tile, line.near, -line.dx, -line.dy};
  if ((here > next && jump(line, x, y) > options.tc0) ||
      (here > last && jump(back, x, y) > options.tc0))
    return PixelCategory::interior_silhouette;
  if (std::abs(last - 2 * here + next) > options.tc1) return PixelCategory::sharp_edge;
  return PixelCategory::interior;
}

}  // namespace

Image<PixelCategory> classify_pixels(const CaptureTile& tile, const CategoryOptions& options) {
  Image<PixelCategory> out(tile.crop.width_px, tile.crop.height_px, PixelCategory::background);
  const Line rows{tile, options.near, 1, 0}, columns{tile, options.near, 0, 1};
  for (int y = 0; y < out.height_px; ++y)
    for (int x = 0; x < out.width_px; ++x)
      if (tile.is_seen(x, y))
        out.at(x, y) =
            std::max(classify_along(rows, x, y, options), classify_along(columns, x, y, options));
  return out;
}

}  // namespace viewcell

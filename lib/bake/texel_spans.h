// Which texels of a texture lie in a triangle, and fetches between texels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "image/image.h"

namespace viewcell {

/// Texture coordinates as places in an image: texel centres at whole numbers, rows down, v up.
inline glm::dvec2 to_texels(const glm::vec2& uv, int width_px, int height_px) {
  return {uv.x * double(width_px) - 0.5, (1 - double(uv.y)) * height_px - 0.5};
}

/// x where an edge crosses a row; to the bit the same for both triangles at the edge.
inline double cross_row(glm::dvec2 a, glm::dvec2 b, double y) {
  if (b.y < a.y || (b.y == a.y && b.x < a.x)) std::swap(a, b);
  return a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
}

/// Calls visit(x0, x1, y) for the texels [x0, x1) of each row whose centres lie in the triangle p,
/// given as to_texels gives it. Triangles that share an edge, to the bit, share no texel and leave
/// none out. What lies outside the image is left out; so is a triangle that is not finite.
template <typename Visit>
void for_each_span(const std::array<glm::dvec2, 3>& p, int width_px, int height_px, Visit&& visit) {
  for (const glm::dvec2& corner : p)
    if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) return;
  const double width = width_px, height = height_px;
  const double top = std::min({p[0].y, p[1].y, p[2].y});
  const double bottom = std::max({p[0].y, p[1].y, p[2].y});
  const int first = static_cast<int>(std::clamp(std::ceil(top), 0.0, height));
  const int last = static_cast<int>(std::clamp(std::ceil(bottom), 0.0, height));
  for (int y = first; y < last; ++y) {
    double lo = 1e300, hi = -1e300;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2 &a = p[k], &b = p[(k + 1) % 3];
      if ((a.y <= y) == (b.y <= y)) continue;
      const double x = cross_row(a, b, y);
      lo = std::min(lo, x), hi = std::max(hi, x);
    }
    const int x0 = static_cast<int>(std::clamp(std::ceil(lo), 0.0, width));
    const int x1 = static_cast<int>(std::clamp(std::ceil(hi), 0.0, width));
    if (x0 < x1) visit(x0, x1, y);
  }
}

/// The four texels around a place, in the order (x0, y0), (x1, y0), (x0, y1), (x1, y1), and their
/// bilinear weights, which sum to 1. Beyond its rim an image goes on as it ends.
struct BilinearTexels {
  std::array<std::size_t, 4> offsets;
  std::array<float, 4> weights;
};

template <typename Pixel>
BilinearTexels bilinear_texels(const Image<Pixel>& image, const glm::dvec2& at) {
  const double x = std::clamp(at.x, 0.0, image.width_px - 1.0);
  const double y = std::clamp(at.y, 0.0, image.height_px - 1.0);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, image.width_px - 1), y1 = std::min(y0 + 1, image.height_px - 1);
  const auto s = static_cast<float>(x - x0), t = static_cast<float>(y - y0);
  return {{image.offset(x0, y0), image.offset(x1, y0), image.offset(x0, y1), image.offset(x1, y1)},
          {(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t}};
}

}  // namespace viewcell

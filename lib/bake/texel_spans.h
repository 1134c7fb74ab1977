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

/// Three such places, of float or double.
template <typename Real>
using TexelTriangleOf = std::array<glm::vec<2, Real>, 3>;
using TexelTriangle = TexelTriangleOf<float>;

/// Calls visit(x0, x1, y) for the texels [x0, x1) of each row whose centres lie in the triangle,
/// whichever way it turns. Triangles that share an edge, to the bit, share no texel and leave none
/// out. What lies outside the image is left out; so is a triangle that is not finite.
template <typename Real, typename Visit>
void for_each_span(const TexelTriangleOf<Real>& triangle, int width_px, int height_px,
                   Visit&& visit) {
  using Vec2 = glm::vec<2, Real>;
  Vec2 a = triangle[0], b = triangle[1], c = triangle[2];
  if (!std::isfinite(a.x + a.y + b.x + b.y + c.x + c.y)) return;
  const auto is_above = [](const Vec2& p, const Vec2& q) {
    return p.y < q.y || (p.y == q.y && p.x < q.x);
  };
  if (is_above(b, a)) std::swap(a, b);
  if (is_above(c, b)) std::swap(b, c);
  if (is_above(b, a)) std::swap(a, b);
  const auto whole = [](Real at, int most) {
    return static_cast<int>(std::min(std::max(std::ceil(at), Real(0)), Real(most)));
  };
  const int top = whole(a.y, height_px), bottom = whole(c.y, height_px);
  const int middle = std::max(whole(b.y, height_px), top);
  // Edges are walked from their upper ends, so both triangles at one compute the same.
  const Real along_ac = (c.x - a.x) / (c.y - a.y);
  Vec2 from = a;
  Real along = (b.x - a.x) / (b.y - a.y);  // not used where it has no row
  for (int y = top; y < bottom; ++y) {
    if (y == middle) from = b, along = (c.x - b.x) / (c.y - b.y);
    const Real p = a.x + (Real(y) - a.y) * along_ac, q = from.x + (Real(y) - from.y) * along;
    const int x0 = whole(std::min(p, q), width_px), x1 = whole(std::max(p, q), width_px);
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

// Which texels of a texture lie in a triangle, and fetches between texels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "image/image.h"

namespace viewcell {

/// Texture coordinates as positions in an image: texel centres at whole numbers, rows down, v up.
inline glm::dvec2 to_texels(const glm::vec2& uv, int width_px, int height_px) {
  return {uv.x * double(width_px) - 0.5, (1 - double(uv.y)) * height_px - 0.5};
}

/// Three such positions, of float or double.
template <typename Real>
using TexelTriangleOf = std::array<glm::vec<2, Real>, 3>;
using TexelTriangle = TexelTriangleOf<float>;

/// Calls visit(x0, x1, y) for the texels [x0, x1) of each row whose centres lie in the triangle,
/// whichever way it turns; of some rows that is none, x1 <= x0. Triangles that share an edge, to
/// the bit, share no texel and leave none out. What lies outside the image is left out; so is a
/// triangle that is not finite.
template <typename Real, typename Visit>
void for_each_row(const TexelTriangleOf<Real>& triangle, int width_px, int height_px,
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
  // Edges are walked from their upper ends, so both triangles at one compute the same. Four rows at
  // once: x and y of the long edge (ac) and of the short ones (ab, then bc).
  typedef Real Real4 __attribute__((vector_size(4 * sizeof(Real))));
  typedef std::int32_t Int4 __attribute__((vector_size(16)));
  const Real along_ac = (c.x - a.x) / (c.y - a.y);
  const Real along_ab = (b.x - a.x) / (b.y - a.y);  // not used where it has no row
  const Real along_bc = (c.x - b.x) / (c.y - b.y);
  const Real4 zero{}, width = zero + Real(width_px);
  const auto whole4 = [&](Real4 x) {  // rounded up, within the image
    x = x > zero ? x : zero;
    x = x < width ? x : width;
    const Int4 down = __builtin_convertvector(x, Int4);
    const Real4 back = __builtin_convertvector(down, Real4);
    return down - __builtin_convertvector(x > back, Int4);
  };
  for (int first = top; first < bottom; first += 4) {
    const Real4 y = Real(first) + Real4{0, 1, 2, 3};
    const auto is_upper = y < zero + Real(middle);
    const Real4 from_x = is_upper ? zero + a.x : zero + b.x;
    const Real4 from_y = is_upper ? zero + a.y : zero + b.y;
    const Real4 along = is_upper ? zero + along_ab : zero + along_bc;
    const Real4 p = a.x + (y - a.y) * along_ac, q = from_x + (y - from_y) * along;
    const Int4 left = whole4(p < q ? p : q), right = whole4(p < q ? q : p);
    for (int k = 0; k < 4 && first + k < bottom; ++k) visit(left[k], right[k], first + k);
  }
}

/// The same, but for rows of none.
template <typename Real, typename Visit>
void for_each_span(const TexelTriangleOf<Real>& triangle, int width_px, int height_px,
                   Visit&& visit) {
  for_each_row(triangle, width_px, height_px, [&](int x0, int x1, int y) {
    if (x0 < x1) visit(x0, x1, y);
  });
}

/// The four texels around a position, in the order (x0, y0), (x1, y0), (x0, y1), (x1, y1), and
/// their bilinear weights, which sum to 1. Beyond its rim an image goes on as it ends.
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

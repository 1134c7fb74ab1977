// Which texels a triangle holds, and samples between texels. For inner loops. Places are in
// texels: centres at whole numbers, y down.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

namespace viewcell {

using TexelTriangle = std::array<glm::vec2, 3>;

/// Texture coordinates as a place in texels.
inline glm::vec2 to_texels(const glm::vec2& uv, int width_px, int height_px) {
  return {uv.x * float(width_px) - 0.5f, (1 - uv.y) * float(height_px) - 0.5f};
}

/// Calls visit(x0, x1, y) for each row's texels x0 <= x < x1 whose centres lie in the triangle,
/// whichever way it turns. Triangles that share an edge share no texel and leave none out. Rows and
/// columns may lie outside the image.
template <typename Visit>
void for_each_span(const TexelTriangle& triangle, Visit&& visit) {
  const auto is_above = [](const glm::vec2& a, const glm::vec2& b) {
    return a.y < b.y || (a.y == b.y && a.x < b.x);
  };
  glm::vec2 a = triangle[0], b = triangle[1], c = triangle[2];
  if (is_above(b, a)) std::swap(a, b);
  if (is_above(c, b)) std::swap(b, c);
  if (is_above(b, a)) std::swap(a, b);
  const int top = static_cast<int>(std::ceil(a.y)), bottom = static_cast<int>(std::ceil(c.y));
  if (top >= bottom) return;
  const int middle = static_cast<int>(std::ceil(b.y));
  // Edges are walked from their upper end, so both triangles at one compute the same.
  const float along_ac = (c.x - a.x) / (c.y - a.y);
  glm::vec2 from = a;
  float along = (b.x - a.x) / (b.y - a.y);  // not used where there is no row
  for (int y = top; y < bottom; ++y) {
    if (y == std::max(top, middle)) from = b, along = (c.x - b.x) / (c.y - b.y);
    const float p = a.x + (float(y) - a.y) * along_ac, q = from.x + (float(y) - from.y) * along;
    const int x0 = static_cast<int>(std::ceil(std::min(p, q)));
    const int x1 = static_cast<int>(std::ceil(std::max(p, q)));
    if (x0 < x1) visit(x0, x1, y);
  }
}

/// The same for what lies in an image.
template <typename Visit>
void for_each_span_within(const TexelTriangle& triangle, int width_px, int height_px,
                          Visit&& visit) {
  for_each_span(
      triangle, [&](int x0, int x1, int y) __attribute__((always_inline)) {
        x0 = std::max(x0, 0), x1 = std::min(x1, width_px);
        if (y >= 0 && y < height_px && x0 < x1) visit(x0, x1, y);
      });
}

/// The affine map that takes one triangle to another: p -> x * p.x + y * p.y + offset.
struct TexelAffine {
  glm::vec2 x{1, 0}, y{0, 1}, offset{0};
  glm::vec2 operator()(const glm::vec2& p) const { return p.x * x + p.y * y + offset; }
};

/// Where `from` has no area, all of it goes to the first corner of `to`.
inline TexelAffine make_affine(const TexelTriangle& from, const TexelTriangle& to) {
  const glm::vec2 a = from[1] - from[0], b = from[2] - from[0];
  const glm::vec2 c = to[1] - to[0], d = to[2] - to[0];
  const float det = a.x * b.y - a.y * b.x;
  if (!(std::abs(det) > 1e-12f)) return {glm::vec2(0), glm::vec2(0), to[0]};
  TexelAffine out;
  out.x = (b.y * c - a.y * d) / det;
  out.y = (a.x * d - b.x * c) / det;
  out.offset = to[0] - out.x * from[0].x - out.y * from[0].y;
  return out;
}

}  // namespace viewcell

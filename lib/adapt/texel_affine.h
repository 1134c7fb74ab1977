// Affine maps between triangles of texels.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtx/exterior_product.hpp>

#include "image/texel_spans.h"

namespace viewcell {

/// The affine map that takes one triangle to another: p -> p.x * x + p.y * y + offset.
struct TexelAffine {
  glm::vec2 x{1, 0}, y{0, 1}, offset{0};
  glm::vec2 operator()(const glm::vec2& p) const { return p.x * x + p.y * y + offset; }
};

/// Of a triangle lower than this all points count as on its longest edge: what lies across it would
/// be rounding.
inline constexpr float kLeastHeight_px = 0.01f;

/// As of a triangle without area.
inline TexelAffine make_affine_along(const TexelTriangle& from, const TexelTriangle& to) {
  std::size_t i = 0;
  float longest2 = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::vec2 edge = from[(k + 1) % 3] - from[k];
    if (glm::dot(edge, edge) > longest2) longest2 = glm::dot(edge, edge), i = k;
  }
  const glm::vec2 edge = longest2 > 0 ? (from[(i + 1) % 3] - from[i]) / longest2 : glm::vec2(0);
  const glm::vec2 along = to[(i + 1) % 3] - to[i];
  TexelAffine out{edge.x * along, edge.y * along};
  out.offset = to[i] - out.x * from[i].x - out.y * from[i].y;
  return out;
}

inline TexelAffine make_affine(const TexelTriangle& from, const TexelTriangle& to) {
  const glm::vec2 a = from[1] - from[0], b = from[2] - from[0];
  const glm::vec2 c = to[1] - to[0], d = to[2] - to[0];
  const float det = glm::cross(a, b);
  // The longest edge is at most so long.
  const float longest2 = 2 * (glm::dot(a, a) + glm::dot(b, b));
  if (!(det * det > kLeastHeight_px * kLeastHeight_px * longest2))
    return make_affine_along(from, to);
  const float per_det = 1 / det;
  TexelAffine out{per_det * (b.y * c - a.y * d), per_det * (a.x * d - b.x * c)};
  out.offset = to[0] - out.x * from[0].x - out.y * from[0].y;
  return out;
}

}  // namespace viewcell

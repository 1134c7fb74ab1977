// Affine maps between triangles of texels.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "bake/texel_spans.h"

namespace viewcell {

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

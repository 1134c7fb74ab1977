// A bump over the unit square.
#pragma once

#include <cmath>

#include "pm/shapes.h"

namespace viewcell {

/// Of that height at its middle, of 16 x 16 squares.
inline TriMesh make_bare_bump(float height) {
  TriMesh grid = make_flat_grid(16);
  for (glm::vec3& p : grid.positions) {
    const float x = p.x / 16 - 0.5f, y = p.y / 16 - 0.5f;
    p = {p.x / 16, p.y / 16, height * std::exp(-12 * (x * x + y * y))};
  }
  return grid;
}

/// With a texture that is the view from above, or its mirror image.
inline TriMesh make_bump(float height, bool is_mirrored = false) {
  TriMesh bump = make_bare_bump(height);
  for (const Triangle& t : bump.triangles)
    for (const std::uint32_t v : t) {
      const float u = 0.1f + 0.8f * bump.positions[v].x;
      bump.texcoords.emplace_back(is_mirrored ? 1 - u : u, 0.1f + 0.8f * bump.positions[v].y);
    }
  return bump;
}

}  // namespace viewcell

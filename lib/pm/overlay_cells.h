// The cells of an overlay of two fans of triangles, and what is kept of them. An overlay cell is a
// part of one old face that corresponds to a part of one new face; it has nothing to do with view
// cells.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "pm/vector_box.h"

namespace viewcell {

/// How points of the two surfaces are matched.
enum class Matching {
  texture,  ///< by equal texture coordinates [Cohen 1998]
  nearest   ///< edges that cross at the nearest points of each other [Chen06 3.2.2, 4.2]
};

/// An overlay cell: a triangle or a quadrilateral.
struct OverlayCell {
  std::uint32_t old_face, new_face;  ///< as given to FanOverlay::add_ray
  VectorBox shift{};  ///< old minus new point; linear between the corners, so it holds all
};

/// Of the points of an overlay cell, over its part of the old face.
struct CellMoments {
  double area = 0;
  glm::dvec3 mean{0};  ///< of the shift
  double square = 0;   ///< mean squared length of the shift
};

/// A corner of overlay cells: its texture coordinates in the old faces and in the new ones.
struct TexturePoint {
  glm::dvec2 before, after;
  bool is_old_apex = false, is_new_apex = false;
};

/// The corners of an overlay cell as indices into texture_points(), in the winding of the faces; of
/// a triangle two neighbours are the same.
using CellCorners = std::array<std::uint32_t, 4>;

/// A point relative to the old fan's apex, in space and in the texture.
struct FanPoint {
  glm::dvec3 at{0};
  glm::dvec2 texture{0};
};

}  // namespace viewcell

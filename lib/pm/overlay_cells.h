// The cells of an overlay of two fans of triangles, and what is kept of them.
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

/// A part of one old face that goes to a part of one new face.
struct MapCell {
  std::uint32_t old_face, new_face;  ///< numbers that whoever laid the rays gave
  VectorBox shift{};  ///< of old point minus new point; linear between the corners, so it holds all
};

/// Of the points of a cell, over its part of the old face.
struct CellMoments {
  double area = 0;
  glm::dvec3 mean{0};  ///< of the shift
  double square = 0;   ///< mean squared length of the shift
};

/// A corner of cells in the texture: its place in the old faces and in the new ones.
struct TexturePoint {
  glm::dvec2 before, after;
  bool is_old_apex = false, is_new_apex = false;
};

/// The corners of a cell as places in texture_points(), in the winding of the faces; of a triangle
/// two neighbours are the same.
using CellCorners = std::array<std::uint32_t, 4>;

/// A point relative to the old fan's apex, in space and in the texture.
struct FanPoint {
  glm::dvec3 at{0};
  glm::dvec2 texture{0};
};

}  // namespace viewcell

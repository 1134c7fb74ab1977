// How far texture coordinates are from an isometry, and whether they are one to one in the small.
// Source: P. Sander, J. Snyder, S. Gortler, H. Hoppe, Texture mapping progressive meshes, SIGGRAPH
// 2001, section 3: geometric stretch.
#pragma once

#include <array>
#include <cstddef>

#include "mesh/mesh.h"

namespace viewcell {

/// Twice the signed area of a triangle in the plane; positive when counter-clockwise.
inline double twice_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

/// Lengths on the surface over lengths in the plane, of one triangle.
struct TriangleStretch {
  double l2 = 0;   ///< root mean square over all directions
  double max = 0;  ///< in the worst direction
};

/// Infinite when the triangle has no area in the plane.
TriangleStretch measure_triangle_stretch(const std::array<glm::dvec3, 3>& at,
                                         const std::array<glm::dvec2, 3>& uv);

struct UvStretch {
  double l2 = 0;              ///< root mean square over the surface; 1 is the least possible
  double max = 0;             ///< of all triangles
  std::size_t n_flipped = 0;  ///< triangles whose area in the plane is zero or negative
};

/// Of mesh.texcoords, scaled so that the area in the plane is that of the surface. O(triangles).
UvStretch measure_uv_stretch(const TriMesh& mesh);

}  // namespace viewcell

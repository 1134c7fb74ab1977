// Polygons cut into triangles.
// Source: S. Hertel, K. Mehlhorn, Fast triangulation of simple polygons, FCT 1983.
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

enum class PolygonCut {
  fan,     ///< (0, 1, 2), (0, 2, 3), ...: right for every convex polygon, and for some others
  sweep,   ///< from left to right
  crossed  ///< a fan for want of better: the polygon crosses itself or has no area
};

/// Appends triangles of a polygon of at least three corners to `out`, each three numbers of
/// corners, turning as the polygon does. What the polygon covers is seen along the axis nearest to
/// its normal: it need not be plane. It may touch itself, and run to a hole of its own and back.
/// Corners that are nowhere needed (both ends of such a way, points equal to the one before) may be
/// left out of `sweep`, but no area. O(n log n), fans O(n).
PolygonCut triangulate_polygon(std::span<const glm::vec3> corners, std::vector<Triangle>& out);

}  // namespace viewcell

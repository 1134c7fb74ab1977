// Convex polygons of the plane and their distances.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "mesh/convex_hull.h"

namespace viewcell {

/// Corners counter-clockwise, as of convex_hull(); one or two corners make a point or a segment.
using ConvexPolygon = std::vector<glm::dvec2>;

/// Whether p is in the closed polygon.
bool contains(const ConvexPolygon& polygon, const glm::dvec2& p);

/// The least distance between the closed polygons; 0 when they meet.
double distance(const ConvexPolygon& a, const ConvexPolygon& b);

}  // namespace viewcell

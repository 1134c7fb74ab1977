// Convex polygons of the plane: hulls and distances.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace viewcell {

/// Corners counter-clockwise; one or two corners make a point or a segment.
using ConvexPolygon = std::vector<glm::dvec2>;

/// The convex hull, without collinear points (monotone chain). O(n log n).
ConvexPolygon convex_hull(std::vector<glm::dvec2> points);

/// Whether p is in the closed polygon.
bool contains(const ConvexPolygon& polygon, const glm::dvec2& p);

/// The least distance between the closed polygons; 0 when they meet.
double distance(const ConvexPolygon& a, const ConvexPolygon& b);

}  // namespace viewcell

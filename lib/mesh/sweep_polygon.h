// The sweep behind triangulate_polygon. Private to this room.
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// Appends counter-clockwise triangles of a polygon that runs counter-clockwise. False where the
/// sweep finds that it crosses itself; what was appended is then of no use. Not every crossing is
/// found: the triangles' area tells. O(n log n).
bool sweep_polygon(const std::vector<glm::dvec2>& points, std::vector<Triangle>& out);

}  // namespace viewcell

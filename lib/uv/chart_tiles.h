// Where charts lie in a picture that repeats: in which of its tiles, or in several.
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// A range of texture coordinates.
struct UvRange {
  glm::dvec2 lo{0}, hi{0};
};

/// Wider than the picture by more than a fiftieth, beside it, or more than a tenth out of it.
bool is_repeating(const UvRange& range);

/// The lower left corner of the tile that holds the range; where none does, of the one into which
/// it may be moved for the first, but for a tenth (is_repeating); else 0. Beyond 10^6 tiles, where
/// single precision has no texels, 0.
glm::ivec2 find_tile(const UvRange& range);

/// Of each triangle the tile of its joined chart (ChartLink::corner): what moves together. 0 for
/// triangles of no chart. Empty where all are 0. mesh must have texture coordinates.
std::vector<glm::ivec2> find_chart_tiles(const TriMesh& mesh);

}  // namespace viewcell

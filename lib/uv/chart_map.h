// The charts of a mesh's texture coordinates, and which chart owns which texel.
#pragma once

#include <cstdint>

#include "image/image.h"
#include "mesh/charts.h"
#include "mesh/mesh.h"

namespace viewcell {

/// Vertices at one position count as one. In no chart: triangles of which
/// two corners stand at one position or a texture coordinate is not finite. mesh must have texture
/// coordinates. O(n log n).
Charts find_charts(const TriMesh& mesh, ChartLink link = ChartLink::edge);

/// Per texel 1 + the chart that a triangle of which its centre lies in, 0 where there is none. Of
/// several charts the lowest. Parts of charts outside [0, 1] own nothing.
Image<std::uint32_t> make_chart_map(const TriMesh& mesh, const Charts& charts, int width_px,
                                    int height_px);

}  // namespace viewcell

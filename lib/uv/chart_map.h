// The charts of a mesh's texture coordinates, and which chart owns which texel.
#pragma once

#include <cstdint>
#include <vector>

#include "image/image.h"
#include "mesh/mesh.h"

namespace viewcell {

inline constexpr std::uint32_t kNoChart = 0xffffffffu;

/// A chart is a largest set of triangles that are connected across edges whose texture coordinates
/// are equal at both ends; vertices at one position count as one. Charts are numbered by their
/// lowest triangle. (Parts that touch in one corner are two charts here, and one in
/// pm/wedge_mesh.h, where that corner's wedge is shared.)
struct Charts {
  std::vector<std::uint32_t> of;     ///< per triangle; kNoChart where two corners stand at one
                                     ///< position or a texture coordinate is not finite
  std::vector<std::uint32_t> first;  ///< per chart, its lowest triangle

  std::size_t size() const { return first.size(); }
};

/// mesh must have texture coordinates. O(n log n).
Charts find_charts(const TriMesh& mesh);

/// Per texel 1 + the chart that a triangle of which its centre lies in, 0 where there is none. Of
/// several charts the lowest. Parts of charts outside [0, 1] own nothing.
Image<std::uint32_t> make_chart_map(const TriMesh& mesh, const Charts& charts, int width_px,
                                    int height_px);

}  // namespace viewcell

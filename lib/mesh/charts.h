// Charts: the parts of a mesh that are connected in the texture. The border of a chart is its edges
// that only one of its triangles has; a seam is an edge of the surface on whose two sides the
// texture coordinates differ.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// What makes triangles one chart. Both count corners as one where position and texture coordinate
/// are equal: a texture vertex. They differ where parts touch in single texture vertices only (in 4
/// of 14 textured test models): of a bow tie, |><|, `edge` makes two charts and `corner` one.
enum class ChartLink {
  /// A chart: connected across edges, both texture vertices shared. What a picture shows as one
  /// piece; overlaps are reported between these.
  edge,
  /// A joined chart: connected by any texture vertex. What moves together when a vertex moves: a
  /// collapse at the waist moves both halves, and either may be sampled there.
  corner
};

inline constexpr std::uint32_t kNoChart = 0xffffffffu;
inline constexpr std::uint32_t kNoTextureVertex = 0xffffffffu;

/// Numbered by their lowest triangles.
struct Charts {
  std::vector<std::uint32_t> of;     ///< per triangle, or kNoChart
  std::vector<std::uint32_t> first;  ///< per chart, its lowest triangle

  std::size_t size() const { return first.size(); }
};

/// texture_vertices: of each triangle's corners, numbers below n_texture_vertices. A triangle with
/// kNoTextureVertex is in no chart. edge: O(n log n), three different numbers a triangle; corner:
/// O(n).
Charts connect_charts(const std::vector<Triangle>& texture_vertices, std::size_t n_texture_vertices,
                      ChartLink link);

}  // namespace viewcell

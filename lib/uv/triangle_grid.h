// The triangle of a mesh that has given texture coordinates.
#pragma once

#include <cstdint>
#include <vector>

#include "base/buckets.h"
#include "uv/triangle_map.h"

namespace viewcell {

/// Triangles of a mesh in its texture, by the cells of a grid over their charts.
class TriangleGrid {
 public:
  /// charts: of the triangles. Triangles whose texture coordinates are not finite are left out.
  /// Both must outlive the grid.
  TriangleGrid(const TriMesh& mesh, const std::vector<std::uint32_t>& charts);

  struct Nearest {
    std::uint32_t triangle = kNone;
    glm::dvec3 weights{
        0};  ///< of its corners at the nearest point, which is uv where it lies in it
  };
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// The triangle of the chart nearest to uv, of several the lowest; kNone: it has no triangle.
  /// Exact; constant time in or near a chart.
  Nearest find(const glm::dvec2& uv, std::uint32_t chart) const;

 private:
  glm::ivec2 cell_of(const glm::dvec2& uv) const;
  std::size_t bin_index(int x, int y) const {
    return std::size_t(y) * std::size_t(n_) + std::size_t(x);
  }
  Corners2 corners_of(std::uint32_t triangle) const;

  const TriMesh& mesh_;
  const std::vector<std::uint32_t>& charts_;
  int n_ = 1;  // cells along each side
  glm::dvec2 lo_{0}, cell_{1};
  Buckets<std::uint32_t> cells_;  // triangles
};

}  // namespace viewcell

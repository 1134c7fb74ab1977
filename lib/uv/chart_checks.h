// Properties of texture coordinates that rule out rewriting the texture texel by texel: charts that
// overlap, lie outside the picture, or have no area.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "uv/chart_tiles.h"

namespace viewcell {

/// Charts are named by their lowest triangle, triangles by their number in the mesh.
struct ChartOverlap {
  std::uint32_t first = 0, second = 0;  ///< charts; equal where one lies over itself
  std::size_t n_texels = 0;             ///< whose centres both own
  int x = 0, y = 0;                     ///< one of them, from the top left
};

struct ChartFindings {
  int width_px = 0, height_px = 0;  ///< the texture that texels are counted on
  std::size_t n_charts = 0;
  std::size_t n_not_finite = 0;  ///< triangles with a texture coordinate that is not finite
  std::uint32_t first_not_finite = 0;
  std::size_t n_flat = 0;  ///< charts without area
  std::uint32_t first_flat = 0;
  std::size_t n_tiny = 0;    ///< charts with area in which no texel's centre lies
  std::size_t n_turned = 0;  ///< triangles that turn against the greater part of their chart
  std::uint32_t first_turned = 0;
  std::size_t n_outside = 0;      ///< corners outside [0, 1]
  glm::dvec2 uv_lo{0}, uv_hi{0};  ///< range of all finite texture coordinates
  std::vector<glm::ivec2> tiles;  ///< find_chart_tiles(), of triangles
  glm::ivec2 tile{0};             ///< of all triangles, where they lie in one other
  std::size_t n_elsewhere = 0;    ///< charts in other tiles
  std::uint32_t first_elsewhere = 0;
  std::size_t n_repeating = 0;  ///< charts that want a picture that repeats
  std::uint32_t first_repeating = 0;
  UvRange repeating;  ///< of the first of them, in the first tile where it can be moved there
  std::vector<ChartOverlap> overlaps;  ///< by the number of texels, most first
  std::size_t n_overlapped = 0;        ///< charts in them
  std::size_t n_across_materials = 0;  ///< overlaps of charts whose first triangles differ in it
  std::size_t n_shared = 0;            ///< texels that they share
  std::size_t n_crowded = 0;  ///< texels of a chart with another chart's within 2 texels of them

  /// Whether each texel stands for one point of the surface at most. Corners that lie a little
  /// outside (n_outside) do not matter, but what lies there has no texels.
  bool is_one_to_one() const {
    return n_not_finite == 0 && n_elsewhere == 0 && n_repeating == 0 && overlaps.empty();
  }
};

/// mesh must have texture coordinates (NaN is allowed). An overlap counts when it holds a square of
/// 2 x 2 texel centres: none that is narrower than a texel does. A chart repeats when it is wider
/// than the picture by more than a fiftieth, lies beside it, or reaches more than a tenth out of
/// it, and no whole tiles move it there. Where charts lie in other tiles, all but uv_lo and uv_hi
/// is found as if they were moved back. One thread; O(triangles log triangles + texels covered).
ChartFindings check_charts(const TriMesh& mesh, int width_px, int height_px);

/// A line that says why no texture can follow a mesh with these charts, or nothing: coordinates
/// that are no numbers, pictures that repeat, and, unless allowed, two charts on the same texels.
std::string find_obstacle(const ChartFindings& findings, bool allows_overlap = false);

/// One line a finding, joined by line breaks; the first says how many charts there are.
std::string describe(const ChartFindings& findings);

}  // namespace viewcell

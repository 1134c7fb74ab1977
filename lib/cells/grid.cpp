#include "cells/grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace viewcell {
namespace {

const double kSqrt3 = std::sqrt(3.0);
constexpr int kMostCellsAcross = 2000;
// Points this near to the border of two cells are on it, in cell sizes: what rounding leaves of
// coordinates a million sizes wide, and nothing that can be seen.
constexpr double kBorder = 1e-9;

bool is_odd(int column) {
  return (column & 1) != 0;
}

}  // namespace

HexGrid make_grid(const Area& area, double size) {
  VIEWCELL_CHECK(size > 0, size);
  // A column covers every y of the area up to size / 2 on each side of its centre, a row of an even
  // column sqrt(3)/2 size. A far edge that falls on the last border takes one more.
  const auto count = [](double length, double covered, double step) {
    const double n = std::floor((length - covered) / step + 2 * kBorder);
    if (!(n + 1 < kMostCellsAcross))
      throw UsageError("cells of that size are too many: more than " +
                       std::to_string(kMostCellsAcross) + " across the area");
    return 1 + std::max(0, static_cast<int>(n) + 1);
  };
  HexGrid grid;
  grid.origin = area.lo;
  grid.size = size;
  grid.columns = count(area.hi.x - area.lo.x, size / 2, 1.5 * size);
  grid.rows = count(area.hi.y - area.lo.y, kSqrt3 / 2 * size, kSqrt3 * size);
  return grid;
}

glm::dvec2 centre_of(const HexGrid& grid, HexCoord hex) {
  const double half = is_odd(hex.column) ? 0.5 : 0.0;
  return grid.origin + grid.size * glm::dvec2(1.5 * hex.column, kSqrt3 * (hex.row + half));
}

ConvexPolygon corners_of(const HexGrid& grid, HexCoord hex) {
  const glm::dvec2 c = centre_of(grid, hex);
  const double s = grid.size, h = kSqrt3 / 2 * s;
  return {c + glm::dvec2(s, 0), c + glm::dvec2(s / 2, h),   c + glm::dvec2(-s / 2, h),
          c - glm::dvec2(s, 0), c + glm::dvec2(-s / 2, -h), c + glm::dvec2(s / 2, -h)};
}

// A hexagon is its centre's Voronoi cell, so the nearest centre decides; it is among the columns
// around the point's. The area's low edge is the lower border of row 0 in odd columns: there the
// higher row must win.
HexCoord coord_at(const HexGrid& grid, const glm::dvec2& point) {
  const glm::dvec2 p = (point - grid.origin) / grid.size;
  const int column = static_cast<int>(std::floor(p.x / 1.5));
  HexCoord best;
  double least = std::numeric_limits<double>::infinity();
  for (int c = column; c <= column + 1; ++c) {
    const int row = static_cast<int>(std::floor(p.y / kSqrt3 - (is_odd(c) ? 0.5 : 0.0)));
    for (int r = row + 1; r >= row; --r) {
      const glm::dvec2 d = (point - centre_of(grid, {c, r})) / grid.size;
      if (const double squared = glm::dot(d, d); squared < least - kBorder) {
        least = squared;
        best = {c, r};
      }
    }
  }
  return best;
}

HexCoord neighbour(HexCoord hex, int face) {
  const int up = is_odd(hex.column) ? 1 : 0;  // an odd column's slanted neighbours stand higher
  switch (face) {
    case 0:
      return {hex.column + 1, hex.row + up};
    case 1:
      return {hex.column, hex.row + 1};
    case 2:
      return {hex.column - 1, hex.row + up};
    case 3:
      return {hex.column - 1, hex.row + up - 1};
    case 4:
      return {hex.column, hex.row - 1};
    case 5:
      return {hex.column + 1, hex.row + up - 1};
    default:
      throw_bug(__FILE__, __LINE__, "face in 0..5", face);
  }
}

HexCoord coord_of(const HexGrid& grid, CellId cell) {
  const int i = static_cast<int>(cell);
  return {i % grid.columns, i / grid.columns};
}

HexCoord coord_of(const HexGrid& grid, CentreId centre) {
  const int i = static_cast<int>(centre);
  return {i % (grid.columns + 2) - 1, i / (grid.columns + 2) - 1};
}

std::optional<CellId> cell_at(const HexGrid& grid, HexCoord hex) {
  if (hex.column < 0 || hex.column >= grid.columns) return {};
  if (hex.row < 0 || hex.row >= grid.rows) return {};
  return CellId(hex.row * grid.columns + hex.column);
}

std::optional<CentreId> centre_at(const HexGrid& grid, HexCoord hex) {
  if (hex.column < -1 || hex.column > grid.columns) return {};
  if (hex.row < -1 || hex.row > grid.rows) return {};
  return CentreId((hex.row + 1) * (grid.columns + 2) + hex.column + 1);
}

std::array<CentreId, kViews> views_of(const HexGrid& grid, CellId cell) {
  const HexCoord hex = coord_of(grid, cell);
  std::array<CentreId, kViews> views{};
  views[0] = *centre_at(grid, hex);
  for (int face = 0; face < 6; ++face)
    views[static_cast<std::size_t>(face) + 1] = *centre_at(grid, neighbour(hex, face));
  return views;
}

}  // namespace viewcell

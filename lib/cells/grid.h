// The grid of hexagonal view cells (docs/formats.md, cells.json).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/ids.h"
#include "scene/convex2.h"
#include "scene/scene.h"

namespace viewcell {

/// Flat-topped hexagons of circumradius size [Chen06 5.2.1]: columns are 1.5 size apart in x, rows
/// sqrt(3) size apart in y, odd columns half a row up. Cell (0, 0) is centred on the area's low
/// corner, so a point at the area's edges is inside some cell.
struct HexGrid {
  glm::dvec2 origin{0};  ///< the centre of cell (0, 0)
  double size = 50;
  int columns = 1;
  int rows = 1;

  int n_cells() const { return columns * rows; }
  /// Centres are captured on the grid widened by one cell on each side.
  int n_centres() const { return (columns + 2) * (rows + 2); }
};

/// The smallest grid whose cells cover the area.
HexGrid make_grid(const Area& area, double size);

/// Column and row of a hexagon, which may be outside the grid.
struct HexCoord {
  int column = 0;
  int row = 0;
  bool operator==(const HexCoord&) const = default;
};

glm::dvec2 centre_of(const HexGrid& grid, HexCoord hex);
/// Six corners, counter-clockwise from +x.
ConvexPolygon corners_of(const HexGrid& grid, HexCoord hex);
/// The one hexagon that the point belongs to: the nearest centre; on a border the lowest column,
/// then the highest row, so that an area's edges belong to cells of its grid.
HexCoord coord_at(const HexGrid& grid, const glm::dvec2& point);
/// Across side face k, whose outward normal is at 30 + 60 k degrees, k = 0..5.
HexCoord neighbour(HexCoord hex, int face);

HexCoord coord_of(const HexGrid& grid, CellId cell);
HexCoord coord_of(const HexGrid& grid, CentreId centre);
/// Nothing when the hexagon is outside the grid (for a centre: outside the widened grid).
std::optional<CellId> cell_at(const HexGrid& grid, HexCoord hex);
std::optional<CentreId> centre_at(const HexGrid& grid, HexCoord hex);

/// A centre is a hexagon's middle, from which the scene is captured (CentreId). The views of a cell
/// are the captures from the seven centres of its closed neighbourhood: its own, then across faces
/// 0..5. Bit k of a view mask is view k of this order.
inline constexpr int kViews = 7;
std::array<CentreId, kViews> views_of(const HexGrid& grid, CellId cell);

}  // namespace viewcell

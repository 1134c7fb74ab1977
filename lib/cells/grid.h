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

/// A hexagon's place, also outside the grid: column, row.
struct HexPlace {
  int column = 0;
  int row = 0;
  bool operator==(const HexPlace&) const = default;
};

glm::dvec2 centre_of(const HexGrid& grid, HexPlace place);
/// Six corners, counter-clockwise from +x.
ConvexPolygon corners_of(const HexGrid& grid, HexPlace place);
/// The one hexagon that the point belongs to: the nearest centre; on a border the lowest column,
/// then the highest row, so that an area's edges belong to cells of its grid.
HexPlace place_at(const HexGrid& grid, const glm::dvec2& point);
/// Across side face k, whose outward normal is at 30 + 60 k degrees, k = 0..5.
HexPlace neighbour(HexPlace place, int face);

HexPlace place_of(const HexGrid& grid, CellId cell);
HexPlace place_of(const HexGrid& grid, CentreId centre);
/// Nothing when the place is outside the grid (for a centre: outside the widened grid).
std::optional<CellId> cell_at(const HexGrid& grid, HexPlace place);
std::optional<CentreId> centre_at(const HexGrid& grid, HexPlace place);

/// The seven centres of a cell's closed neighbourhood: its own, then across faces 0..5. Bit k of a
/// view mask is view k of this order.
inline constexpr int kViews = 7;
std::array<CentreId, kViews> views_of(const HexGrid& grid, CellId cell);

}  // namespace viewcell

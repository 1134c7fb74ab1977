#include "play/stand_in.h"

#include <array>

#include "base/error.h"

namespace viewcell {
namespace {

// Of a cell's size. Eyes between two samples of a path are off their heights by rounding.
constexpr double kHeightTolerance = 1e-6;

}  // namespace

std::span<const StandIn> stand_ins() {
  static constexpr std::array kAll = {StandIn::off_height, StandIn::off_cells,
                                      StandIn::damaged_cell, StandIn::damaged_textures};
  return kAll;
}

const char* stand_in_name(StandIn stand_in) {
  switch (stand_in) {
    case StandIn::none:
      return "";
    case StandIn::off_height:
      return "off_height";
    case StandIn::off_cells:
      return "off_cells";
    case StandIn::damaged_cell:
      return "damaged_cell";
    case StandIn::damaged_textures:
      return "damaged_textures";
  }
  throw_bug(__FILE__, __LINE__, "a StandIn", static_cast<int>(stand_in));
}

StandIn find_off_bake(const Bundle& bundle, const Camera& camera) {
  const CellSet& cells = bundle.cells();
  const auto cell = cell_at(cells.grid, coord_at(cells.grid, glm::dvec2(camera.eye)));
  if (!cell || !bundle.has(*cell)) return StandIn::off_cells;
  const double slack = kHeightTolerance * cells.grid.size;
  const bool is_within =
      camera.eye.z >= cells.eye_height.lo - slack && camera.eye.z <= cells.eye_height.hi + slack;
  return is_within ? StandIn::none : StandIn::off_height;
}

}  // namespace viewcell

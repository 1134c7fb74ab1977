// cells.json.
#include <cmath>

#include "cells/cells.h"
#include "fuzz.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t n_bytes) {
  using namespace viewcell;
  const auto file = put_input("cells.json", view_of(data, n_bytes));
  CellSet cells;
  if (!is_taken([&] { cells = read_cells(file); })) return 0;
  const Json json = format_cells(cells, Json::object());
  const CellSet again = read_cells(put_input("cells.json", format_json(json)));
  hold(format_cells(again, Json::object()) == json, "what is written reads back");
  hold(cells.inside.size() == static_cast<std::size_t>(cells.grid.n_cells()), "a list a cell");
  for (const glm::dvec3& p : prism_of(cells, CellId(cells.grid.n_cells() - 1)))
    hold(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "cells are somewhere");
  return 0;
}

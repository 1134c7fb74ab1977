// The map of a park as SVG: cells, objects, path.
#pragma once

#include <string>
#include <vector>

#include "cells/cells.h"
#include "scene/camera.h"

namespace viewcell {

struct MapOptions {
  std::string figure = "inside";  ///< what the legend calls `values`
  std::vector<double> values;     ///< a figure per cell, as its colour; empty: objects inside
};

/// A drawing in the park's units, y up. path may be null.
std::string draw_map(const Scene& scene, const CellSet& cells, const CameraPath* path,
                     const MapOptions& options = {});

}  // namespace viewcell

// Implicit figures into triangles.
#pragma once

#include "mesh/mesh.h"
#include "park/implicit.h"

namespace viewcell {

struct PolygoniseOptions {
  double cell = 1;     ///< side of the sampling grid's cubes, in the figure's units
  double floor_z = 0;  ///< the figure is cut off flat at this height
  int n_threads = 0;
};

/// The surface as a closed manifold mesh (every edge has two triangles, every vertex one fan),
/// about 2 triangles for each cell that it passes through. Details smaller than a cell are lost.
/// Only blocks of the grid near the surface are sampled. The same bytes for any number of threads.
/// Follows: surface nets [Gibson 1998]. Differs: samples are first made well-composed
/// [Latecki 1997], without which two sheets may share an edge.
TriMesh polygonise(const Figure& figure, const PolygoniseOptions& options);

}  // namespace viewcell

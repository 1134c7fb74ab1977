// How far a texture moves over a surface that is made finer.
#pragma once

#include <cstddef>

#include "mesh/mesh.h"

namespace viewcell {

/// In units of texture coordinates.
struct TexcoordDrift {
  double rms = 0, max = 0;
  std::size_t n_compared = 0;   ///< triangles of the finer mesh
  std::size_t n_elsewhere = 0;  ///< left out: nearest to a triangle that does not touch theirs
};

/// At the centre of each triangle of `fine`: its texture coordinate against that at the nearest
/// point of `coarse`, of which each triangle has become as many of `fine`, one after another. Both
/// must have texture coordinates. A nearest triangle counts as touching when it has a corner, with
/// its texture coordinate, of the triangle that the finer one comes from: so no seam is crossed.
/// About a microsecond a triangle. Throws MachineError.
TexcoordDrift measure_texcoord_drift(const TriMesh& coarse, const TriMesh& fine, int n_threads = 0);

}  // namespace viewcell

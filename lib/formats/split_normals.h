// Normals by corner for formats that have one a vertex.
#pragma once

#include <cstdint>
#include <vector>

#include "base/remarks.h"
#include "mesh/mesh.h"

namespace viewcell {

/// A mesh with normals by vertex. Vertices keep their numbers; copies of those that have several
/// normals stand behind them, in the order of the corners.
struct NormalSplit {
  TriMesh mesh;
  std::vector<std::uint32_t> source;  ///< vertex -> that of the mesh that was split
};

/// The mesh must have corner_normals. Says how many vertices were added. O(corners log corners).
NormalSplit split_by_normals(const TriMesh& mesh, Remarks* remarks);

}  // namespace viewcell

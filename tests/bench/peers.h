// Other people's simplifiers on our meshes, to measure against in the same run.
#pragma once

#include <cstddef>

#include "mesh/mesh.h"

namespace viewcell {

struct PeerResult {
  double time_s = 0;          ///< of simplifying alone, the peer's own mesh ready
  std::size_t n_faces = 0;    ///< that remain
  std::size_t n_removed = 0;  ///< vertices
};

/// meshopt_simplify: quadrics, arrays in and out, many collapses a pass, no record of them.
PeerResult run_meshoptimizer(const TriMesh& mesh, std::size_t target_faces);

/// OpenMesh's decimater with its module of quadrics: half-edge collapses from a heap.
PeerResult run_openmesh(const TriMesh& mesh, std::size_t target_faces);

}  // namespace viewcell

// Fine relief on a finished mesh, as chisel and weather (or a scanner) leave it.
#pragma once

#include <cstdint>

#include "mesh/mesh.h"

namespace viewcell {

/// Random waves of one length, as heights over a surface.
struct Waves {
  double height = 0;         ///< root mean square, model units; never over 2.2 times that
  glm::dvec3 wavelength{1};  ///< along x, y and z, model units; on a surface no wave is shorter
  std::uint64_t seed = 1;
};

/// The mean length of the mesh's edges, each triangle's three counted.
double mean_edge_length(const TriMesh& mesh);

/// Moves vertices in their tangent planes towards their neighbours' mean, n times; boundaries,
/// creases, plain parts (edges over twice the mean) and the floor (z within `floor_height` of the
/// least) stay.
void relax_tangentially(TriMesh& mesh, int n, double floor_height);

/// Displaces vertices along their normals. Nothing moves on the floor, on boundaries, nor where
/// edges are over thrice the mean (a plinth's plain sides); where they are short, less.
void add_waves(TriMesh& mesh, const Waves& waves, double floor_height);

}  // namespace viewcell

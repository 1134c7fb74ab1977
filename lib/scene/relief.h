// Fine relief on a finished mesh, as chisel and weather (or a scanner) leave it.
#pragma once

#include <cstdint>

#include "mesh/mesh.h"

namespace viewcell {

struct Relief {
  double grain_edges = 0.12;            ///< rms height of the grain, in mean edge lengths
  double grain_wavelength_edges = 2.8;  ///< shortest wavelength of the grain, in mean edge lengths
  double stroke = 0;                    ///< rms height of strokes (fur, chisel marks), model units
  glm::dvec3 stroke_wavelength{1};      ///< along x, y and z, model units
  std::uint64_t seed = 1;
};

/// The mean length of the mesh's edges, each triangle's three counted.
double mean_edge_length(const TriMesh& mesh);

/// Moves vertices in their tangent planes towards their neighbours' mean, n times; boundaries,
/// creases, plain parts (edges over twice the mean) and the floor (z within `floor_height` of the
/// least) stay.
void relax_tangentially(TriMesh& mesh, int n, double floor_height);

/// Displaces vertices along their normals by random waves. Nothing moves on the floor, on
/// boundaries, nor where edges are over twice the mean (a plinth's plain sides).
void add_relief(TriMesh& mesh, const Relief& relief, double floor_height);

}  // namespace viewcell

// Simplification to a count or an error, and chains of levels, by half-edge collapses under QEM.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "pm/collapse_loop.h"

namespace viewcell {

struct SimplifyOptions {
  std::size_t target_triangles = 0;  ///< stop at or below; 0: as far as max_error lets it go
  float max_error = std::numeric_limits<float>::infinity();  ///< QEM distance, model units
};

struct SimplifyResult {
  TriMesh mesh;                              ///< positions, and normals and colours where given
  std::vector<std::uint32_t> source_vertex;  ///< of each vertex, its number in the input
  double error = 0;                          ///< the largest QEM distance of a collapse
  CollapseCounts counts;
};

/// The count may be missed by one (an interior collapse takes two triangles), or by more when every
/// further collapse is refused. Texture coordinates are dropped.
SimplifyResult simplify(const TriMesh& mesh, const SimplifyOptions& options);

/// One level of detail over the vertices of the mesh that it was made from.
struct Level {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> source_triangle;  ///< their numbers in the input
  float error = 0;  ///< the largest QEM distance up to here, model units; 0: the input itself
};

struct LevelsOptions {
  std::size_t min_triangles = 64;
  std::span<const std::uint8_t> is_locked = {};  ///< by vertex, not 0: it stays; or empty
  bool keep_parts = false;                       ///< a triangle that stands alone stays
};

/// The input, then about half the triangles of the level before each time, down to min_triangles.
std::vector<Level> build_levels(const TriMesh& mesh, const LevelsOptions& options = {});

}  // namespace viewcell

// A level cut into pieces that are baked one by one.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

struct PieceOptions {
  /// Side of a piece. Parts of the level wider than kWideParts of it are cut at planes so far
  /// apart, smaller ones are put together by where they lie.
  double size = 8;
};
inline constexpr double kWideParts = 1.5;

struct LevelPieces {
  std::vector<TriMesh> pieces;   ///< with the level's material names; none is empty
  std::size_t n_components = 0;  ///< parts of the level, connected by equal positions
  std::size_t n_cut = 0;         ///< of those, wider than kWideParts of a piece
  std::size_t n_dropped = 0;     ///< triangles without area
};

/// Parts are connected by equal positions, whatever the material. A part that is cut has new
/// vertices where its edges meet the planes: those of both sides are the same to the bit, and
/// normals, texture coordinates and colours there are mixed. Pieces come in the order of their
/// place: x, then y, then z; of one place cut parts first. Same bytes every time. O(n log n).
LevelPieces cut_into_pieces(const TriMesh& level, const PieceOptions& options);

}  // namespace viewcell

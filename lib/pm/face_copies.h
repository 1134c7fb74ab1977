// Faces that lie on one another.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

inline constexpr std::uint32_t kNoCopy = 0xffffffffu;

/// Faces over the same three vertices, whichever way they turn, are one sheet: the two sides of a
/// leaf, or a face that a file has twice. The lowest of them stands for all; the others are its
/// copies, which live, move and die with it.
struct FaceCopies {
  std::vector<std::uint32_t>
      next;                   ///< per face its next copy, or kNoCopy; empty where none has one
  std::vector<bool> is_copy;  ///< per face; empty likewise

  bool empty() const { return next.empty(); }
};

/// Faces with a repeated vertex have no copies. O(n), sorted at vertices of many faces.
FaceCopies find_face_copies(std::span<const Triangle> faces, std::size_t n_vertices);

/// The faces with copies shrunk to a point each: without area and edges, but with their numbers.
std::vector<Triangle> without_copies(std::vector<Triangle> faces, const FaceCopies& copies);

}  // namespace viewcell

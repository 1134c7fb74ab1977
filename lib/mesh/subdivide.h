// Subdivision of triangles: each becomes four, and the surface smoother.
// Source: C. Loop, Smooth subdivision surfaces based on triangles, MSc thesis, University of Utah,
// 1987; weights of J. Warren, Subdivision methods for geometric design, 1995.
#pragma once

#include <cstddef>
#include <string>

#include "mesh/mesh.h"

namespace viewcell {

enum class SubdivisionScheme {
  loop,     ///< C2 but for vertices of other than six edges, where it is C1
  midpoint  ///< the same surface, finer
};

/// Of texture coordinates under the scheme loop; under midpoint they are linear.
enum class TexcoordRule {
  smooth,  ///< as positions: inside charts smooth, along their outlines a cubic curve
  inside,  ///< inside charts smooth; their outlines stay as they are
  linear   ///< the texture stays as it is on each triangle of the input
};

struct SubdivideOptions {
  int n_times = 1;  ///< at least 0; each time four triangles come from one
  SubdivisionScheme scheme = SubdivisionScheme::loop;
  TexcoordRule texcoords = TexcoordRule::inside;
};

struct Subdivision {
  TriMesh mesh;
  std::size_t n_welded = 0;   ///< vertices of the input that stood at the place of an earlier one
  std::size_t n_dropped = 0;  ///< triangles with two corners at one place, which are left out
};

inline constexpr std::size_t kMostSubdividedFaces = 100'000'000;

/// Vertices at equal positions are one, those of no triangle are left out. The others keep their
/// order; then come those on edges. Triangle t of those that stay becomes 4^n_times t and on. Edges
/// of one triangle or of more than two are creases, on which positions follow a cubic curve; where
/// other than two creases meet, a vertex stays. Colours follow the rule of positions; where several
/// meet at a vertex it is split, and borders between them stay. Materials stay. Normals stay where
/// the surface does (midpoint), by corner where a vertex has several; else they are made anew
/// where there were any. A chart ends where the texture coordinates on
/// the two sides of an edge differ. n_times = 0 welds only.
///
/// Throws InputError(file) when nothing stays, or more than kMostSubdividedFaces would come out.
/// O(triangles of the result x log).
Subdivision subdivide(const TriMesh& mesh, const SubdivideOptions& options,
                      const std::string& file = "mesh");

}  // namespace viewcell

// Orders, levels of detail and clusters of a mesh for fast drawing on the graphics card: the one
// file that wraps meshoptimizer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// The same triangles in an order that finds transformed vertices in the card's cache. Each keeps
/// its turn and its first corner. [Forsyth 2006], by meshoptimizer.
std::vector<Triangle> optimize_index_order(const std::vector<Triangle>& triangles,
                                           std::size_t n_vertices);

/// new_ids[old]: vertices numbered in the order in which the triangles first use them; those that
/// no triangle uses follow in their old order.
std::vector<std::uint32_t> make_fetch_order(const std::vector<Triangle>& triangles,
                                            std::size_t n_vertices);

/// A discrete level of detail: triangles over the mesh's own vertices.
struct DetailLevel {
  std::vector<Triangle> triangles;  ///< in an order for the vertex cache
  double error = 0;                 ///< the simplifier's own measure of distance, in model units
};

struct DetailOptions {
  double ratio = 0.7;              ///< triangles of a level over those of the finer one; (0, 1)
  std::size_t min_triangles = 12;  ///< no level is asked to have fewer
  int n_most = 32;                 ///< levels, the original among them
};

/// Level 0 is the mesh itself with error 0; each further one has fewer triangles, and no smaller
/// error, than the one before. Ends where the simplifier makes no more progress (it keeps the
/// topology, so non-manifold parts stop it). Every level starts from the original, so its error is
/// against that. The error is an estimate by quadrics, not a bound. [Garland and Heckbert 1997], by
/// meshopt_simplify.
std::vector<DetailLevel> build_meshopt_levels(const TriMesh& mesh,
                                              const DetailOptions& options = {});

}  // namespace viewcell

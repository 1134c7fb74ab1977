// Texture coordinates for a disk: its boundary on a convex curve, every inner vertex at a weighted
// mean of its neighbours. Such a map is one to one (Tutte 1963; Floater 1997).
// Sources: M. Floater, Mean value coordinates, CAGD 20(1), 2003: the weights. W. Tutte, How to draw
// a graph, 1963: equal weights. S. Yoshizawa, A. Belyaev, H.-P. Seidel, A fast and simple
// stretch-minimizing mesh parameterization, SMI 2004: relaxing.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// Of [0, 1], left free on each side.
inline constexpr double kUvMargin = 0.01;

enum class UvWeights {
  mean_value,  ///< reproduces a planar mesh whose boundary is in place
  uniform,     ///< Tutte's: knows edges only, not shapes
};

enum class UvBoundary { circle, square };

struct ParameterizeOptions {
  UvWeights weights = UvWeights::mean_value;
  UvBoundary boundary = UvBoundary::circle;
  /// Largest number of times that weights are divided by the stretch around the neighbour and the
  /// map is solved again; ends before as soon as the L2 stretch does not fall. 0: never.
  int relax_steps = 0;
};

/// Per vertex, in [kUvMargin, 1 - kUvMargin]^2, v up; triangles counter-clockwise in the mesh are
/// so in the plane. loop: find_boundary_loop of a disk, else BugError. The boundary's vertices are
/// spaced by the length of its edges, but none closer than 1/20 of the mean, so that single
/// precision tells them apart. `square` bulges its sides by 2 %, since three boundary vertices of
/// one triangle may not stand on one line. Nothing is promised in floats: measure_uv_stretch counts
/// what is flipped. One sparse factorisation for each solution; the same bytes each time.
std::vector<glm::dvec2> parameterize_disk(const TriMesh& mesh,
                                          const std::vector<std::uint32_t>& loop,
                                          const ParameterizeOptions& options = {});

/// The boundary alone: one position a vertex of the loop, counter-clockwise, in [-1, 1]^2.
std::vector<glm::dvec2> place_boundary(const TriMesh& mesh, const std::vector<std::uint32_t>& loop,
                                       UvBoundary boundary);

/// Per vertex, with the loop's vertices at the given positions. Options: weights and relax_steps.
std::vector<glm::dvec2> solve_interior(const TriMesh& mesh, const std::vector<std::uint32_t>& loop,
                                       const std::vector<glm::dvec2>& positions,
                                       const ParameterizeOptions& options = {});

/// Sets mesh.texcoords from coordinates per vertex.
void set_texcoords(TriMesh& mesh, const std::vector<glm::dvec2>& uv);

}  // namespace viewcell

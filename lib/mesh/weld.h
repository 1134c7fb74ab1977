// Vertices that stand at one place, or so near to each other that they were meant to.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// Of the box's diagonal: some hundred times what single precision rounds, so that corners written
/// apart by rounding are one, and a hundredth of a pixel on a picture of a thousand.
inline constexpr double kWeldShare = 1e-5;
/// Of the shortest edge at a vertex: what is welded stays far from the next vertex, and no triangle
/// loses a corner.
inline constexpr double kWeldMostOfEdge = 0.25;

struct WeldOptions {
  double tolerance = 0;  ///< mesh units; 0: equal positions only
  /// Nor is a vertex welded to one farther than this share of the shortest edge at either.
  /// infinity: no such limit, and triangles may lose their area.
  double most_of_edge = kWeldMostOfEdge;
};

/// kWeldShare of the diagonal of the box around all vertices that a triangle uses.
double default_weld_tolerance(const TriMesh& mesh);

/// Per vertex: the lowest vertex that it is welded to; itself where there is none. Vertices at
/// equal positions are welded whatever the tolerance; beyond that only vertices on borders (of
/// edges with one triangle), each to the nearest of the lower ones that stay: cracks and soups are
/// made of borders, and the inside of a surface is left alone. The same for any order of triangles.
/// O(n log n), and O(n) for what is beyond equal positions.
std::vector<std::uint32_t> weld_vertices(const TriMesh& mesh, const WeldOptions& options);
inline std::vector<std::uint32_t> weld_vertices(const TriMesh& mesh, double tolerance) {
  return weld_vertices(mesh, {.tolerance = tolerance});
}

struct BorderWeld {
  std::size_t n_welded = 0;  ///< vertices at other positions than those that they are welded to
  double gap = 0;            ///< the largest distance between them
};

/// The part beyond equal positions: of has those welded already, and gets the others.
BorderWeld weld_borders(std::span<const glm::vec3> positions, std::span<const Triangle> triangles,
                        const WeldOptions& options, std::vector<std::uint32_t>& of);

/// Moves vertices to those that weld_vertices welds them to by default: cracks close.
BorderWeld close_cracks(TriMesh& mesh);

}  // namespace viewcell

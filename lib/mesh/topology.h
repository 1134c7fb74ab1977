// What is wrong with a mesh, in numbers, and the removal of triangles that show nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "mesh/mesh.h"

namespace viewcell {

/// Counts over the triangles as indices have them: vertices at equal positions are not one.
struct MeshTopology {
  std::size_t n_edges = 0;
  std::size_t n_boundary_edges = 0;        ///< of one triangle
  std::size_t n_nonmanifold_edges = 0;     ///< of more than two
  std::size_t n_opposed_edges = 0;         ///< of two triangles that run along it in one direction
  std::size_t n_nonmanifold_vertices = 0;  ///< whose triangles are not one fan or one cycle
  std::size_t n_unreferenced_vertices = 0;
  std::size_t n_components = 0;           ///< connected by edges or vertices
  std::int64_t euler_characteristic = 0;  ///< referenced vertices - edges + triangles

  bool is_closed_manifold() const {
    return n_boundary_edges + n_nonmanifold_edges + n_opposed_edges + n_nonmanifold_vertices == 0;
  }
};

/// O(triangles + vertices), edges of one vertex sorted. Triangles with a repeated index are
/// skipped.
MeshTopology measure_topology(const TriMesh& mesh);

struct MeshDefects {
  std::size_t n_repeated_index = 0;  ///< removed: a triangle that names a vertex twice
  std::size_t n_zero_area = 0;       ///< removed: no area in double precision
  std::size_t n_duplicates = 0;  ///< removed: the same vertices in the same turn as an earlier one
  MeshTopology topology;         ///< of what remains

  std::size_t n_removed() const { return n_repeated_index + n_zero_area + n_duplicates; }
};

/// Per vertex: the lowest number of a vertex at its position. O(n log n).
std::vector<std::uint32_t> match_positions(const TriMesh& mesh);

inline constexpr std::uint32_t kNoTwin = 0xffffffffu;

/// Per triangle: its twin, one of the same vertices in the opposite turn, or kNoTwin. Each is the
/// twin of one, of several the lowest. Empty where no triangle has one. O(n log n).
std::vector<std::uint32_t> match_twins(std::span<const Triangle> triangles, std::size_t n_vertices);

/// Removes triangles that show nothing; the rest keep their order and their attributes. Vertices
/// stay, so their numbers do. The two sides of a sheet (the same vertices in opposite turns) stay.
MeshDefects clean_mesh(TriMesh& mesh);

}  // namespace viewcell

// A surface by its half-edges: what lies across an edge, which edges are open, where the boundary
// runs. The one file that wraps OpenMesh, and of OpenMesh its connectivity alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// Of an edge, the side on whose left a triangle would run from one vertex to another.
enum class EdgeSide {
  absent,  ///< no triangle has the edge
  open,    ///< only a triangle that runs the other way has it
  taken    ///< a triangle runs along it
};

/// An oriented manifold with boundary that grows by triangles: an edge has at most one triangle on
/// each side, and a vertex either one closed fan of triangles or any number of open ones. Vertices
/// and triangles go by the numbers that they are given. What may be not manifold is walked by
/// EdgeTable (mesh/edges.h).
class HalfEdgeMesh {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// Without triangles.
  explicit HalfEdgeMesh(std::size_t n_vertices);
  /// With the mesh's triangles, added in their order.
  explicit HalfEdgeMesh(const TriMesh& mesh);
  ~HalfEdgeMesh();
  HalfEdgeMesh(const HalfEdgeMesh&) = delete;
  HalfEdgeMesh& operator=(const HalfEdgeMesh&) = delete;

  /// Takes in a triangle under a number of its own. When it names a vertex twice, or the surface
  /// would be no manifold with it, nothing changes and the result is false. Takes as long as its
  /// vertices have edges: a fan of n triangles is built in n^2 steps.
  bool add(std::uint32_t number, const Triangle& t);

  const std::vector<std::uint32_t>& taken() const { return taken_; }      ///< in order
  const std::vector<std::uint32_t>& refused() const { return refused_; }  ///< in order

  /// True when a triangle has the vertex.
  bool has_vertex(std::uint32_t vertex) const;
  /// True when an open edge ends at the vertex.
  bool is_boundary(std::uint32_t vertex) const;
  /// Takes as long as `from` has edges.
  EdgeSide side(std::uint32_t from, std::uint32_t to) const;
  /// The triangle across the edge from corner k of a triangle to the next; kNone at the boundary.
  std::uint32_t across(std::uint32_t triangle, std::size_t k) const;

  /// The vertices of each boundary, the surface on the left, from the lowest number on; by that
  /// number. A vertex of several open fans stands there several times.
  std::vector<std::vector<std::uint32_t>> boundary_loops() const;

 private:
  struct Kernel;
  std::unique_ptr<Kernel> kernel_;
  std::vector<std::uint32_t> taken_, refused_;
};

}  // namespace viewcell

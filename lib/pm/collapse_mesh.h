// The connectivity that edge collapses edit: flat arrays, no half-edges, so that non-manifold input
// needs no splitting and vertex ids stay those of the input.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/large_vector.h"
#include "mesh/mesh.h"
#include "pm/fan.h"
#include "pm/refusal.h"

namespace viewcell {

/// What a collapse did to the triangles, by their numbers in the input.
struct CollapseTrace {
  std::vector<std::uint32_t> died;   ///< triangles, the most recent of u's list first
  std::vector<std::uint32_t> moved;  ///< corners (3 * triangle + k) that went from u to v
};

/// Triangles over vertices; a corner c = 3 * triangle + k, and the corners of each vertex stand one
/// after another in one array. Memory: 27 bytes a triangle, 8 a vertex, and the positions that it
/// refers to.
class CollapseMesh {
 public:
  /// Keeps a reference to positions. Triangles with a repeated index are dropped at once. Positions
  /// may be changed by their owner between calls.
  CollapseMesh(std::span<const glm::vec3> positions, std::span<const Triangle> triangles);

  std::size_t n_vertices() const { return stars_.size(); }
  std::size_t n_triangles() const { return n_triangles_; }
  const glm::vec3& position(std::uint32_t v) const { return positions_[v]; }
  bool has_triangles(std::uint32_t v) const { return stars_[v].n > 0; }
  /// The vertex at a corner of a live triangle, or of one that died, when it did.
  std::uint32_t vertex_at(std::uint32_t corner) const { return vertices_[corner]; }

  /// Calls visit(a, b) for every triangle (v, a, b) of v, in that winding.
  template <typename Visit>
  void for_each_triangle(std::uint32_t v, Visit&& visit) const {
    for (const std::uint32_t c : corners(v)) {
      const std::uint32_t k = c % 3;
      visit(vertices_[c + 1 - 3 * (k == 2)], vertices_[c - 1 + 3 * (k == 0)]);
    }
  }
  /// Calls visit(corner) for every corner of v.
  template <typename Visit>
  void for_each_corner(std::uint32_t v, Visit&& visit) const {
    for (const std::uint32_t c : corners(v)) visit(c);
  }

  /// Prefetches for a visit of v's triangles, in three stages: each reads what the one before has
  /// fetched.
  void fetch_star(std::uint32_t v) const { __builtin_prefetch(&stars_[v]); }
  void fetch_corners(std::uint32_t v) const {
    __builtin_prefetch(corners(v).data());
    __builtin_prefetch(corners(v).data() + stars_[v].n);
  }
  void fetch_triangles(std::uint32_t v) const {
    for (const std::uint32_t c : corners(v)) __builtin_prefetch(&vertices_[c]);
  }

  /// The vertices joined to v by an edge, each once, in an order that depends on the history only.
  void ring(std::uint32_t v, std::vector<std::uint32_t>& out);

  /// Whether the half-edge collapse u -> v keeps the surface's topology (the link condition),
  /// moves a boundary vertex along its boundary only, and turns no triangle's normal by more than
  /// acos(min_cosine) nor makes one of no area. A triangle on its own may vanish.
  /// Not thread-safe (scratch lists).
  Refusal check(std::uint32_t u, std::uint32_t v, float min_cosine);
  /// The same for the full-edge collapse of u and v into `position`: both vertices move, and an
  /// edge from boundary to boundary through the inside is refused.
  Refusal check(std::uint32_t u, std::uint32_t v, const glm::vec3& position, float min_cosine);

  /// Collapses u into v: triangles with both die, the others of u get v instead. trace: set to
  /// what was done.
  void collapse(std::uint32_t u, std::uint32_t v, CollapseTrace* trace = nullptr);
  /// Whether u and v are corners of a triangle that stands alone: their collapse would be its end.
  bool is_lone_triangle(std::uint32_t u, std::uint32_t v) const;
  /// Whether some edge of v has exactly one triangle. Not thread-safe.
  bool is_on_boundary(std::uint32_t v);
  /// The live triangles, in the order of the input, and their numbers there.
  std::vector<Triangle> triangles() const;
  std::vector<std::uint32_t> triangle_numbers() const;

 private:
  // Where the corners of a vertex stand.
  struct Star {
    std::uint32_t first = 0, n = 0;
  };
  std::span<const std::uint32_t> corners(std::uint32_t v) const {
    return {corners_.data() + stars_[v].first, stars_[v].n};
  }
  void gather(std::uint32_t v, Fan& fan) const;
  void unlink(std::uint32_t v, std::uint32_t corner);
  void make_room(std::size_t n);
  bool keeps_topology(const Fan& of_u, std::uint32_t u, std::uint32_t v, bool& is_boundary_edge);
  Refusal check_move(const Fan& fan, std::uint32_t from, std::uint32_t other, const glm::vec3& to,
                     float min_cosine) const;

  std::span<const glm::vec3> positions_;
  LargeVector<std::uint32_t> vertices_;  // 3 a triangle
  std::vector<bool> alive_;              // by triangle
  LargeVector<Star> stars_;              // by vertex
  LargeVector<std::uint32_t> corners_;   // of all vertices; new lists stand at the end
  Fan fan_u_, fan_v_;                    // scratch
  std::vector<std::uint32_t> opposite_;  // scratch
  std::size_t n_triangles_ = 0;
};

}  // namespace viewcell

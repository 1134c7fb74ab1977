// The connectivity that edge collapses edit: flat arrays, no half-edges, so that non-manifold input
// needs no splitting and vertex ids stay those of the input.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/large_vector.h"
#include "mesh/mesh.h"
#include "pm/corner_lists.h"
#include "pm/face_copies.h"
#include "pm/hub_links.h"
#include "pm/refusal.h"
#include "pm/star_check.h"

namespace viewcell {

/// What a collapse did to the triangles, by their numbers in the input.
struct CollapseTrace {
  std::vector<std::uint32_t> died;   ///< triangles, the most recent of u's list first
  std::vector<std::uint32_t> moved;  ///< corners (3 * triangle + k) that went from u to v
};

/// Triangles over vertices; a corner c = 3 * triangle + k. Faces over the same three vertices are
/// one sheet (FaceCopies): the first stands for all in what is asked of the surface, and its copies
/// follow it. Memory: 27 bytes a triangle, 8 a vertex, and the positions that it refers to.
class CollapseMesh {
 public:
  /// Keeps a reference to positions. Triangles with a repeated index are dropped at once. Positions
  /// may be changed by their owner between calls.
  CollapseMesh(std::span<const glm::vec3> positions, std::span<const Triangle> triangles)
      : CollapseMesh(positions, triangles, find_face_copies(triangles, positions.size())) {}
  /// Copies found already; none: every face is for itself.
  CollapseMesh(std::span<const glm::vec3> positions, std::span<const Triangle> triangles,
               FaceCopies copies);

  std::size_t n_vertices() const { return lists_.n_vertices(); }
  std::size_t n_triangles() const { return n_triangles_; }
  std::size_t n_sheet_triangles() const { return n_sheet_; }  ///< without copies
  std::size_t n_sheet_triangles(std::uint32_t v) const { return lists_.count(v); }
  const glm::vec3& position(std::uint32_t v) const { return positions_[v]; }
  bool has_triangles(std::uint32_t v) const { return lists_.count(v) > 0; }
  /// The vertex at a corner of a live triangle, or of one that died, when it did.
  std::uint32_t vertex_at(std::uint32_t corner) const { return vertices_[corner]; }

  /// Calls visit(a, b) for every triangle (v, a, b) of v, in that winding; not for copies.
  template <typename Visit>
  void for_each_triangle(std::uint32_t v, Visit&& visit) const {
    for (const std::uint32_t c : lists_.visit(v)) {
      const std::uint32_t k = c % 3;
      visit(vertices_[c + 1 - 3 * (k == 2)], vertices_[c - 1 + 3 * (k == 0)]);
    }
  }
  /// Calls visit(corner) for every corner of v, but those of copies.
  template <typename Visit>
  void for_each_sheet_corner(std::uint32_t v, Visit&& visit) const {
    for (const std::uint32_t c : lists_.visit(v)) visit(c);
  }
  /// Those of copies too.
  template <typename Visit>
  void for_each_corner(std::uint32_t v, Visit&& visit) const {
    for (const std::uint32_t c : lists_.visit(v)) {
      visit(c);
      if (!copies_.empty()) for_each_copy(c / 3, [&](std::uint32_t t) { visit(corner_at(t, v)); });
    }
  }
  bool has_copies() const { return !copies_.empty(); }
  /// Of copies nothing: they stand in no list.
  const CornerLists& lists() const { return lists_; }
  const HubLinks& hub_links() const { return links_; }
  bool is_hub(std::uint32_t v) const { return lists_.is_hub(v); }  ///< see kHubTriangles

  /// Prefetches for a visit of v's triangles, after those of lists(): each reads what the one
  /// before has fetched.
  void fetch_triangles(std::uint32_t v) const {
    for (const std::uint32_t c : lists_.visit(v)) __builtin_prefetch(&vertices_[c]);
  }

  /// The vertices joined to v by an edge, each once, in an order that depends on the history only.
  void ring(std::uint32_t v, std::vector<std::uint32_t>& out) { check_.ring(*this, v, out); }

  /// Whether the half-edge collapse u -> v keeps the surface's topology (the link condition),
  /// moves a boundary vertex along its boundary only (edges with an odd number of triangles: where
  /// the surface ends, or three sheets meet), and turns no triangle's normal by more than
  /// acos(min_cosine) nor makes one of no area. A triangle on its own may vanish, unless it is the
  /// last. O(triangles of both); where v is a hub and u is not, of u and its neighbours but hubs.
  /// Not thread-safe (scratch lists).
  Refusal check(std::uint32_t u, std::uint32_t v, float min_cosine) {
    return check_.check(*this, u, v, min_cosine);
  }
  /// The same for the full-edge collapse of u and v into `position`: both vertices move, and an
  /// edge from boundary to boundary through the inside is refused.
  Refusal check(std::uint32_t u, std::uint32_t v, const glm::vec3& position, float min_cosine) {
    return check_.check(*this, u, v, position, min_cosine);
  }

  /// Collapses u into v: triangles with both die, the others of u get v instead. trace: set to
  /// what was done.
  void collapse(std::uint32_t u, std::uint32_t v, CollapseTrace* trace = nullptr);
  /// Takes out triangles: all that their vertices have, copies too. trace: set to what was done.
  void remove(std::span<const std::uint32_t> triangles, CollapseTrace& trace);
  /// Whether u and v are corners of a triangle that stands alone: their collapse would be its end.
  bool is_lone_triangle(std::uint32_t u, std::uint32_t v) const;
  /// Whether some edge of v has an odd number of triangles. Not thread-safe.
  bool is_on_boundary(std::uint32_t v) { return check_.is_on_boundary(*this, v); }
  /// The live triangles, in the order of the input, and their numbers there.
  std::vector<Triangle> triangles() const;
  std::vector<std::uint32_t> triangle_numbers() const;

 private:
  std::uint32_t corner_at(std::uint32_t t, std::uint32_t v) const {
    return 3 * t + (vertices_[3 * t] == v ? 0 : vertices_[3 * t + 1] == v ? 1 : 2);
  }
  template <typename Visit>
  void for_each_copy(std::uint32_t t, Visit&& visit) const {
    for (t = copies_.next[t]; t != kNoCopy; t = copies_.next[t]) visit(t);
  }
  void kill(std::uint32_t corner, CollapseTrace* trace);
  void move(std::uint32_t corner, std::uint32_t v, CollapseTrace* trace);
  void set_hub(std::uint32_t v, bool is_hub);

  std::span<const glm::vec3> positions_;
  LargeVector<std::uint32_t> vertices_;  // 3 a triangle
  FaceCopies copies_;
  CornerLists lists_;
  HubLinks links_;
  StarCheck check_;
  std::size_t n_triangles_ = 0, n_sheet_ = 0;
};

}  // namespace viewcell

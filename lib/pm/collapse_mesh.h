// The connectivity that edge collapses edit: flat arrays, no half-edges, so that non-manifold input
// needs no splitting and vertex ids stay those of the input.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// Why a collapse was refused.
enum class Refusal { none, link, boundary, flip, metric };
inline constexpr int kRefusalKinds = 5;
const char* refusal_name(Refusal refusal);

/// Triangles over fixed vertices; a corner c = 3 * triangle + k, and the corners of each vertex
/// form a linked list. Memory: 24 bytes a triangle, 4 a vertex, and the positions that it refers
/// to.
class CollapseMesh {
 public:
  /// Keeps a reference to positions. Triangles with a repeated index are dropped at once.
  CollapseMesh(std::span<const glm::vec3> positions, std::span<const Triangle> triangles);

  std::size_t n_vertices() const { return head_.size(); }
  std::size_t n_triangles() const { return n_triangles_; }
  const glm::vec3& position(std::uint32_t v) const { return positions_[v]; }
  bool has_triangles(std::uint32_t v) const { return head_[v] != kEnd; }

  /// Calls visit(a, b) for every triangle (v, a, b) of v, in that winding.
  template <typename Visit>
  void for_each_triangle(std::uint32_t v, Visit&& visit) const {
    for (std::uint32_t c = head_[v]; c != kEnd; c = next_[c]) {
      const std::uint32_t t = c / 3, k = c % 3;
      visit(corners_[3 * t + (k + 1) % 3], corners_[3 * t + (k + 2) % 3]);
    }
  }

  /// The vertices joined to v by an edge, each once, in an order that depends on the history only.
  void ring(std::uint32_t v, std::vector<std::uint32_t>& out) const;

  /// Whether the half-edge collapse u -> v keeps the surface's topology (the link condition),
  /// moves a boundary vertex along its boundary only, and turns no triangle's normal by more than
  /// acos(min_cosine) nor makes one of no area. A triangle on its own may vanish.
  /// Not thread-safe (scratch marks).
  Refusal check(std::uint32_t u, std::uint32_t v, float min_cosine);

  /// Collapses u into v: triangles with both die, the others of u get v in its place.
  void collapse(std::uint32_t u, std::uint32_t v);

  /// The live triangles, in the order of the input.
  std::vector<Triangle> triangles() const;

 private:
  static constexpr std::uint32_t kEnd = 0xffffffffu;
  void unlink(std::uint32_t v, std::uint32_t corner);
  bool keeps_topology(std::uint32_t u, std::uint32_t v, bool& is_boundary_edge);
  bool has_triangle(std::uint32_t u, std::uint32_t a, std::uint32_t b) const;
  bool is_on_boundary(std::uint32_t u);
  bool keeps_normals(std::uint32_t u, std::uint32_t v, float min_cosine) const;

  std::span<const glm::vec3> positions_;
  std::vector<std::uint32_t> corners_;  // 3 a triangle; kEnd in a dead one
  std::vector<std::uint32_t> next_;     // corner -> next corner of the same vertex
  std::vector<std::uint32_t> head_;     // vertex -> its first corner
  std::vector<std::uint32_t> mark_;     // vertex -> scratch, compared with stamp_
  std::uint32_t stamp_ = 0;
  std::size_t n_triangles_ = 0;
};

}  // namespace viewcell

// The triangles at each vertex, as lists of corners in one array.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/large_vector.h"

namespace viewcell {

/// A vertex of more triangles than this is a hub: the tip of a cone, an edge of a book. Work on it
/// must not be in proportion to its triangles for every one of them that changes. Twice what models
/// without hubs come to (78 triangles on the flat sides of a fandisk).
inline constexpr std::uint32_t kHubTriangles = 128;

/// Which triangles live, and the corners (3 * triangle + k) at each vertex. Lists keep their order.
/// Those of hubs are edited lazily: dead corners stay until the list is asked for, and there is
/// room in front, so that an edit costs what it changes. 8 bytes a vertex, 13 a triangle, a quarter
/// more for new lists, and for hubs up to three times their lists.
class CornerLists {
 public:
  /// vertices: of the corners, kept by the caller. Triangles that are not in `alive` are in no
  /// list.
  CornerLists(std::span<const std::uint32_t> vertices, std::vector<bool> alive,
              std::size_t n_vertices);

  std::size_t n_vertices() const { return stars_.size(); }
  bool is_alive(std::uint32_t triangle) const { return alive_[triangle]; }
  std::uint32_t count(std::uint32_t v) const { return stars_[v].n; }
  bool is_hub(std::uint32_t v) const { return stars_[v].n > kHubTriangles; }
  bool has_hubs() const { return !hubs_.empty(); }
  /// Valid until the next edit.
  std::span<const std::uint32_t> of(std::uint32_t v) const {
    const Star star = stars_[v];
    if (star.n > kHubTriangles) [[unlikely]]
      tidy(v);
    return {corners_.data() + star.first, star.n};
  }
  /// The same, to go through all of them.
  std::span<const std::uint32_t> visit(std::uint32_t v) const {
    n_visited_ += stars_[v].n;
    return of(v);
  }
  /// A corner of v that fits(corner), or kNone: of a hub the first one, of others the last.
  template <typename Fits>
  std::uint32_t find(std::uint32_t v, Fits&& fits) const {
    if (is_hub(v)) trim(v);
    const Star& star = stars_[v];
    std::uint32_t found = kNone;
    const std::uint32_t* end =
        corners_.data() + star.first + star.n + (is_hub(v) ? hubs_[v].n_dead : 0);
    for (const std::uint32_t* c = corners_.data() + star.first; c != end; ++c) {
      ++n_visited_;
      if (!alive_[*c / 3] || !fits(*c)) continue;
      found = *c;
      if (is_hub(v)) break;
    }
    return found;
  }
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// Corners that were gone through so far: what the work on the mesh is in proportion to.
  std::uint64_t n_visited() const { return n_visited_; }

  void fetch_star(std::uint32_t v) const { __builtin_prefetch(&stars_[v]); }
  void fetch(std::uint32_t v) const {
    __builtin_prefetch(corners_.data() + stars_[v].first);
    __builtin_prefetch(corners_.data() + stars_[v].first + stars_[v].n);
  }

  void kill(std::uint32_t triangle) { alive_[triangle] = false; }
  /// A triangle that stands in no list lives, too.
  void revive(std::uint32_t triangle) { alive_[triangle] = true; }
  /// Takes a corner of a triangle that was killed out of the list of v.
  void unlink(std::uint32_t v, std::uint32_t corner);
  /// Puts the corners of u in front of those of v, but for those that keep(corner) says no to; u
  /// has none then. keep may unlink corners of others.
  template <typename Keep>
  void merge(std::uint32_t u, std::uint32_t v, Keep&& keep) {
    shrunk_.clear();
    const auto move_to = [&](auto& list) {
      for (const std::uint32_t c : of(u)) keep(c) ? list.push_back(c) : void(--n_listed_);
    };
    if (is_hub(v)) [[unlikely]] {
      merged_.clear();
      move_to(merged_);
      prepend(v);
    } else {
      make_room(stars_[u].n + stars_[v].n);
      const auto first = static_cast<std::uint32_t>(corners_.size());
      move_to(corners_);
      append_rest(v, first);
    }
    clear(u);
  }
  /// Vertices that are no hubs any more since the last merge.
  std::span<const std::uint32_t> shrunk() const { return shrunk_; }
  /// v has no corners from now on.
  void clear(std::uint32_t v);

 private:
  // Where the corners of a vertex stand: dead ones are among them, but n counts those that live.
  struct Star {
    std::uint32_t first = 0, n = 0;
  };
  struct Hub {
    std::uint32_t n_dead = 0, room = 0;  // room: free places in front of the list
  };
  void tidy(std::uint32_t v) const;
  void trim(std::uint32_t v) const;
  void make_room(std::size_t n);
  void append_rest(std::uint32_t v, std::uint32_t first);
  void prepend(std::uint32_t v);

  std::vector<bool> alive_;                     // by triangle
  mutable LargeVector<Star> stars_;             // by vertex
  mutable LargeVector<std::uint32_t> corners_;  // of all vertices; new lists stand at the end
  mutable std::unordered_map<std::uint32_t, Hub> hubs_;
  std::vector<std::uint32_t> merged_, shrunk_;
  std::size_t n_listed_ = 0;  // corners in all lists, at most
  mutable std::uint64_t n_visited_ = 0;
};

}  // namespace viewcell

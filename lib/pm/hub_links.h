// Which hubs (pm/corner_lists.h) have triangles with each other: asked without a walk around one.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>

#include "mesh/mesh.h"

namespace viewcell {

/// Counts the triangles that two or three hubs have in common. Every triangle with a hub that comes
/// or goes must be told.
class HubLinks {
 public:
  bool has_hubs() const { return !hubs_.empty(); }
  bool is_hub(std::uint32_t v) const { return hubs_.contains(v); }
  void add(const Triangle& t) { count(t, 1); }
  void remove(const Triangle& t) { count(t, -1); }
  /// From now on, or until now, v is a hub; for_each(visit) visits its triangles. O(its triangles).
  template <typename ForEach>
  void start(std::uint32_t v, const ForEach& for_each) {
    hubs_.insert(v);
    for_each([&](const Triangle& t) { count_at(v, t, 1); });
  }
  template <typename ForEach>
  void end(std::uint32_t v, const ForEach& for_each) {
    for_each([&](const Triangle& t) { count_at(v, t, -1); });
    hubs_.erase(v);
  }
  /// v has no triangles any more, and all have been told.
  void forget(std::uint32_t v) { hubs_.erase(v); }

  /// Whether hubs a and b have an edge.
  bool are_joined(std::uint32_t a, std::uint32_t b) const { return counts_.contains(key(a, b)); }
  bool have_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return counts_.contains(key(a, b, c));
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  using Key = std::array<std::uint32_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& k) const {
      std::uint64_t h = k[0];
      for (const std::uint32_t x : {k[1], k[2]}) h = (h ^ (h >> 32) ^ x) * 0x9e3779b97f4a7c15ull;
      return h ^ (h >> 32);
    }
  };
  static Key key(std::uint32_t a, std::uint32_t b, std::uint32_t c = kNone);
  void change(const Key& key, int by);
  void count(const Triangle& t, int by);
  void count_at(std::uint32_t v, const Triangle& t, int by);

  std::unordered_set<std::uint32_t> hubs_;
  std::unordered_map<Key, int, Hash> counts_;  // of triangles; never 0
};

}  // namespace viewcell

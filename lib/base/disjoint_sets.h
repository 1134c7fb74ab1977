// Sets of numbers, joined one after another.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace viewcell {

/// Each number in [0, n) begins in a set of its own. A set goes by its lowest member, whatever the
/// order of the joins. Memory: 4 bytes a number. Operations O(log n) on average: paths are halved,
/// sets are not weighed.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parents_(n) {
    std::iota(parents_.begin(), parents_.end(), 0u);
  }

  /// The lowest member of i's set.
  std::uint32_t find(std::uint32_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  /// True when a and b were in two sets.
  bool join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    if (a == b) return false;
    parents_[std::max(a, b)] = std::min(a, b);
    return true;
  }

 private:
  std::vector<std::uint32_t> parents_;
};

}  // namespace viewcell

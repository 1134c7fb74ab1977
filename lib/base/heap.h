// A binary min-heap of ids whose keys may change.
#pragma once

#include <cstdint>
#include <vector>

namespace viewcell {

/// Holds each id in [0, n) at most once, with a key. The least key is on top; equal keys are
/// ordered by id, so the order of pops does not depend on the order of pushes. All operations O(log
/// n).
class IndexedHeap {
 public:
  explicit IndexedHeap(std::uint32_t n) : place_(n, kAbsent), key_(n) {}

  bool empty() const { return ids_.empty(); }
  std::size_t size() const { return ids_.size(); }
  bool contains(std::uint32_t id) const { return place_[id] != kAbsent; }
  float key(std::uint32_t id) const { return key_[id]; }
  std::uint32_t top() const { return ids_[0]; }

  /// Inserts the id, or changes its key.
  void set(std::uint32_t id, float key);
  /// Takes the id out, if it is in.
  void erase(std::uint32_t id);
  void pop() { erase(top()); }

 private:
  static constexpr std::uint32_t kAbsent = 0xffffffffu;
  bool before(std::uint32_t a, std::uint32_t b) const {
    return key_[a] != key_[b] ? key_[a] < key_[b] : a < b;
  }
  void sift_up(std::uint32_t place);
  void sift_down(std::uint32_t place);

  std::vector<std::uint32_t> ids_;    // the heap
  std::vector<std::uint32_t> place_;  // id -> place in ids_
  std::vector<float> key_;            // id -> key
};

}  // namespace viewcell

// A min-heap of ids whose keys may change.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "base/large_vector.h"

namespace viewcell {

/// Holds each id in [0, n) at most once, with a key that is a number. The least key is on top;
/// equal keys are ordered by id, so the order of pops does not depend on the order of pushes. All
/// operations O(log n). Memory: 4 bytes an id of the range, 8 to 16 an id held.
class IndexedHeap {
 public:
  explicit IndexedHeap(std::uint32_t n) : slot_(n, kAbsent) {}

  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  bool contains(std::uint32_t id) const { return slot_[id] != kAbsent; }
  float key(std::uint32_t id) const { return key_of(at(slot_[id])); }
  std::uint32_t top() const { return id_of(at(0)); }
  /// The ids that come up next, as far as they are likely: the least child of the top one, that
  /// one's least child, and so on. kNone after the last.
  std::array<std::uint32_t, 5> next() const;
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// Inserts the id, or changes its key.
  void set(std::uint32_t id, float key);
  /// Takes the id out, if it is in.
  void erase(std::uint32_t id);
  void pop() { erase(top()); }

 private:
  // Four children a node: half the levels of two, and siblings lie in one cache line. The root has
  // slot 0, the children of i have 4 i + 1 to 4 i + 4; three unused entries in front keep each
  // four together.
  static constexpr std::uint32_t kChildren = 4, kFront = 3;
  // Key and id in one number whose order is that of key, then id.
  using Entry = std::uint64_t;
  static constexpr Entry kLast = ~Entry{0};  // after every other: where there is none
  struct alignas(kChildren * sizeof(Entry)) Family {
    std::array<Entry, kChildren> entries{kLast, kLast, kLast, kLast};
  };
  static constexpr std::uint32_t kAbsent = 0xffffffffu;
  static constexpr std::uint32_t kSign = 0x80000000u;

  static Entry make_entry(std::uint32_t id, float key) {
    const auto bits = std::bit_cast<std::uint32_t>(key + 0.0f);  // -0 becomes 0
    return Entry{bits & kSign ? ~bits : bits | kSign} << 32 | id;
  }
  static float key_of(Entry e) {
    const auto bits = static_cast<std::uint32_t>(e >> 32);
    return std::bit_cast<float>(bits & kSign ? bits & ~kSign : ~bits);
  }
  static std::uint32_t id_of(Entry e) { return static_cast<std::uint32_t>(e); }

  const Entry& at(std::uint32_t slot) const {
    return families_[(slot + kFront) / kChildren].entries[(slot + kFront) % kChildren];
  }
  Entry& at(std::uint32_t slot) { return const_cast<Entry&>(std::as_const(*this).at(slot)); }
  void put(std::uint32_t slot, Entry e) { at(slot) = e, slot_[id_of(e)] = slot; }
  std::uint32_t least_child(std::uint32_t slot) const;
  void sift_up(std::uint32_t slot, Entry e);
  void sift_down(std::uint32_t slot, Entry e);

  std::uint32_t size_ = 0;
  LargeVector<Family> families_;     // the heap
  LargeVector<std::uint32_t> slot_;  // id -> its slot in the heap
};

}  // namespace viewcell

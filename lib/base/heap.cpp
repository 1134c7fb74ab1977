#include "base/heap.h"

namespace viewcell {

// Unused entries come last of all, so that a family is always compared whole.
std::uint32_t IndexedHeap::least_child(std::uint32_t slot) const {
  const auto& [a, b, c, d] = families_[slot + 1].entries;
  const Entry ab = a < b ? a : b, cd = c < d ? c : d;
  const std::uint32_t in_ab = a < b ? 1 : 2, in_cd = c < d ? 3 : 4;
  return kChildren * slot + (ab < cd ? in_ab : in_cd);
}

std::array<std::uint32_t, 5> IndexedHeap::next() const {
  std::array<std::uint32_t, 5> ids;
  ids.fill(kNone);
  std::uint32_t slot = 0;
  for (std::uint32_t& id : ids) {
    if (slot + 1 >= families_.size()) break;
    slot = least_child(slot);
    id = id_of(at(slot));
  }
  return ids;
}

void IndexedHeap::set(std::uint32_t id, float key) {
  const Entry e = make_entry(id, key);
  if (slot_[id] == kAbsent) {
    if ((size_ + kFront) / kChildren >= families_.size()) families_.emplace_back();
    return sift_up(size_++, e);
  }
  e < at(slot_[id]) ? sift_up(slot_[id], e) : sift_down(slot_[id], e);
}

void IndexedHeap::erase(std::uint32_t id) {
  const std::uint32_t hole = slot_[id];
  if (hole == kAbsent) return;
  const Entry last = at(--size_), erased = at(hole);
  at(size_) = kLast;
  slot_[id] = kAbsent;
  if (hole != size_) last < erased ? sift_up(hole, last) : sift_down(hole, last);
}

void IndexedHeap::sift_up(std::uint32_t slot, Entry e) {
  while (slot > 0) {
    const std::uint32_t parent = (slot - 1) / kChildren;
    if (at(parent) < e) break;
    put(slot, at(parent));
    slot = parent;
  }
  put(slot, e);
}

void IndexedHeap::sift_down(std::uint32_t slot, Entry e) {
  while (slot + 1 < families_.size()) {
    const std::size_t grandchildren = std::size_t{kChildren} * slot + 2;
    if (grandchildren + 3 < families_.size()) {
      __builtin_prefetch(&families_[grandchildren]);
      __builtin_prefetch(&families_[grandchildren + 2]);
    }
    const std::uint32_t child = least_child(slot);
    if (e < at(child)) break;
    put(slot, at(child));
    slot = child;
  }
  put(slot, e);
}

}  // namespace viewcell

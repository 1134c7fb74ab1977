#include "base/heap.h"

namespace viewcell {

// Unused entries come last of all, so that a family is always compared whole.
std::uint32_t IndexedHeap::least_child(std::uint32_t place) const {
  const auto& [a, b, c, d] = families_[place + 1].entries;
  const Entry ab = a < b ? a : b, cd = c < d ? c : d;
  const std::uint32_t in_ab = a < b ? 1 : 2, in_cd = c < d ? 3 : 4;
  return kChildren * place + (ab < cd ? in_ab : in_cd);
}

std::array<std::uint32_t, 5> IndexedHeap::next() const {
  std::array<std::uint32_t, 5> ids;
  ids.fill(kNone);
  std::uint32_t place = 0;
  for (std::uint32_t& id : ids) {
    if (place + 1 >= families_.size()) break;
    place = least_child(place);
    id = id_of(at(place));
  }
  return ids;
}

void IndexedHeap::set(std::uint32_t id, float key) {
  const Entry e = make_entry(id, key);
  if (place_[id] == kAbsent) {
    if ((size_ + kFront) / kChildren >= families_.size()) families_.emplace_back();
    return sift_up(size_++, e);
  }
  e < at(place_[id]) ? sift_up(place_[id], e) : sift_down(place_[id], e);
}

void IndexedHeap::erase(std::uint32_t id) {
  const std::uint32_t hole = place_[id];
  if (hole == kAbsent) return;
  const Entry last = at(--size_), gone = at(hole);
  at(size_) = kLast;
  place_[id] = kAbsent;
  if (hole != size_) last < gone ? sift_up(hole, last) : sift_down(hole, last);
}

void IndexedHeap::sift_up(std::uint32_t place, Entry e) {
  while (place > 0) {
    const std::uint32_t parent = (place - 1) / kChildren;
    if (at(parent) < e) break;
    put(place, at(parent));
    place = parent;
  }
  put(place, e);
}

void IndexedHeap::sift_down(std::uint32_t place, Entry e) {
  while (place + 1 < families_.size()) {
    const std::size_t grandchildren = std::size_t{kChildren} * place + 2;
    if (grandchildren + 3 < families_.size()) {
      __builtin_prefetch(&families_[grandchildren]);
      __builtin_prefetch(&families_[grandchildren + 2]);
    }
    const std::uint32_t child = least_child(place);
    if (e < at(child)) break;
    put(place, at(child));
    place = child;
  }
  put(place, e);
}

}  // namespace viewcell

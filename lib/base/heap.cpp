#include "base/heap.h"

namespace viewcell {

void IndexedHeap::set(std::uint32_t id, float key) {
  if (place_[id] == kAbsent) {
    key_[id] = key;
    place_[id] = static_cast<std::uint32_t>(ids_.size());
    ids_.push_back(id);
    sift_up(place_[id]);
    return;
  }
  const bool sooner = key < key_[id];
  key_[id] = key;
  sooner ? sift_up(place_[id]) : sift_down(place_[id]);
}

void IndexedHeap::erase(std::uint32_t id) {
  const std::uint32_t hole = place_[id];
  if (hole == kAbsent) return;
  const std::uint32_t last = ids_.back();
  ids_.pop_back();
  place_[id] = kAbsent;
  if (last == id) return;
  ids_[hole] = last;
  place_[last] = hole;
  sift_up(hole);
  sift_down(place_[last]);
}

void IndexedHeap::sift_up(std::uint32_t place) {
  const std::uint32_t id = ids_[place];
  while (place > 0) {
    const std::uint32_t parent = (place - 1) / 2;
    if (!before(id, ids_[parent])) break;
    ids_[place] = ids_[parent];
    place_[ids_[place]] = place;
    place = parent;
  }
  ids_[place] = id;
  place_[id] = place;
}

void IndexedHeap::sift_down(std::uint32_t place) {
  const std::uint32_t id = ids_[place];
  const auto n = static_cast<std::uint32_t>(ids_.size());
  for (;;) {
    std::uint32_t child = 2 * place + 1;
    if (child >= n) break;
    if (child + 1 < n && before(ids_[child + 1], ids_[child])) ++child;
    if (!before(ids_[child], id)) break;
    ids_[place] = ids_[child];
    place_[ids_[place]] = place;
    place = child;
  }
  ids_[place] = id;
  place_[id] = place;
}

}  // namespace viewcell

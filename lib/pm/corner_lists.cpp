#include "pm/corner_lists.h"

#include <algorithm>
#include <utility>

namespace viewcell {

CornerLists::CornerLists(std::span<const std::uint32_t> vertices, std::vector<bool> alive,
                         std::size_t n_vertices)
    : alive_(std::move(alive)), stars_(n_vertices) {
  for (std::uint32_t c = 0; c < vertices.size(); ++c)
    if (alive_[c / 3]) ++stars_[vertices[c]].n, ++n_listed_;
  corners_.reserve(n_listed_ + n_listed_ / 4);  // room for a quarter of new lists
  corners_.resize(n_listed_);
  std::uint32_t end = 0;
  for (std::uint32_t v = 0; v < n_vertices; ++v) {
    if (is_hub(v)) hubs_[v] = {};
    stars_[v].first = end;
    end += std::exchange(stars_[v].n, 0);
  }
  for (std::uint32_t c = 0; c < vertices.size(); ++c) {
    if (!alive_[c / 3]) continue;
    Star& star = stars_[vertices[c]];
    corners_[star.first + star.n++] = c;
  }
}

void CornerLists::unlink(std::uint32_t v, std::uint32_t corner) {
  Star& star = stars_[v];
  --n_listed_;
  if (is_hub(v)) [[unlikely]] {
    ++hubs_[v].n_dead;
    if (--star.n > kHubTriangles) return;
    tidy(v);
    hubs_.erase(v);
    shrunk_.push_back(v);
    return;
  }
  std::uint32_t* at = &corners_[star.first];
  while (*at != corner) ++at;
  const std::uint32_t* const last = &corners_[star.first] + --star.n;
  for (; at != last; ++at) *at = at[1];
}

// Closes the gaps of the dead corners of a hub.
void CornerLists::tidy(std::uint32_t v) const {
  Hub& hub = hubs_[v];
  if (hub.n_dead == 0) return;
  const Star star = stars_[v];
  n_visited_ += hub.n_dead;
  const auto first = corners_.begin() + star.first;
  std::remove_if(first, first + star.n + hub.n_dead,
                 [this](std::uint32_t c) { return !alive_[c / 3]; });
  hub.n_dead = 0;
}

// Takes the dead corners at the beginning of a hub's list away; all, where they are many.
void CornerLists::trim(std::uint32_t v) const {
  Hub& hub = hubs_[v];
  if (hub.n_dead > stars_[v].n) tidy(v);
  while (!alive_[corners_[stars_[v].first] / 3]) ++stars_[v].first, --hub.n_dead, ++hub.room;
}

// Room for n more corners at the end: moves the lists together, in the order of the vertices, when
// there is none. Hubs get room in front for as many corners as they have.
void CornerLists::make_room(std::size_t n) {
  if (corners_.size() + n <= corners_.capacity()) return;
  std::size_t n_hub_corners = 0;
  for (const auto& [v, hub] : hubs_) n_hub_corners += stars_[v].n;
  LargeVector<std::uint32_t> packed;
  packed.reserve(std::max(corners_.capacity(), n_listed_ + 2 * n_hub_corners + n));
  for (std::uint32_t v = 0; v < stars_.size(); ++v) {
    const auto list = visit(v);
    if (is_hub(v)) {
      hubs_[v].room = stars_[v].n;
      packed.resize(packed.size() + stars_[v].n);
    }
    stars_[v].first = static_cast<std::uint32_t>(packed.size());
    packed.insert(packed.end(), list.begin(), list.end());
  }
  corners_ = std::move(packed);
}

// The list of v goes behind the corners that were put at the end from `first` on.
void CornerLists::append_rest(std::uint32_t v, std::uint32_t first) {
  const auto rest = visit(v);
  corners_.insert(corners_.end(), rest.begin(), rest.end());
  stars_[v] = {first, static_cast<std::uint32_t>(corners_.size()) - first};
  if (is_hub(v)) hubs_[v] = {};
}

// merged_ goes in front of the list of v, which was a hub.
void CornerLists::prepend(std::uint32_t v) {
  const auto n = static_cast<std::uint32_t>(merged_.size());
  if (!is_hub(v)) {
    make_room(n + stars_[v].n);
    const auto first = static_cast<std::uint32_t>(corners_.size());
    corners_.insert(corners_.end(), merged_.begin(), merged_.end());
    append_rest(v, first);
    std::erase(shrunk_, is_hub(v) ? v : kNone);
    return;
  }
  if (hubs_[v].room < n) make_room(2 * stars_[v].n + n);
  Star& star = stars_[v];
  Hub& hub = hubs_[v];
  if (hub.room < n) {  // a place of its own at the end
    const auto list = visit(v);
    hub.room = star.n + n;
    corners_.resize(corners_.size() + hub.room);
    star.first = static_cast<std::uint32_t>(corners_.size());
    corners_.insert(corners_.end(), list.begin(), list.end());
  }
  std::copy(merged_.begin(), merged_.end(), corners_.begin() + star.first - n);
  star.first -= n, star.n += n, hub.room -= n;
}

void CornerLists::clear(std::uint32_t v) {
  if (is_hub(v)) hubs_.erase(v);
  stars_[v] = {};
}

}  // namespace viewcell

#include "pm/collapse_bound.h"

#include <limits>
#include <utility>

namespace viewcell {
namespace {

constexpr float kNever = std::numeric_limits<float>::infinity();

}  // namespace

float CollapseBound::look(std::uint32_t u, std::uint32_t v) {
  change_.clear();
  if (!map_.lay(u, v)) return kNever;
  boxes_.add(map_, change_);
  return DeviationBoxes::reach(change_);
}

// One moves, the other collapses into it: either may be the one, whichever brings them less far.
float CollapseBound::look(std::uint32_t u, std::uint32_t v, const glm::vec3& place) {
  const glm::dvec3 to(place);
  const float first = add_full(u, v, to) ? DeviationBoxes::reach(change_) : kNever;
  std::swap(change_, other_);
  const float second = add_full(v, u, to) ? DeviationBoxes::reach(change_) : kNever;
  if (second < first) return second;
  std::swap(change_, other_);
  return first;
}

bool CollapseBound::add_full(std::uint32_t gone, std::uint32_t kept, const glm::dvec3& place) {
  change_.clear();
  if (!map_.lay_move(kept, place)) return false;
  boxes_.add(map_, change_);
  if (!map_.lay(gone, kept, place)) return false;
  boxes_.add(map_, change_);
  return true;
}

void CollapseBound::take() {
  boxes_.take(change_);
  map_.forget();
}

}  // namespace viewcell

// How far a collapse of any kind would take a mesh from its input.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "pm/deviation_boxes.h"
#include "pm/deviation_moments.h"

namespace viewcell {

/// Looks at collapses, half-edge or full-edge, through their maps (Matching::nearest), and takes
/// those that are made. Deviations: DeviationBoxes or DeviationMoments.
template <typename Deviations>
class CollapseLook {
 public:
  /// Keeps references. texcoords: of wedges, for maps that keep to texture charts; empty: charts
  /// do not matter.
  CollapseLook(const CollapseMesh& mesh, const WedgeTable& wedges,
               std::span<const glm::vec3> positions, Deviations deviations,
               std::span<const glm::vec2> texcoords = {})
      : positions_(positions),
        map_(mesh, wedges, positions, texcoords, Matching::nearest,
             {.moments = Deviations::kMoments}),
        deviations_(std::move(deviations)) {}

  /// Deviations::cost() of the collapse; infinite when it has no map.
  float look(std::uint32_t u, std::uint32_t v) {
    change_.clear();
    is_mapped_ = map_.lay(u, v);
    if (!is_mapped_) return kNever;
    deviations_.add(map_, change_);
    return deviations_.cost(change_);
  }
  /// The same for both vertices going to `place`. One moves, the other collapses into it: either
  /// may be the one, whichever costs less. Where v is there already, the collapse of u into v.
  float look(std::uint32_t u, std::uint32_t v, const glm::vec3& place) {
    if (place == positions_[v]) return look(u, v);
    if (u > v) std::swap(u, v);  // the same sums from either side
    const float first = look_full(u, v, glm::dvec3(place));
    std::swap(change_, other_);
    const float second = look_full(v, u, glm::dvec3(place));
    if (!(second < first)) std::swap(change_, other_);
    is_mapped_ = std::min(first, second) < kNever;
    return std::min(first, second);
  }
  /// The collapse last looked at is made; without a map nothing is known any more.
  void take() {
    is_mapped_ ? deviations_.take(change_) : deviations_.lose();
    map_.forget();
  }
  const Deviations& deviations() const { return deviations_; }

 private:
  static constexpr float kNever = std::numeric_limits<float>::infinity();

  float look_full(std::uint32_t gone, std::uint32_t kept, const glm::dvec3& place) {
    change_.clear();
    if (!map_.lay_move(kept, place)) return kNever;
    deviations_.add(map_, change_);
    if (!map_.lay(gone, kept, place)) return kNever;
    deviations_.add(map_, change_);
    return deviations_.cost(change_);
  }

  std::span<const glm::vec3> positions_;
  CollapseMap map_;
  Deviations deviations_;
  typename Deviations::Change change_, other_;
  bool is_mapped_ = true;  // the collapse last looked at
};

/// Costs are bounds of the distance of the points concerned, from the input and back.
using CollapseBound = CollapseLook<DeviationBoxes>;

}  // namespace viewcell

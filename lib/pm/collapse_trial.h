// The deviation from the input that a collapse would cause, measured before it is made.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "pm/deviation_boxes.h"
#include "pm/deviation_moments.h"

namespace viewcell {

/// Measures the deviation that a collapse, half-edge or full-edge, would cause, by its map
/// (Matching::nearest), and keeps the deviations of the mesh up to date with the collapses that are
/// made. Deviations: DeviationBoxes or DeviationMoments.
template <typename Deviations>
class CollapseTrial {
 public:
  /// Keeps references. texcoords: of wedges, for maps that keep to texture charts; empty: charts
  /// do not matter.
  CollapseTrial(const CollapseMesh& mesh, const WedgeTable& wedges,
                std::span<const glm::vec3> positions, Deviations deviations,
                std::span<const glm::vec2> texcoords = {})
      : positions_(positions),
        map_(mesh, wedges, positions, texcoords, Matching::nearest,
             {.moments = Deviations::kMoments}),
        deviations_(std::move(deviations)) {}

  /// Deviations::cost() of the collapse; infinite when it has no map.
  float measure(std::uint32_t u, std::uint32_t v) {
    change_.clear();
    is_mapped_ = map_.build(u, v);
    if (!is_mapped_) return kNever;
    deviations_.add(map_, change_);
    return deviations_.cost(change_);
  }
  /// The same for the full-edge collapse of both vertices into `position`: one moves there, then
  /// the other collapses into it; of the two orders, the one that costs less. Where v is there
  /// already, the collapse of u into v.
  float measure(std::uint32_t u, std::uint32_t v, const glm::vec3& position) {
    if (position == positions_[v]) return measure(u, v);
    if (u > v) std::swap(u, v);  // the same sums from either side
    const float first = measure_full(u, v, glm::dvec3(position));
    std::swap(change_, other_);
    const float second = measure_full(v, u, glm::dvec3(position));
    if (!(second < first)) std::swap(change_, other_);
    is_mapped_ = std::min(first, second) < kNever;
    return std::min(first, second);
  }
  /// The collapse measured last is made. If it had no map, the deviations are unknown from now on.
  void accept() {
    is_mapped_ ? deviations_.accept(change_) : deviations_.invalidate();
    map_.forget();
  }
  /// Of the collapse measured last: Deviations::vanished_reach().
  float vanished_reach() const { return deviations_.vanished_reach(change_); }
  /// A piece vanishes by this map.
  void accept(const VanishMap& map) { deviations_.accept(map); }
  const Deviations& deviations() const { return deviations_; }

 private:
  static constexpr float kNever = std::numeric_limits<float>::infinity();

  float measure_full(std::uint32_t removed, std::uint32_t kept, const glm::dvec3& position) {
    change_.clear();
    if (!map_.build_move(kept, position)) return kNever;
    deviations_.add(map_, change_);
    if (!map_.build(removed, kept, position)) return kNever;
    deviations_.add(map_, change_);
    return deviations_.cost(change_);
  }

  std::span<const glm::vec3> positions_;
  CollapseMap map_;
  Deviations deviations_;
  typename Deviations::Change change_, other_;
  bool is_mapped_ = true;  // the collapse measured last
};

/// Costs bound the distance between the faces that change and the input, both ways.
using CollapseBound = CollapseTrial<DeviationBoxes>;

}  // namespace viewcell

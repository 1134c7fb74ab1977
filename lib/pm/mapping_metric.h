// Metrics that map the surface before a collapse onto the one after it: APS and the mapping-based
// metric.
#pragma once

#include <limits>
#include <span>
#include <utility>

#include "pm/collapse_trial.h"
#include "pm/lindstrom_turk.h"

namespace viewcell {

/// What cost() is made of: the largest distance of matched points, or the mean of their squares
/// over the input's surface [Chen06 4.2.2 has a mean over texels instead, which weighs a face by
/// its area in the texture].
enum class Measure { max, mean };

struct MappingOptions {
  Matching matching = Matching::nearest;  ///< texture: APS [Cohen 1998]; nearest: [Chen06 4]
  /// true: distance to the input, by boxes of deviations, passed from face to face [Cohen
  /// 1998 4.3]; false: distance to the mesh before the collapse.
  bool total = true;
  Measure measure = Measure::max;
};

/// Half-edge collapses. With Measure::max cost(u, v) is the largest distance of matched points over
/// the faces that change: with `total` a bound on the distance of every point there from the input
/// and back, for the map covers both surfaces.
/// With Measure::mean it is the root of what the collapse adds to the mean squared distance over
/// the surface (`total`: from the input): area, mean and mean square of the points' deviations are
/// passed from the old faces to the new ones; within a face the deviations are assumed to be
/// independent of the next collapse's shift.
/// Follows: [Chen06 4.2.1], [Cohen 1998].
class MappingMetric {
 public:
  static constexpr int kReach = 2;

  /// Keeps references.
  MappingMetric(const CollapseMesh& mesh, const WedgeTable& wedges,
                std::span<const glm::vec3> positions, std::span<const glm::vec2> texcoords,
                std::span<const Triangle> triangles, const MappingOptions& options = {});

  float cost(std::uint32_t u, std::uint32_t v);
  /// cost(u, v) is not below this; a fraction of its time.
  float cost_at_least(std::uint32_t u, std::uint32_t v);
  bool allows(const CollapseMesh&, std::uint32_t u, std::uint32_t v);
  void collapsed(std::uint32_t u, std::uint32_t v);
  /// With `total` and Measure::max: no point of the mesh, nor of the input, is farther than this
  /// from the other surface; otherwise below 0.
  float bound() const { return is_bound() ? boxes_.bound() : -1; }
  /// How far what has vanished would be off after the collapse that was allowed last; 0 where there
  /// is no bound. Costs say nothing of it.
  float vanished_reach() const { return is_bound() ? boxes_.vanished_reach(boxes_change_) : 0; }
  /// The same for a piece that vanishes.
  float vanish_reach(const VanishMap& map) const {
    return is_bound() ? boxes_.vanish_reach(map) : 0;
  }
  void vanished(const VanishMap& map) {
    if (is_bound()) boxes_.accept(map);
  }

 private:
  bool is_bound() const { return options_.total && options_.measure == Measure::max; }
  float add_up();

  MappingOptions options_;
  CollapseMap map_;
  DeviationBoxes boxes_;  // with Measure::max
  DeviationBoxes::Change boxes_change_;
  DeviationMoments moments_;  // with Measure::mean
  DeviationMoments::Change moments_change_;
};

/// Full-edge collapses in the order of what they would do to the distance from the input (total,
/// Matching::nearest), each into the position that LindstromTurkMetric finds. Needs no texture
/// coordinates. Deviations: DeviationBoxes for Measure::max, DeviationMoments for Measure::mean.
template <typename Deviations>
class MappingFullMetric {
 public:
  static constexpr int kReach = 2;

  /// Keeps references; moves positions. texcoords: of wedges; empty without.
  MappingFullMetric(CollapseMesh& mesh, const WedgeTable& wedges, std::span<glm::vec3> positions,
                    std::span<const glm::vec2> texcoords, Deviations deviations,
                    const LindstromTurkOptions& options = {})
      : positioner_(mesh, positions, options),
        trial_(mesh, wedges, positions, std::move(deviations), texcoords) {}

  float cost(std::uint32_t u, std::uint32_t v) {
    return cost_at(u, v, positioner_.optimal_position(u, v));
  }
  float cost_at(std::uint32_t u, std::uint32_t v, const glm::vec3& position) {
    return trial_.measure(u, v, position);
  }
  glm::vec3 optimal_position(std::uint32_t u, std::uint32_t v) {
    return positioner_.optimal_position(u, v);
  }
  bool allows(const CollapseMesh&, std::uint32_t u, std::uint32_t v, const glm::vec3& position) {
    return cost_at(u, v, position) < std::numeric_limits<float>::infinity();
  }
  void traced(std::uint32_t u, std::uint32_t v, const CollapseTrace& trace) {
    positioner_.traced(u, v, trace);
  }
  void collapsed(std::uint32_t u, std::uint32_t v, const glm::vec3& position) {
    positioner_.collapsed(u, v, position);
    trial_.accept();
  }
  /// As MappingMetric::bound().
  float bound() const {
    if constexpr (kBounds) return trial_.deviations().bound();
    return -1;
  }
  /// As of MappingMetric.
  float vanished_reach() const {
    if constexpr (kBounds) return trial_.vanished_reach();
    return 0;
  }
  float vanish_reach(const VanishMap& map) const {
    if constexpr (kBounds) return trial_.deviations().vanish_reach(map);
    return 0;
  }
  void vanished(const VanishMap& map) {
    if constexpr (kBounds) trial_.accept(map);
  }

 private:
  static constexpr bool kBounds = requires(const Deviations d) { d.bound(); };

  LindstromTurkMetric positioner_;
  CollapseTrial<Deviations> trial_;
};

}  // namespace viewcell

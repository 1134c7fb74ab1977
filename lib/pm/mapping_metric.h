// Metrics that map the surface before a collapse onto the one after it: APS and the mapping-based
// metric.
#pragma once

#include <vector>

#include "pm/collapse_map.h"

namespace viewcell {

struct MappingOptions {
  Matching matching = Matching::nearest;  ///< texture: APS [Cohen 1998]; nearest: [Chen06 4]
  /// true: distance to the input, by boxes of deviations that faces hand on [Cohen 1998 4.3];
  /// false: distance to the mesh before the collapse.
  bool total = true;
};

/// Half-edge collapses. cost(u, v) is the largest distance of matched points over the faces that
/// change: with `total` a bound on the distance of every point there from the input and back, for
/// both surfaces are covered by the map.
/// Follows: [Chen06 4.2.1], [Cohen, Olano, Manocha 1998].
class MappingMetric {
 public:
  static constexpr int kReach = 2;

  /// Keeps references.
  MappingMetric(const CollapseMesh& mesh, const WedgeTable& wedges,
                std::span<const glm::vec3> positions, std::span<const glm::vec2> texcoords,
                std::size_t n_faces, const MappingOptions& options = {});

  float cost(std::uint32_t u, std::uint32_t v);
  /// Not when a face would turn over in the texture (Refusal::fold).
  Refusal allows(const CollapseMesh&, std::uint32_t u, std::uint32_t v);
  void collapsed(std::uint32_t u, std::uint32_t v);
  /// The largest deviation of any face that was made so far; a bound with `total` only.
  float bound() const { return bound_; }

 private:
  struct Deviation {
    std::uint32_t face;
    VectorBox box;
  };
  void add_up();

  MappingOptions options_;
  CollapseMap map_;
  std::vector<VectorBox> boxes_;  // by face: deviations from the input
  std::vector<Deviation> next_;   // of the faces of the last map
  float bound_ = 0;
};

}  // namespace viewcell

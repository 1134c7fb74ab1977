// The quadric error metric for half-edge collapses, as a metric of CollapseLoop.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "pm/collapse_mesh.h"
#include "pm/quadric.h"

namespace viewcell {

/// Follows: [Garland, Heckbert 1997], planes weighted by triangle area, boundary edges held by
/// planes at right angles to their triangle. cost(u, v) is a distance in the mesh's units: the root
/// of the area-weighted mean square of v's distances to all planes that u and v have gathered.
/// Positions are moved to the box's centre first, against cancellation.
class QemMetric {
 public:
  QemMetric(std::span<const glm::vec3> positions, std::span<const Triangle> triangles);

  float cost(std::uint32_t u, std::uint32_t v) const {
    const glm::dvec3 p = glm::dvec3(positions_[v]) - centre_;
    const double weight = quadrics_[u].weight + quadrics_[v].weight;
    const double value = quadrics_[u].value(p) + quadrics_[v].value(p);
    return weight > 0 ? static_cast<float>(std::sqrt(std::max(value, 0.0) / weight)) : 0.0f;
  }
  bool allows(const CollapseMesh&, std::uint32_t, std::uint32_t) const { return true; }
  void collapsed(std::uint32_t u, std::uint32_t v) { quadrics_[v].add(quadrics_[u]); }

 private:
  std::span<const glm::vec3> positions_;
  glm::dvec3 centre_;
  std::vector<Quadric> quadrics_;
};

}  // namespace viewcell

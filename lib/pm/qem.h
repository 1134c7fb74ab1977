// The quadric error metric, for half-edge and full-edge collapses, as metrics of CollapseLoop.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "pm/border_edges.h"
#include "pm/collapse_mesh.h"
#include "pm/quadric.h"

namespace viewcell {

struct QemOptions {
  bool area_weighted = true;  ///< false: every plane counts alike [Chen06 2.2.3]
  /// true: the cost is the weighted mean of squared distances, so that a large patch may not drift
  /// more than a small one; false: their sum, as Garland and Heckbert have it, over the whole area.
  bool mean = true;
  /// Boundary edges count as this many times their squared length in area: enough to keep a
  /// boundary's shape, not so much that it is never simplified [Garland 1999 3.4.1].
  double boundary_weight = 10;
};

/// The quadrics of all vertices: sums over their triangles' planes, and over planes through
/// boundary edges at right angles to their triangle. Positions are taken relative to `centre`,
/// against cancellation.
LargeVector<Quadric> make_quadrics(std::span<const glm::vec3> positions,
                                   std::span<const Triangle> triangles, const glm::dvec3& centre,
                                   const QemOptions& options = {});
/// The part of them that boundary edges make.
LargeVector<Quadric> make_boundary_quadrics(std::span<const glm::vec3> positions,
                                            std::span<const Triangle> triangles,
                                            const glm::dvec3& centre, const QemOptions& options);
/// The quadrics of the planes through edges at right angles to their triangles.
LargeVector<Quadric> sum_border_planes(const std::vector<BorderEdge>& edges,
                                       std::span<const glm::vec3> positions,
                                       std::span<const Triangle> triangles,
                                       const glm::dvec3& centre, const QemOptions& options);
glm::dvec3 box_centre(std::span<const glm::vec3> positions);

/// Turns a value and the weight behind it into a cost: a distance in the mesh's units.
struct QuadricScale {
  bool mean = true;
  double whole = 1;  ///< of a sum: what it is divided by, the area of the whole surface
  float cost(double value, double weight) const {
    if (!(weight > 0)) return 0;
    return static_cast<float>(std::sqrt(std::max(value, 0.0) / (mean ? weight : whole)));
  }
};
QuadricScale make_quadric_scale(std::span<const glm::vec3> positions,
                                std::span<const Triangle> triangles, const QemOptions& options);

/// Half-edge collapses. Follows: [Garland, Heckbert 1997].
class QemMetric {
 public:
  QemMetric(std::span<const glm::vec3> positions, std::span<const Triangle> triangles,
            const QemOptions& options = {})
      : positions_(positions),
        centre_(box_centre(positions)),
        scale_(make_quadric_scale(positions, triangles, options)),
        quadrics_(make_quadrics(positions, triangles, centre_, options)) {}

  float cost(std::uint32_t u, std::uint32_t v) const {
    const glm::dvec3 p = glm::dvec3(positions_[v]) - centre_;
    return scale_.cost(quadrics_[u].value(p) + quadrics_[v].value(p),
                       quadrics_[u].weight + quadrics_[v].weight);
  }
  void fetch(std::uint32_t v) const {
    __builtin_prefetch(&positions_[v]);
    __builtin_prefetch(&quadrics_[v]);
    __builtin_prefetch(&quadrics_[v].c);
  }
  bool allows(const CollapseMesh&, std::uint32_t, std::uint32_t) const { return true; }
  void collapsed(std::uint32_t u, std::uint32_t v) { quadrics_[v].add(quadrics_[u]); }

 private:
  std::span<const glm::vec3> positions_;
  glm::dvec3 centre_;
  QuadricScale scale_;
  LargeVector<Quadric> quadrics_;
};

/// Full-edge collapses into the point where the quadrics' sum is least. Moves positions.
class QemFullMetric {
 public:
  QemFullMetric(std::span<glm::vec3> positions, std::span<const Triangle> triangles,
                const QemOptions& options = {})
      : positions_(positions),
        centre_(box_centre(positions)),
        scale_(make_quadric_scale(positions, triangles, options)),
        quadrics_(make_quadrics(positions, triangles, centre_, options)) {}

  float cost(std::uint32_t u, std::uint32_t v) const {
    const Quadric sum = sum_of(u, v);
    return scale_.cost(sum.value(least(sum, u, v)), sum.weight);
  }
  float cost_at(std::uint32_t u, std::uint32_t v, const glm::vec3& position) const {
    const Quadric sum = sum_of(u, v);
    return scale_.cost(sum.value(glm::dvec3(position) - centre_), sum.weight);
  }
  glm::vec3 optimal_position(std::uint32_t u, std::uint32_t v) const {
    return glm::vec3(centre_ + least(sum_of(u, v), u, v));
  }
  bool allows(const CollapseMesh&, std::uint32_t, std::uint32_t) const { return true; }
  void collapsed(std::uint32_t u, std::uint32_t v, const glm::vec3& position) {
    quadrics_[v].add(quadrics_[u]);
    positions_[v] = position;
  }

 private:
  Quadric sum_of(std::uint32_t u, std::uint32_t v) const {
    Quadric sum = quadrics_[std::min(u, v)];
    sum.add(quadrics_[std::max(u, v)]);
    return sum;
  }
  glm::dvec3 least(const Quadric& sum, std::uint32_t u, std::uint32_t v) const {
    return sum.minimiser(0.5 * (glm::dvec3(positions_[u]) + glm::dvec3(positions_[v])) - centre_);
  }

  std::span<glm::vec3> positions_;
  glm::dvec3 centre_;
  QuadricScale scale_;
  LargeVector<Quadric> quadrics_;
};

}  // namespace viewcell

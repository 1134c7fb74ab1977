// The cost of collapses that a view cell sees, as a metric of CollapseLoop.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/large_vector.h"
#include "pm/collapse_mesh.h"
#include "pm/quadric.h"

namespace viewcell {

/// What the metric knows of each vertex of the mesh that is collapsed. Arrays of one length.
struct ViewVertices {
  std::vector<glm::vec3> positions;  ///< world
  std::vector<glm::vec3> normals;    ///< world, unit
  std::vector<float> weights;        ///< [Chen06 5.2.1]: 0.5 silhouette ... 0.05 invisible
  std::vector<std::uint8_t> views;   ///< bit k: visible from view k
};

struct ViewMetricOptions {
  glm::dvec3 centre{0};             ///< of the cell
  std::vector<glm::dvec3> samples;  ///< points of the cell over which pixels are averaged
  double radius = 0;                ///< of the ball around the cell
  double focal_px = 887;            ///< pixels per unit tangent
  bool keep_common_views = false;  ///< MVMesh: u and v, and each new triangle, share a view or none
  double tl_px = 4.5;              ///< T_l
  double max_drift_px = 0.5;       ///< see ViewMetric
  bool has_rim = false;            ///< some edge has one triangle
  std::span<const std::uint32_t> parts = {};    ///< of each vertex, its part of the surface
  std::span<const double> part_diagonals = {};  ///< of each part, world units
  std::vector<bool> is_shared = {};             ///< by vertex: it stays where it is; or empty
};

/// Follows: [Chen06 5.2.1], paper(u, v) = (1.5 - n_u . n_v)^2 l (w_u + w_v); the vertex of smaller
/// weight collapses. A vertex keeps its own normal, weight and views when others collapse into it.
///
/// Differs (no term bounds deviation): cost(u, v) = max(paper, T_l drift / max_drift), so
/// that collapsing ends when either reaches T_l. drift, in px, is rms (P / 50)^(1/4): rms the root
/// mean square of v's distances d to the planes of the triangles that it comes to stand for,
/// sqrt(sum A s^2 d^2 / sum A s), P = sum A s in px^2, with A their areas and s how much a
/// displacement there shows:
///   1 where the surface is seen edge-on from some point of the cell, or is a silhouette by the
///   paper's weights, falling to the parallax that a displacement of a facing surface causes, half
///   the cell's size over the distance: the texture is projected, so only its depth is wrong.
/// It is no less than half the rms over u's part alone: otherwise a thin part that collapses into
/// a broad one would hardly count, and leave a spike. The fourth root stands halfway between the
/// same rms everywhere, which spends triangles on small patches, and the least sum of squares,
/// which leaves the large ones crude. Pixels, in l and drift, are root mean squares over points of
/// the cell (`samples`): by the nearest point alone, objects next to a cell would hardly be
/// simplified at all.
///
/// Rims of the surface that a view shows drift likewise, from the planes through their edges at
/// right angles to their triangles. Within max_drift a small part may still lose much of itself:
/// of the parts that views show and that are less than kSmallPart times max_drift across, no more
/// than kMostLost of their area goes, all together, and none vanishes.
class ViewMetric {
 public:
  ViewMetric(const ViewVertices& vertices, std::span<const Triangle> triangles,
             const ViewMetricOptions& options);

  float cost(std::uint32_t u, std::uint32_t v) const;
  bool allows(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v) const;
  void collapsed(std::uint32_t u, std::uint32_t v) {
    quadrics_[v].add(quadrics_[u]);
    if (!rims_.empty()) rims_[v].add(rims_[u]);
    lost_px2_ += asked_px2_;
  }
  /// How far v moves along its normal to the least squared distance from the planes that it stands
  /// for, world units, at most max_drift_px. Half-edge collapses keep vertices of a convex surface,
  /// so its chords all lie inside: this removes that bias of silhouettes.
  float offset(std::uint32_t v) const;

 private:
  void add_quadrics(std::span<const Triangle> triangles);
  void add_views();
  void add_rims(std::span<const Triangle> triangles);
  void find_small_parts(std::span<const Triangle> triangles);
  bool is_small(std::uint32_t v) const {
    return !is_small_part_.empty() && is_small_part_[options_.parts[v]];
  }
  bool keeps_common_views(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v) const;
  double area_px2(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  double loss_px2(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v) const;
  double drift_px(std::uint32_t u, std::uint32_t v) const;
  float projected_length_px(std::uint32_t u, std::uint32_t v) const;

  const ViewVertices& vertices_;
  const ViewMetricOptions& options_;
  glm::dvec3 origin_;  // of the quadrics
  std::vector<Quadric> quadrics_;
  std::vector<float> px_per_unit_;     // at each vertex
  std::vector<glm::vec3> directions_;  // unit, from the cell's centre
  std::vector<float> spread_;          // sine of half the angle under which it sees the cell
  std::vector<float> show_;            // how much a displacement shows, 0 to 1
  LargeVector<Quadric> rims_;          // or empty
  std::vector<bool> is_small_part_;    // by part: small, and views show it; or empty
  double most_lost_px2_ = 0, lost_px2_ = 0;
  mutable double asked_px2_ = 0;  // lost by the collapse that was last asked for
};

}  // namespace viewcell

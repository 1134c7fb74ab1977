// The cost of collapses that a view cell sees, as a metric of CollapseLoop.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

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
  std::vector<glm::dvec3>
      eyes;               ///< from which an edge's projected length is measured; the largest counts
  double focal_px = 887;  ///< pixels per unit tangent
  bool keep_common_views =
      false;  ///< MVMesh: u and v, and each new triangle, share a view or have none
  /// No vertex may move farther than this from the planes of the triangles that it stands for, as
  /// seen from the nearest eye, in px (Differs from [Chen06]: trap 14, no term bounds deviation).
  double max_drift_px = 1.0;
  glm::dvec3 region_centre{
      0};                    ///< the nearest point of the region to a vertex bounds its distance:
  double region_radius = 0;  ///< |vertex - region_centre| - region_radius
};

/// Follows: [Chen06 5.2.1], cost(u, v) = (1.5 - n_u . n_v)^2 l (w_u + w_v); the vertex of smaller
/// weight collapses; equal weights: either way, the nearer to the surface first. A vertex keeps its
/// own normal, weight and views when others collapse into it (trap 14).
class ViewMetric {
 public:
  ViewMetric(const ViewVertices& vertices, std::span<const Triangle> triangles,
             const ViewMetricOptions& options);

  float cost(std::uint32_t u, std::uint32_t v) const;
  bool allows(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v) const;
  void collapsed(std::uint32_t u, std::uint32_t v) { quadrics_[v].add(quadrics_[u]); }

 private:
  double drift_px(std::uint32_t u, std::uint32_t v) const;
  float projected_length_px(std::uint32_t u, std::uint32_t v) const;

  const ViewVertices& vertices_;
  const ViewMetricOptions& options_;
  std::vector<Quadric> quadrics_;      // around origin_
  std::vector<float> px_per_unit_;     // at each vertex, from the nearest point of the region
  std::vector<glm::vec3> directions_;  // eyes x vertices: unit directions times focal_px
  glm::dvec3 origin_;
};

}  // namespace viewcell

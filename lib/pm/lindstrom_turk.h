// Memoryless simplification by volume and boundary, as a metric of CollapseLoop.
#pragma once

#include <span>
#include <vector>

#include "pm/collapse_mesh.h"

namespace viewcell {

struct LindstromTurkOptions {
  double volume_weight = 0.5;    ///< of squared volume, in [0, 1]
  double boundary_weight = 0.5;  ///< of squared area along boundaries times squared edge length
  /// A constraint is dropped when its angle to the span of the others is below this.
  double least_angle_deg = 1;
};

/// Full-edge collapses into the point that keeps the volume and, as far as that leaves room,
/// changes volume and boundary least near the edge. Looks at the current mesh only. cost() is the
/// sixth root of the objective (volume squared), so it has the unit of a length, but it is no
/// distance. Follows: [Lindstrom, Turk 1998], [Lindstrom, Turk 1999].
class LindstromTurkMetric {
 public:
  static constexpr int kReach = 2;

  /// Keeps references; moves positions. mesh must be over the same positions.
  LindstromTurkMetric(CollapseMesh& mesh, std::span<glm::vec3> positions,
                      const LindstromTurkOptions& options = {});

  float cost(std::uint32_t u, std::uint32_t v);
  glm::vec3 place(std::uint32_t u, std::uint32_t v);
  bool allows(const CollapseMesh&, std::uint32_t, std::uint32_t) const { return true; }
  void collapsed(std::uint32_t u, std::uint32_t v, const glm::vec3& place) {
    on_boundary_[v] = on_boundary_[u] || on_boundary_[v];
    positions_[v] = place;
  }

 private:
  struct Local;  // sums over the triangles and boundary edges around an edge
  Local gather(std::uint32_t u, std::uint32_t v);
  void gather_boundary(std::uint32_t u, std::uint32_t v, const glm::dvec3& origin, Local& local);
  glm::dvec3 least(const Local& local) const;

  CollapseMesh& mesh_;
  std::span<glm::vec3> positions_;
  LindstromTurkOptions options_;
  std::vector<bool> on_boundary_;
  struct Edge {
    std::uint32_t a, b;
  };
  std::vector<Edge> edges_;  // scratch
};

}  // namespace viewcell

// Memoryless simplification by volume and boundary, as a metric of CollapseLoop.
#pragma once

#include <span>
#include <vector>

#include "base/large_vector.h"
#include "pm/collapse_mesh.h"
#include "pm/quadric.h"

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

  float cost(std::uint32_t u, std::uint32_t v) { return evaluate(u, v).cost; }
  float cost_at(std::uint32_t u, std::uint32_t v, const glm::vec3& position);
  glm::vec3 optimal_position(std::uint32_t u, std::uint32_t v) { return evaluate(u, v).position; }
  bool allows(const CollapseMesh&, std::uint32_t, std::uint32_t) const { return true; }
  void traced(std::uint32_t u, std::uint32_t v, const CollapseTrace& trace);
  void collapsed(std::uint32_t u, std::uint32_t v, const glm::vec3& position);
  void fetch(std::uint32_t v) const {
    __builtin_prefetch(&positions_[v]);
    __builtin_prefetch(&stars_[v]);
    __builtin_prefetch(&stars_[v].squares[5]);
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  // A x x + 2 b x + c with symmetric A.
  struct Quadratic {
    Symmetric3 a{};
    glm::dvec3 b{0};
    double c = 0;

    void add(const Quadratic& q, double weight);
    void add_cross(const glm::dvec3& e1, const glm::dvec3& e2);  // |e2 - x cross e1|^2
    double value(const glm::dvec3& x) const;
  };
  // Sums over triangles and boundary edges, relative to an origin.
  struct Sums {
    glm::dvec3 normals{0};  // of the triangles' area vectors, twice the area long
    double volumes = 0;     // of n p over the triangles
    Quadratic volume;       // of (n x - n p)^2, 36 times a squared volume
    glm::dvec3 along{0}, twist{0};
    Quadratic boundary;  // 4 times a squared area
    bool has_boundary = false;
    double edge2 = 0;  // squared length of the edge
  };
  // Sums over the triangles of a vertex, whose planes go through it: seen from there n p is 0.
  struct Star {
    glm::dvec3 normals{0};
    Symmetric3 squares{};  // n n^T
    void add(const glm::dvec3& n, double sign);
  };
  struct Spoke {
    std::uint32_t a, b;
    glm::dvec3 normal;
  };
  class Constraints;
  struct Evaluated {
    std::uint32_t u = kNone, v = kNone;
    float cost = 0;
    glm::vec3 position{0};
  };
  const Evaluated& evaluate(std::uint32_t u, std::uint32_t v);
  const Star& star(std::uint32_t v);
  void gather_spokes(std::uint32_t u);
  Sums sum_triangles(std::uint32_t u, std::uint32_t v);
  Sums sum_up(std::uint32_t u, std::uint32_t v);
  Sums sum_up_beside_hub(std::uint32_t u, std::uint32_t hub);
  Quadratic make_shape(std::uint32_t u, std::uint32_t v) const;
  void gather_boundary(std::uint32_t u, std::uint32_t w, std::uint32_t but, Sums& sums);
  glm::dvec3 least(std::uint32_t u, std::uint32_t v, const Sums& sums) const;
  float cost_of(const Sums& sums, const glm::dvec3& p) const;
  glm::dvec3 between(std::uint32_t from, std::uint32_t to) const {
    return glm::dvec3(positions_[to]) - glm::dvec3(positions_[from]);
  }

  CollapseMesh& mesh_;
  std::span<glm::vec3> positions_;
  LindstromTurkOptions options_;
  double cosine2_, sine2_;  // of the least angle, squared
  std::vector<bool> on_boundary_;
  LargeVector<Star> stars_;       // by vertex
  std::vector<bool> is_current_;  // its entry in stars_ is up to date
  std::uint32_t spokes_of_ = kNone;
  std::vector<Spoke> spokes_;  // its triangles
  Evaluated last_;
  struct Edge {
    std::uint32_t a, b;
  };
  std::vector<Edge> edges_;            // scratch
  std::vector<std::uint32_t> others_;  // their other ends, in order
};

}  // namespace viewcell

// Memoryless simplification by volume and boundary, as a metric of CollapseLoop.
#pragma once

#include <span>
#include <vector>

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
  glm::vec3 place(std::uint32_t u, std::uint32_t v) { return evaluate(u, v).place; }
  bool allows(const CollapseMesh&, std::uint32_t, std::uint32_t) const { return true; }
  void collapsed(std::uint32_t u, std::uint32_t v, const glm::vec3& place) {
    on_boundary_[v] = on_boundary_[u] || on_boundary_[v];
    positions_[v] = place;
    star_of_ = last_.u = kNone;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  // A x x + 2 b x + c with symmetric A.
  struct Quadratic {
    Symmetric3 a{};
    glm::dvec3 b{0};
    double c = 0;

    void add(const Quadratic& q, double weight);
    void add_square(const glm::dvec3& n, double d);              // (n x - d)^2
    void add_cross(const glm::dvec3& e1, const glm::dvec3& e2);  // |e2 - x cross e1|^2
    glm::dvec3 times(const glm::dvec3& x) const;
    double value(const glm::dvec3& x) const;
  };
  // Sums over triangles and boundary edges, relative to an origin.
  struct Sums {
    glm::dvec3 normals{0};  // of the triangles' area vectors, twice the area long
    double volumes = 0;     // of n p over the triangles
    Quadratic volume;       // of (n x - n p)^2, 36 times a squared volume
    double n_around = 0;    // vertices around, and the sum of their places
    glm::dvec3 around{0};
    glm::dvec3 along{0}, twist{0};
    Quadratic boundary;  // 4 times a squared area
    bool has_boundary = false;

    void add_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b);
  };
  class Constraints;
  struct Evaluated {
    std::uint32_t u = kNone, v = kNone;
    float cost = 0;
    glm::vec3 place{0};
  };
  const Evaluated& evaluate(std::uint32_t u, std::uint32_t v);
  void gather_star(std::uint32_t u);
  void gather_boundary(std::uint32_t u, std::uint32_t v, Sums& sums);
  glm::dvec3 least(const Sums& sums, double edge2) const;

  CollapseMesh& mesh_;
  std::span<glm::vec3> positions_;
  LindstromTurkOptions options_;
  double cosine2_, sine2_;  // of the least angle, squared
  std::vector<bool> on_boundary_;
  std::uint32_t star_of_ = kNone;  // whose triangles star_ sums, relative to it
  Sums star_;
  Evaluated last_;
  struct Edge {
    std::uint32_t a, b;
  };
  std::vector<Edge> edges_;  // scratch
};

}  // namespace viewcell

#include "pm/lindstrom_turk.h"

#include <algorithm>
#include <cmath>

namespace viewcell {

void LindstromTurkMetric::Quadratic::add(const Quadratic& q, double weight) {
  for (std::size_t i = 0; i < 6; ++i) a[i] += weight * q.a[i];
  b += weight * q.b;
  c += weight * q.c;
}

void LindstromTurkMetric::Quadratic::add_square(const glm::dvec3& n, double d) {
  a[0] += n.x * n.x, a[1] += n.y * n.y, a[2] += n.z * n.z;
  a[3] += n.x * n.y, a[4] += n.x * n.z, a[5] += n.y * n.z;
  b -= d * n;
  c += d * d;
}

void LindstromTurkMetric::Quadratic::add_cross(const glm::dvec3& e1, const glm::dvec3& e2) {
  const double l = glm::dot(e1, e1);
  a[0] += l - e1.x * e1.x, a[1] += l - e1.y * e1.y, a[2] += l - e1.z * e1.z;
  a[3] -= e1.x * e1.y, a[4] -= e1.x * e1.z, a[5] -= e1.y * e1.z;
  b -= glm::cross(e1, e2);
  c += glm::dot(e2, e2);
}

glm::dvec3 LindstromTurkMetric::Quadratic::times(const glm::dvec3& x) const {
  return {a[0] * x.x + a[3] * x.y + a[4] * x.z, a[3] * x.x + a[1] * x.y + a[5] * x.z,
          a[4] * x.x + a[5] * x.y + a[2] * x.z};
}

double LindstromTurkMetric::Quadratic::value(const glm::dvec3& x) const {
  return glm::dot(x, times(x)) + 2 * glm::dot(b, x) + c;
}

void LindstromTurkMetric::Sums::add_triangle(const glm::dvec3& p, const glm::dvec3& a,
                                             const glm::dvec3& b) {
  const glm::dvec3 n = glm::cross(a - p, b - p);
  const double d = glm::dot(n, p);
  normals += n;
  volumes += d;
  volume.add_square(n, d);
  n_around += 1;
  around += a;
}

// Up to three planes n x = d, each at an angle to what the others span [Lindstrom, Turk 1998 4.1].
class LindstromTurkMetric::Constraints {
 public:
  Constraints(double cosine2, double sine2) : cosine2_(cosine2), sine2_(sine2) {}
  bool is_full() const { return n_ == 3; }

  void add(const glm::dvec3& normal, double d) {
    const double length = glm::length(normal);
    if (is_full() || !(length > 0)) return;
    const glm::dvec3 n = normal / length;
    if (n_ == 1) {
      const double along = glm::dot(n_row_[0], n);
      if (along * along >= cosine2_) return;
    } else if (n_ == 2) {
      const glm::dvec3 across = glm::cross(n_row_[0], n_row_[1]);
      const double out = glm::dot(across, n);
      if (out * out <= sine2_ * glm::dot(across, across)) return;
    }
    n_row_[n_] = n;
    d_[n_++] = d / length;
  }

  // Where q is least on what the constraints leave free.
  void add_minimum(const Quadratic& q) {
    const double size = q.a[0] + q.a[1] + q.a[2];
    if (is_full() || !(size > 0)) return;
    glm::dvec3 free[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    int n_free = 3;
    if (n_ == 1) {
      const glm::dvec3 n = n_row_[0], a = glm::abs(n);
      const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? free[0] : (a.y <= a.z ? free[1] : free[2]);
      free[0] = glm::normalize(glm::cross(n, axis));
      free[1] = glm::cross(n, free[0]);
      n_free = 2;
    } else if (n_ == 2) {
      free[0] = glm::normalize(glm::cross(n_row_[0], n_row_[1]));
      n_free = 1;
    }
    for (int i = 0; i < n_free; ++i) {
      const glm::dvec3 row = q.times(free[i]);
      // A direction in which q is all but flat says nothing.
      if (glm::dot(row, row) > 1e-20 * size * size) add(row, -glm::dot(q.b, free[i]));
    }
  }

  glm::dvec3 solve() const {
    const glm::dvec3 across[3] = {glm::cross(n_row_[1], n_row_[2]),
                                  glm::cross(n_row_[2], n_row_[0]),
                                  glm::cross(n_row_[0], n_row_[1])};
    return (d_[0] * across[0] + d_[1] * across[1] + d_[2] * across[2]) /
           glm::dot(n_row_[0], across[0]);
  }

 private:
  double cosine2_, sine2_;
  int n_ = 0;
  glm::dvec3 n_row_[3] = {};
  double d_[3] = {};
};

LindstromTurkMetric::LindstromTurkMetric(CollapseMesh& mesh, std::span<glm::vec3> positions,
                                         const LindstromTurkOptions& options)
    : mesh_(mesh), positions_(positions), options_(options), on_boundary_(positions.size()) {
  const double angle = glm::radians(options.least_angle_deg);
  cosine2_ = std::cos(angle) * std::cos(angle);
  sine2_ = std::sin(angle) * std::sin(angle);
  for (std::uint32_t v = 0; v < positions.size(); ++v) on_boundary_[v] = mesh.is_on_boundary(v);
}

// The triangles of u, relative to u.
void LindstromTurkMetric::gather_star(std::uint32_t u) {
  if (star_of_ == u) return;
  star_of_ = u;
  star_ = {};
  const glm::vec3 origin = positions_[u];
  mesh_.for_each_triangle(u, [&](std::uint32_t a, std::uint32_t b) {
    star_.add_triangle({0, 0, 0}, glm::dvec3(positions_[a] - origin),
                       glm::dvec3(positions_[b] - origin));
  });
}

// The boundary edges with an end at u or v, relative to u.
void LindstromTurkMetric::gather_boundary(std::uint32_t u, std::uint32_t v, Sums& sums) {
  const glm::vec3 origin = positions_[u];
  for (const std::uint32_t w : {u, v}) {
    edges_.clear();
    mesh_.for_each_triangle(w, [&](std::uint32_t a, std::uint32_t b) {
      edges_.push_back({w, a});
      edges_.push_back({b, w});
    });
    for (const Edge& edge : edges_) {
      const std::uint32_t other = edge.a == w ? edge.b : edge.a;
      const auto n_uses = std::count_if(edges_.begin(), edges_.end(), [&](const Edge& e) {
        return (e.a == w ? e.b : e.a) == other;
      });
      if (n_uses != 1 || (w == v && other == u)) continue;
      const glm::dvec3 a(positions_[edge.a] - origin), b(positions_[edge.b] - origin);
      sums.has_boundary = true;
      sums.along += b - a;
      sums.twist += glm::cross(a, b);
      sums.boundary.add_cross(b - a, glm::cross(a, b));
    }
  }
}

glm::dvec3 LindstromTurkMetric::least(const Sums& sums, double edge2) const {
  Constraints constraints(cosine2_, sine2_);
  Quadratic both;
  both.add(sums.volume, options_.volume_weight / 36);
  if (sums.has_boundary) {
    Quadratic kept;
    kept.add_cross(sums.along, sums.twist);
    constraints.add_minimum(kept);
    both.add(sums.boundary, options_.boundary_weight * edge2 / 4);
  }
  constraints.add(sums.normals, sums.volumes);
  constraints.add_minimum(both);
  if (!constraints.is_full()) {
    Quadratic shape;
    shape.a[0] = shape.a[1] = shape.a[2] = sums.n_around;
    shape.b = -sums.around;
    constraints.add_minimum(shape);
  }
  return constraints.solve();
}

const LindstromTurkMetric::Evaluated& LindstromTurkMetric::evaluate(std::uint32_t u,
                                                                    std::uint32_t v) {
  if (u > v) std::swap(u, v);  // the same sums from either side
  if (last_.u == u && last_.v == v) return last_;
  gather_star(u);
  Sums sums = star_;
  const glm::vec3 origin = positions_[u];
  const glm::dvec3 pv(positions_[v] - origin);
  mesh_.for_each_triangle(v, [&](std::uint32_t a, std::uint32_t b) {
    if (a != u && b != u)
      sums.add_triangle(pv, glm::dvec3(positions_[a] - origin), glm::dvec3(positions_[b] - origin));
  });
  const double edge2 = glm::dot(pv, pv);
  if (on_boundary_[u] || on_boundary_[v]) gather_boundary(u, v, sums);
  const glm::dvec3 p = least(sums, edge2);
  double value = options_.volume_weight / 36 * sums.volume.value(p);
  if (sums.has_boundary) value += options_.boundary_weight * edge2 / 4 * sums.boundary.value(p);
  const float cost = std::cbrt(static_cast<float>(std::sqrt(std::max(value, 0.0))));
  last_ = {u, v, cost, glm::vec3(glm::dvec3(origin) + p)};
  return last_;
}

}  // namespace viewcell

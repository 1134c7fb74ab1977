#include "pm/lindstrom_turk.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace viewcell {
namespace {

// Of a float, or a double of its range; several times as fast as std::cbrt. Two steps of Halley's
// method from a third of the exponent, which is within 4 %: to the last bits of a float.
double cube_root(double x) {
  if (!(x > 0)) return 0;
  double y = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) / 3 + 0x2a9f789300000000ull);
  for (int i = 0; i < 2; ++i) {
    const double cube = y * y * y;
    y *= (cube + 2 * x) / (2 * cube + x);
  }
  return y;
}

}  // namespace

void LindstromTurkMetric::Quadratic::add(const Quadratic& q, double weight) {
  for (std::size_t i = 0; i < 6; ++i) a[i] += weight * q.a[i];
  b += weight * q.b;
  c += weight * q.c;
}

void LindstromTurkMetric::Quadratic::add_cross(const glm::dvec3& e1, const glm::dvec3& e2) {
  const double l = glm::dot(e1, e1);
  a[0] += l - e1.x * e1.x, a[1] += l - e1.y * e1.y, a[2] += l - e1.z * e1.z;
  a[3] -= e1.x * e1.y, a[4] -= e1.x * e1.z, a[5] -= e1.y * e1.z;
  b -= glm::cross(e1, e2);
  c += glm::dot(e2, e2);
}

double LindstromTurkMetric::Quadratic::value(const glm::dvec3& x) const {
  return glm::dot(x, times(a, x)) + 2 * glm::dot(b, x) + c;
}

void LindstromTurkMetric::Star::add(const glm::dvec3& n, double sign) {
  const glm::dvec3 m = sign * n;
  normals += m;
  squares[0] += m.x * n.x, squares[1] += m.y * n.y, squares[2] += m.z * n.z;
  squares[3] += m.x * n.y, squares[4] += m.x * n.z, squares[5] += m.y * n.z;
}

// Up to three planes n x = d, each at an angle to what the others span [Lindstrom, Turk 1998 4.1].
class LindstromTurkMetric::Constraints {
 public:
  Constraints(double cosine2, double sine2) : cosine2_(cosine2), sine2_(sine2) {}
  bool is_full() const { return n_ == 3; }

  void add(const glm::dvec3& n, double d) {
    const double length2 = glm::dot(n, n);
    if (is_full() || !(length2 > 0)) return;
    if (n_ == 1) {
      const double along = glm::dot(n_row_[0], n);
      if (along * along >= cosine2_ * glm::dot(n_row_[0], n_row_[0]) * length2) return;
    } else if (n_ == 2) {
      const glm::dvec3 across = glm::cross(n_row_[0], n_row_[1]);
      const double out = glm::dot(across, n);
      if (out * out <= sine2_ * glm::dot(across, across) * length2) return;
    }
    n_row_[n_] = n;
    d_[n_++] = d;
  }

  // Minimises q in the subspace that the constraints leave free.
  void add_minimum(const Quadratic& q) {
    const double size = q.a[0] + q.a[1] + q.a[2];
    if (is_full() || !(size > 0)) return;
    const auto add_free = [&](const glm::dvec3& free) {
      const glm::dvec3 row = times(q.a, free);
      // Directions in which q is nearly constant are ignored.
      if (glm::dot(row, row) > 1e-20 * size * size) add(row, -glm::dot(q.b, free));
    };
    if (n_ == 0) {
      for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}}) add_free(axis);
    } else if (n_ == 1) {
      // Unit vectors at right angles to n, without a branch [Duff et al. 2017].
      const glm::dvec3 n = glm::normalize(n_row_[0]);
      const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
      add_free({1 + sign * n.x * n.x * a, sign * b, -sign * n.x});
      add_free({b, sign + n.y * n.y * a, -n.y});
    } else {
      add_free(glm::normalize(glm::cross(n_row_[0], n_row_[1])));
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
    : mesh_(mesh),
      positions_(positions),
      options_(options),
      on_boundary_(positions.size()),
      stars_(positions.size()),
      is_current_(positions.size(), false) {
  const double angle = glm::radians(options.least_angle_deg);
  cosine2_ = std::cos(angle) * std::cos(angle);
  sine2_ = std::sin(angle) * std::sin(angle);
  for (std::uint32_t v = 0; v < positions.size(); ++v) on_boundary_[v] = mesh.is_on_boundary(v);
}

void LindstromTurkMetric::gather_spokes(std::uint32_t u) {
  if (spokes_of_ == u) return;
  spokes_of_ = u;
  spokes_.clear();
  mesh_.for_each_triangle(u, [&](std::uint32_t a, std::uint32_t b) {
    spokes_.push_back({a, b, glm::cross(between(u, a), between(u, b))});
  });
}

const LindstromTurkMetric::Star& LindstromTurkMetric::star(std::uint32_t v) {
  if (is_current_[v]) return stars_[v];
  is_current_[v] = true;
  Star sum;
  mesh_.for_each_triangle(v, [&](std::uint32_t a, std::uint32_t b) {
    sum.add(glm::cross(between(v, a), between(v, b)), 1);
  });
  return stars_[v] = sum;
}

// Over the triangles of u and v, those of both once, relative to u. With n p for the triangles of v
// written as n (v - u), the sums of n n^T serve for all of their terms; it is 0 for those of both.
LindstromTurkMetric::Sums LindstromTurkMetric::sum_triangles(std::uint32_t u, std::uint32_t v) {
  gather_spokes(u);
  const Star& of_v = star(v);
  Star all = star(u);
  all.normals += of_v.normals;
  for (std::size_t i = 0; i < 6; ++i) all.squares[i] += of_v.squares[i];
  for (const Spoke& spoke : spokes_)
    if (spoke.a == v || spoke.b == v) all.add(spoke.normal, -1);
  const glm::dvec3 edge = between(u, v);
  const glm::dvec3 moment = times(of_v.squares, edge);
  Sums sums;
  sums.normals = all.normals;
  sums.volumes = glm::dot(of_v.normals, edge);
  sums.volume = {all.squares, -moment, glm::dot(edge, moment)};
  return sums;
}

// The boundary edges with an end at w and the other not at `but`, relative to u.
void LindstromTurkMetric::gather_boundary(std::uint32_t u, std::uint32_t w, std::uint32_t but,
                                          Sums& sums) {
  edges_.clear();
  others_.clear();
  mesh_.for_each_triangle(w, [&](std::uint32_t a, std::uint32_t b) {
    edges_.push_back({w, a});
    edges_.push_back({b, w});
    others_.insert(others_.end(), {a, b});
  });
  std::sort(others_.begin(), others_.end());
  for (const Edge& edge : edges_) {
    const std::uint32_t other = edge.a == w ? edge.b : edge.a;
    const auto uses = std::equal_range(others_.begin(), others_.end(), other);
    if (uses.second - uses.first != 1 || other == but) continue;
    const glm::dvec3 a = between(u, edge.a), b = between(u, edge.b);
    sums.has_boundary = true;
    sums.along += b - a;
    sums.twist += glm::cross(a, b);
    sums.boundary.add_cross(b - a, glm::cross(a, b));
  }
}

// Squared distances to the vertices around, for each triangle of u or v the first after u or v,
// each over what it is from the edge's middle: in a fan, whose tip is far, it would pull u and v
// over their neighbours.
LindstromTurkMetric::Quadratic LindstromTurkMetric::make_shape(std::uint32_t u,
                                                               std::uint32_t v) const {
  const glm::dvec3 middle = 0.5 * between(u, v);
  Quadratic shape;
  const auto add = [&](std::uint32_t a) {
    const glm::dvec3 p = between(u, a), from_middle = p - middle;
    const double weight = 1 / (glm::dot(from_middle, from_middle) + glm::dot(middle, middle));
    for (std::size_t i = 0; i < 3; ++i) shape.a[i] += weight;
    shape.b -= weight * p;
  };
  mesh_.for_each_triangle(u, [&](std::uint32_t a, std::uint32_t) { add(a); });
  mesh_.for_each_triangle(v, [&](std::uint32_t a, std::uint32_t b) {
    if (a != u && b != u) add(a);
  });
  return shape;
}

glm::dvec3 LindstromTurkMetric::least(std::uint32_t u, std::uint32_t v, const Sums& sums) const {
  Constraints constraints(cosine2_, sine2_);
  Quadratic both;
  both.add(sums.volume, options_.volume_weight / 36);
  if (sums.has_boundary) {
    Quadratic kept;
    kept.add_cross(sums.along, sums.twist);
    constraints.add_minimum(kept);
    both.add(sums.boundary, options_.boundary_weight * sums.edge2 / 4);
  }
  constraints.add(sums.normals, sums.volumes);
  constraints.add_minimum(both);
  if (!constraints.is_full()) constraints.add_minimum(make_shape(u, v));
  return constraints.solve();
}

LindstromTurkMetric::Sums LindstromTurkMetric::sum_up(std::uint32_t u, std::uint32_t v) {
  Sums sums = sum_triangles(u, v);
  const glm::dvec3 edge = between(u, v);
  sums.edge2 = glm::dot(edge, edge);
  if (on_boundary_[u] || on_boundary_[v]) {
    gather_boundary(u, u, kNone, sums);
    gather_boundary(u, v, u, sums);
  }
  return sums;
}

// What counts when u goes to where the hub is: planes and edges of the hub go through that place.
LindstromTurkMetric::Sums LindstromTurkMetric::sum_up_beside_hub(std::uint32_t u,
                                                                 std::uint32_t hub) {
  const Star& of_u = star(u);
  Sums sums;
  sums.normals = of_u.normals;
  sums.volume.a = of_u.squares;
  const glm::dvec3 edge = between(u, hub);
  sums.edge2 = glm::dot(edge, edge);
  if (on_boundary_[u]) gather_boundary(u, u, kNone, sums);
  return sums;
}

float LindstromTurkMetric::cost_of(const Sums& sums, const glm::dvec3& p) const {
  double value = options_.volume_weight / 36 * sums.volume.value(p);
  if (sums.has_boundary)
    value += options_.boundary_weight * sums.edge2 / 4 * sums.boundary.value(p);
  return static_cast<float>(cube_root(std::sqrt(std::max(value, 0.0))));
}

// What has changed of the star of a hub, which stays.
void LindstromTurkMetric::traced(std::uint32_t, std::uint32_t v, const CollapseTrace& trace) {
  if (!mesh_.is_hub(v)) return;
  const auto forget_triangle = [&](std::uint32_t t) {
    for (std::uint32_t c = 3 * t; c < 3 * t + 3; ++c) is_current_[mesh_.vertex_at(c)] = false;
  };
  for (const std::uint32_t t : trace.died) forget_triangle(t);
  for (const std::uint32_t c : trace.moved) forget_triangle(c / 3);
}

void LindstromTurkMetric::collapsed(std::uint32_t u, std::uint32_t v, const glm::vec3& position) {
  on_boundary_[v] = on_boundary_[u] || on_boundary_[v];
  spokes_of_ = last_.u = kNone;
  is_current_[v] = false;
  if (!mesh_.is_hub(v) || position != positions_[v])
    mesh_.for_each_triangle(
        v, [&](std::uint32_t a, std::uint32_t b) { is_current_[a] = is_current_[b] = false; });
  positions_[v] = position;
}

const LindstromTurkMetric::Evaluated& LindstromTurkMetric::evaluate(std::uint32_t u,
                                                                    std::uint32_t v) {
  if (u > v) std::swap(u, v);  // the same sums from either side
  if (last_.u == u && last_.v == v) return last_;
  const Sums sums = sum_up(u, v);
  const glm::dvec3 p = least(u, v, sums);
  last_ = {u, v, cost_of(sums, p), glm::vec3(glm::dvec3(positions_[u]) + p)};
  return last_;
}

float LindstromTurkMetric::cost_at(std::uint32_t u, std::uint32_t v, const glm::vec3& position) {
  if (mesh_.is_hub(v) && position == positions_[v])
    return cost_of(sum_up_beside_hub(u, v), between(u, v));
  if (u > v) std::swap(u, v);
  return cost_of(sum_up(u, v), glm::dvec3(position) - glm::dvec3(positions_[u]));
}

}  // namespace viewcell

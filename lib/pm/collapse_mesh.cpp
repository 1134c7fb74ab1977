#include "pm/collapse_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viewcell {
namespace {

bool contains(std::span<const std::uint32_t> values, std::uint32_t x) {
  return std::find(values.begin(), values.end(), x) != values.end();
}

// One of 64 bits for a vertex: two vertices with different bits are different.
std::uint64_t bit_of(std::uint32_t v) {
  return std::uint64_t{1} << (v % 64);
}

}  // namespace

CollapseMesh::CollapseMesh(std::span<const glm::vec3> positions,
                           std::span<const Triangle> triangles)
    : positions_(positions), alive_(triangles.size(), false), stars_(positions.size()) {
  vertices_.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    vertices_.insert(vertices_.end(), t.begin(), t.end());
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    alive_[vertices_.size() / 3 - 1] = true;
    ++n_triangles_;
    for (const std::uint32_t v : t) ++stars_[v].n;
  }
  corners_.reserve(3 * n_triangles_ + 3 * n_triangles_ / 4);  // room for a quarter of new lists
  corners_.resize(3 * n_triangles_);
  std::uint32_t end = 0;
  for (Star& star : stars_) {
    star.first = end;
    end += std::exchange(star.n, 0);
  }
  for (std::uint32_t c = 0; c < vertices_.size(); ++c) {
    if (!alive_[c / 3]) continue;
    Star& star = stars_[vertices_[c]];
    corners_[star.first + star.n++] = c;
  }
}

void CollapseMesh::gather(std::uint32_t v, Fan& fan) const {
  fan.resize(stars_[v].n);
  std::size_t i = 0;
  for_each_triangle(v, [&](std::uint32_t a, std::uint32_t b) { fan.set(i++, a, b); });
}

void CollapseMesh::ring(std::uint32_t v, std::vector<std::uint32_t>& out) {
  gather(v, fan_v_);
  const auto a = fan_v_.a(), b = fan_v_.b();
  out.assign(a.begin(), a.end());
  if (fan_v_.is_closed()) return;
  out.clear();
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!contains(out, a[i])) out.push_back(a[i]);
    if (!contains(out, b[i])) out.push_back(b[i]);
  }
}

Refusal CollapseMesh::check(std::uint32_t u, std::uint32_t v, float min_cosine) {
  bool is_boundary_edge = false;
  gather(u, fan_u_);
  if (!keeps_topology(fan_u_, u, v, is_boundary_edge)) return Refusal::link;
  if (!is_boundary_edge && fan_u_.has_odd_edge()) return Refusal::boundary;
  return check_move(fan_u_, u, v, positions_[v], min_cosine);
}

Refusal CollapseMesh::check(std::uint32_t u, std::uint32_t v, const glm::vec3& position,
                            float min_cosine) {
  bool is_boundary_edge = false;
  gather(u, fan_u_);
  gather(v, fan_v_);
  if (!keeps_topology(fan_u_, u, v, is_boundary_edge)) return Refusal::link;
  if (!is_boundary_edge && fan_u_.has_odd_edge() && fan_v_.has_odd_edge()) return Refusal::boundary;
  const Refusal refusal = check_move(fan_u_, u, v, position, min_cosine);
  return refusal != Refusal::none ? refusal : check_move(fan_v_, v, u, position, min_cosine);
}

// The link condition [Dey et al. 1999]: a vertex joined to both u and v must
// be the third corner of a triangle at uv, and no triangle of u may come to lie on one of v. (The
// three neighbours of a vertex with three triangles are all joined; it may go unless they have a
// triangle of their own, as in a tetrahedron.)
bool CollapseMesh::keeps_topology(const Fan& of_u, std::uint32_t u, std::uint32_t v,
                                  bool& is_boundary_edge) {
  const auto around_a = of_u.a(), around_b = of_u.b();
  std::uint64_t around_u = 0;  // most vertices around v are not among these bits
  opposite_.clear();
  for (std::size_t i = 0; i < around_a.size(); ++i) {
    around_u |= bit_of(around_a[i]) | bit_of(around_b[i]);
    if (around_a[i] == v) opposite_.push_back(around_b[i]);
    if (around_b[i] == v) opposite_.push_back(around_a[i]);
  }
  const auto joins_wrongly = [&](std::uint32_t w) {  // joined to both, but no triangle u v w
    return (around_u & bit_of(w)) && w != u && !contains(opposite_, w) &&
           (contains(around_a, w) || contains(around_b, w));
  };
  const auto is_triangle_of_u = [&](std::uint32_t a, std::uint32_t b) {
    for (std::size_t i = 0; i < around_a.size(); ++i)
      if ((around_a[i] == a && around_b[i] == b) || (around_a[i] == b && around_b[i] == a))
        return true;
    return false;
  };
  int n_shared = 0;
  bool legal = true;
  for_each_triangle(v, [&](std::uint32_t a, std::uint32_t b) {
    n_shared += (a == u) + (b == u);
    if (joins_wrongly(a) || joins_wrongly(b)) legal = false;
    if ((around_u & bit_of(a)) && (around_u & bit_of(b)) && contains(opposite_, a) &&
        contains(opposite_, b) && is_triangle_of_u(a, b))
      legal = false;
  });
  is_boundary_edge = n_shared == 1;
  return legal && n_shared > 0;
}

bool CollapseMesh::is_lone_triangle(std::uint32_t u, std::uint32_t v) const {
  if (stars_[u].n != 1 || stars_[v].n != 1) return false;
  bool is_alone = false;
  for_each_triangle(u, [&](std::uint32_t a, std::uint32_t b) {
    is_alone = (a == v && stars_[b].n == 1) || (b == v && stars_[a].n == 1);
  });
  return is_alone;
}

bool CollapseMesh::is_on_boundary(std::uint32_t v) {
  gather(v, fan_v_);
  return fan_v_.has_odd_edge();
}

// Of the triangles of `from` without `other`, when it goes to `to`.
Refusal CollapseMesh::check_move(const Fan& fan, std::uint32_t from, std::uint32_t other,
                                 const glm::vec3& to, float min_cosine) const {
  const auto around_a = fan.a(), around_b = fan.b();
  const glm::vec3 at = positions_[from];
  for (std::size_t i = 0; i < around_a.size(); ++i) {
    if (around_a[i] == other || around_b[i] == other) continue;
    const glm::vec3 pa = positions_[around_a[i]], pb = positions_[around_b[i]];
    const glm::vec3 before = glm::cross(pa - at, pb - at);
    const glm::vec3 after = glm::cross(pa - to, pb - to);
    // no area, or next to none for its longest edge (a needle shows as a crack): height < 1e-3 edge
    const float longest = std::max(
        {glm::dot(pa - to, pa - to), glm::dot(pb - to, pb - to), glm::dot(pa - pb, pa - pb)});
    if (!(glm::dot(after, after) > 1e-6f * longest * longest)) return Refusal::sliver;
    const float limit = min_cosine * std::sqrt(glm::dot(before, before) * glm::dot(after, after));
    if (glm::dot(before, after) < limit) return Refusal::flip;
  }
  return Refusal::none;
}

void CollapseMesh::unlink(std::uint32_t v, std::uint32_t corner) {
  Star& star = stars_[v];
  std::uint32_t* at = &corners_[star.first];
  while (*at != corner) ++at;
  const std::uint32_t* const last = &corners_[star.first] + --star.n;
  for (; at != last; ++at) *at = at[1];
}

// Room for n more corners at the end: moves the lists together, in the order of the vertices, when
// there is none.
void CollapseMesh::make_room(std::size_t n) {
  if (corners_.size() + n <= corners_.capacity()) return;
  LargeVector<std::uint32_t> packed;
  packed.reserve(std::max(corners_.capacity(), 3 * n_triangles_ + n));
  for (std::uint32_t v = 0; v < stars_.size(); ++v) {
    const auto list = corners(v);
    stars_[v].first = static_cast<std::uint32_t>(packed.size());
    packed.insert(packed.end(), list.begin(), list.end());
  }
  corners_ = std::move(packed);
}

void CollapseMesh::collapse(std::uint32_t u, std::uint32_t v, CollapseTrace* trace) {
  if (trace) trace->died.clear(), trace->moved.clear();
  make_room(stars_[u].n + stars_[v].n);
  const auto merged = static_cast<std::uint32_t>(corners_.size());
  for (const std::uint32_t c : corners(u)) {
    const std::uint32_t t = c / 3;
    if (vertex_at(3 * t) == v || vertex_at(3 * t + 1) == v || vertex_at(3 * t + 2) == v) {
      for (std::uint32_t k = 3 * t; k < 3 * t + 3; ++k)
        if (k != c) unlink(vertex_at(k), k);
      alive_[t] = false;
      --n_triangles_;
      if (trace) trace->died.push_back(t);
    } else {
      vertices_[c] = v;
      corners_.push_back(c);
      if (trace) trace->moved.push_back(c);
    }
  }
  const auto rest = corners(v);
  corners_.insert(corners_.end(), rest.begin(), rest.end());
  stars_[v] = {merged, static_cast<std::uint32_t>(corners_.size()) - merged};
  stars_[u] = {};
}

std::vector<std::uint32_t> CollapseMesh::triangle_numbers() const {
  std::vector<std::uint32_t> out;
  out.reserve(n_triangles_);
  for (std::uint32_t t = 0; t < alive_.size(); ++t)
    if (alive_[t]) out.push_back(t);
  return out;
}

std::vector<Triangle> CollapseMesh::triangles() const {
  std::vector<Triangle> out;
  out.reserve(n_triangles_);
  for (std::size_t t = 0; t < alive_.size(); ++t)
    if (alive_[t]) out.push_back({vertex_at(3 * t), vertex_at(3 * t + 1), vertex_at(3 * t + 2)});
  return out;
}

}  // namespace viewcell

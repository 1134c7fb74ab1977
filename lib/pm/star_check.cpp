#include "pm/star_check.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "pm/collapse_mesh.h"

namespace viewcell {
namespace {

bool contains(std::span<const std::uint32_t> values, std::uint32_t x) {
  return std::find(values.begin(), values.end(), x) != values.end();
}

// One of 64 bits for a vertex: two vertices with different bits are different.
std::uint64_t bit_of(std::uint32_t v) {
  return std::uint64_t{1} << (v % 64);
}

void gather(const CollapseMesh& mesh, std::uint32_t v, Fan& fan) {
  fan.resize(mesh.n_sheet_triangles(v));
  std::size_t i = 0;
  mesh.for_each_triangle(v, [&](std::uint32_t a, std::uint32_t b) { fan.set(i++, a, b); });
}

bool has_triangle(const Fan& fan, std::uint32_t a, std::uint32_t b) {
  const auto around_a = fan.a(), around_b = fan.b();
  for (std::size_t i = 0; i < around_a.size(); ++i)
    if ((around_a[i] == a && around_b[i] == b) || (around_a[i] == b && around_b[i] == a))
      return true;
  return false;
}

bool are_joined(const CollapseMesh& mesh, std::uint32_t w, std::uint32_t hub) {
  if (mesh.is_hub(w)) return mesh.hub_links().are_joined(w, hub);
  bool found = false;
  mesh.for_each_triangle(
      w, [&](std::uint32_t a, std::uint32_t b) { found = found || a == hub || b == hub; });
  return found;
}

bool have_triangle(const CollapseMesh& mesh, std::uint32_t hub, std::uint32_t a, std::uint32_t b) {
  if (mesh.is_hub(a)) std::swap(a, b);
  if (mesh.is_hub(a)) return mesh.hub_links().have_triangle(hub, a, b);
  bool found = false;
  mesh.for_each_triangle(a, [&](std::uint32_t c, std::uint32_t d) {
    found = found || (c == hub && d == b) || (c == b && d == hub);
  });
  return found;
}

// The longest edge of a triangle, to the fourth power.
float longest4(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const float longest2 =
      std::max({glm::dot(a - c, a - c), glm::dot(b - c, b - c), glm::dot(a - b, a - b)});
  return longest2 * longest2;
}

// Whether what is a needle was a thinner one or as thin. Where there are hubs there are many, at
// the tip of a cone and on the sides of a finely cut pipe, and they are not there for good.
bool was_needle(const glm::vec3& before, float before4, const glm::vec3& after, float after4) {
  constexpr float kRounding = 0.99f;
  return glm::dot(before, before) > 0 &&
         glm::dot(after, after) * before4 > kRounding * glm::dot(before, before) * after4;
}

// Of the triangles of `from` without `other`, when it goes to `to`.
Refusal check_move(const CollapseMesh& mesh, const Fan& fan, std::uint32_t from,
                   std::uint32_t other, const glm::vec3& to, float min_cosine) {
  const auto around_a = fan.a(), around_b = fan.b();
  const glm::vec3 at = mesh.position(from);
  for (std::size_t i = 0; i < around_a.size(); ++i) {
    if (around_a[i] == other || around_b[i] == other) continue;
    const glm::vec3 pa = mesh.position(around_a[i]), pb = mesh.position(around_b[i]);
    const glm::vec3 before = glm::cross(pa - at, pb - at);
    const glm::vec3 after = glm::cross(pa - to, pb - to);
    // no area, or next to none for its longest edge (a needle shows as a crack): height < 1e-3 edge
    if (!(glm::dot(after, after) > 1e-6f * longest4(pa, pb, to)) &&
        !(mesh.lists().has_hubs() &&
          was_needle(before, longest4(pa, pb, at), after, longest4(pa, pb, to))))
      return Refusal::sliver;
    const float limit = min_cosine * std::sqrt(glm::dot(before, before) * glm::dot(after, after));
    if (glm::dot(before, after) < limit) return Refusal::flip;
  }
  return Refusal::none;
}

}  // namespace

void StarCheck::ring(const CollapseMesh& mesh, std::uint32_t v, std::vector<std::uint32_t>& out) {
  gather(mesh, v, fan_v_);
  const auto a = fan_v_.a(), b = fan_v_.b();
  out.assign(a.begin(), a.end());
  if (fan_v_.is_closed()) return;
  if (mesh.is_hub(v)) {
    out.insert(out.end(), b.begin(), b.end());
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return;
  }
  out.clear();
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!contains(out, a[i])) out.push_back(a[i]);
    if (!contains(out, b[i])) out.push_back(b[i]);
  }
}

Refusal StarCheck::check(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v,
                         float min_cosine) {
  bool is_odd_edge = false;
  gather(mesh, u, fan_u_);
  if (!keeps_topology(mesh, u, v, is_odd_edge)) return Refusal::link;
  if (!is_odd_edge && fan_u_.has_odd_edge()) return Refusal::boundary;
  return check_move(mesh, fan_u_, u, v, mesh.position(v), min_cosine);
}

Refusal StarCheck::check(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v,
                         const glm::vec3& position, float min_cosine) {
  bool is_odd_edge = false;
  gather(mesh, u, fan_u_);
  gather(mesh, v, fan_v_);
  if (!keeps_topology(mesh, u, v, is_odd_edge)) return Refusal::link;
  if (!is_odd_edge && fan_u_.has_odd_edge() && fan_v_.has_odd_edge()) return Refusal::boundary;
  const Refusal refusal = check_move(mesh, fan_u_, u, v, position, min_cosine);
  return refusal != Refusal::none ? refusal : check_move(mesh, fan_v_, v, u, position, min_cosine);
}

bool StarCheck::is_on_boundary(const CollapseMesh& mesh, std::uint32_t v) {
  gather(mesh, v, fan_v_);
  return fan_v_.has_odd_edge();
}

// The link condition [Dey et al. 1999]: a vertex joined to both u and v must
// be the third corner of a triangle at uv, and no triangle of u may come to lie on one of v. (The
// three neighbours of a vertex with three triangles are all joined; it may go unless they have a
// triangle of their own, as in a tetrahedron.) Nor may the last triangles go.
bool StarCheck::keeps_topology(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v,
                               bool& is_odd_edge) {
  const auto around_a = fan_u_.a(), around_b = fan_u_.b();
  opposite_.clear();
  for (std::size_t i = 0; i < around_a.size(); ++i) {
    if (around_a[i] == v) opposite_.push_back(around_b[i]);
    if (around_b[i] == v) opposite_.push_back(around_a[i]);
  }
  is_odd_edge = opposite_.size() % 2 == 1;
  if (opposite_.empty() || opposite_.size() == mesh.n_sheet_triangles()) return false;
  return mesh.is_hub(v) && !mesh.is_hub(u) ? compare_with_hub(mesh, v) : compare_stars(mesh, u, v);
}

bool StarCheck::compare_stars(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v) const {
  const auto around_a = fan_u_.a(), around_b = fan_u_.b();
  std::uint64_t around_u = 0;  // most vertices around v are not among these bits
  for (std::size_t i = 0; i < around_a.size(); ++i)
    around_u |= bit_of(around_a[i]) | bit_of(around_b[i]);
  const auto joins_wrongly = [&](std::uint32_t w) {  // joined to both, but no triangle u v w
    return (around_u & bit_of(w)) && w != u && !contains(opposite_, w) &&
           (contains(around_a, w) || contains(around_b, w));
  };
  bool legal = true;
  mesh.for_each_triangle(v, [&](std::uint32_t a, std::uint32_t b) {
    if (joins_wrongly(a) || joins_wrongly(b)) legal = false;
    if ((around_u & bit_of(a)) && (around_u & bit_of(b)) && contains(opposite_, a) &&
        contains(opposite_, b) && has_triangle(fan_u_, a, b))
      legal = false;
  });
  return legal;
}

// The same, asked around u.
bool StarCheck::compare_with_hub(const CollapseMesh& mesh, std::uint32_t hub) const {
  const auto around_a = fan_u_.a(), around_b = fan_u_.b();
  const auto is_opposite = [&](std::uint32_t w) { return contains(opposite_, w); };
  const auto joins_wrongly = [&](std::uint32_t w) {
    return w != hub && !is_opposite(w) && are_joined(mesh, w, hub);
  };
  for (std::size_t i = 0; i < around_a.size(); ++i) {
    const std::uint32_t a = around_a[i], b = around_b[i];
    if (joins_wrongly(a) || joins_wrongly(b)) return false;
    if (is_opposite(a) && is_opposite(b) && have_triangle(mesh, hub, a, b)) return false;
  }
  return true;
}

}  // namespace viewcell

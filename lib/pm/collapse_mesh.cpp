#include "pm/collapse_mesh.h"

#include <algorithm>
#include <cmath>

namespace viewcell {

const char* refusal_name(Refusal refusal) {
  constexpr const char* names[kRefusalKinds] = {"none",  "link", "boundary", "flip",  "sliver",
                                                "chart", "fold", "bound",    "metric"};
  return names[static_cast<int>(refusal)];
}

CollapseMesh::CollapseMesh(std::span<const glm::vec3> positions,
                           std::span<const Triangle> triangles)
    : positions_(positions),
      corners_(3 * triangles.size(), {kEnd, kEnd}),
      alive_(triangles.size(), false),
      head_(positions.size(), kEnd),
      mark_(positions.size(), 0) {
  for (std::size_t t = triangles.size(); t-- > 0;) {  // backwards: lists end up in input order
    const Triangle& triangle = triangles[t];
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
      continue;
    ++n_triangles_;
    alive_[t] = true;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto c = static_cast<std::uint32_t>(3 * t + k);
      corners_[c] = {triangle[k], head_[triangle[k]]};
      head_[triangle[k]] = c;
    }
  }
}

void CollapseMesh::ring(std::uint32_t v, std::vector<std::uint32_t>& out) const {
  out.clear();
  for_each_triangle(v, [&](std::uint32_t a, std::uint32_t b) {
    if (std::find(out.begin(), out.end(), a) == out.end()) out.push_back(a);
    if (std::find(out.begin(), out.end(), b) == out.end()) out.push_back(b);
  });
}

Refusal CollapseMesh::check(std::uint32_t u, std::uint32_t v, float min_cosine) {
  bool is_boundary_edge = false;
  if (!keeps_topology(u, v, is_boundary_edge)) return Refusal::link;
  if (!is_boundary_edge && is_on_boundary(u)) return Refusal::boundary;
  return check_move(u, v, positions_[v], min_cosine);
}

Refusal CollapseMesh::check(std::uint32_t u, std::uint32_t v, const glm::vec3& place,
                            float min_cosine) {
  bool is_boundary_edge = false;
  if (!keeps_topology(u, v, is_boundary_edge)) return Refusal::link;
  if (!is_boundary_edge && is_on_boundary(u) && is_on_boundary(v)) return Refusal::boundary;
  const Refusal refusal = check_move(u, v, place, min_cosine);
  return refusal != Refusal::none ? refusal : check_move(v, u, place, min_cosine);
}

// The link condition [Dey, Edelsbrunner, Guha, Nekhayev 1999]: a vertex joined to both u and v must
// be the third corner of a triangle at uv, and no triangle of u may come to lie on one of v. (The
// three neighbours of a vertex with three triangles are all joined; it may go unless they have a
// triangle of their own, as in a tetrahedron.)
bool CollapseMesh::keeps_topology(std::uint32_t u, std::uint32_t v, bool& is_boundary_edge) {
  stamp_ += 4;
  const std::uint32_t at_u = stamp_, opposite = stamp_ + 1;
  for_each_triangle(u, [&](std::uint32_t a, std::uint32_t b) {
    mark_[a] = std::max(mark_[a], at_u);
    mark_[b] = std::max(mark_[b], at_u);
    if (a == v) mark_[b] = opposite;
    if (b == v) mark_[a] = opposite;
  });
  int n_shared = 0;
  bool legal = true;
  for_each_triangle(v, [&](std::uint32_t a, std::uint32_t b) {
    n_shared += (a == u) + (b == u);
    for (const std::uint32_t w : {a, b})
      if (w != u && mark_[w] == at_u) legal = false;  // joined to both, but no triangle u v w
    if (mark_[a] == opposite && mark_[b] == opposite && has_triangle(u, a, b)) legal = false;
  });
  is_boundary_edge = n_shared == 1;
  return legal && n_shared > 0;
}

bool CollapseMesh::has_triangle(std::uint32_t u, std::uint32_t a, std::uint32_t b) const {
  bool found = false;
  for_each_triangle(u, [&](std::uint32_t c, std::uint32_t d) {
    if ((c == a && d == b) || (c == b && d == a)) found = true;
  });
  return found;
}

// Whether some edge of u has exactly one triangle.
bool CollapseMesh::is_on_boundary(std::uint32_t v) {
  // Each triangle (v, a, b) has the edges v-a and v-b; around an interior vertex every neighbour is
  // met an even number of times.
  stamp_ += 4;
  const std::uint32_t odd = stamp_ + 1, even = stamp_ + 2;
  int n_odd = 0;
  for_each_triangle(v, [&](std::uint32_t a, std::uint32_t b) {
    for (const std::uint32_t w : {a, b}) {
      const bool was_odd = mark_[w] == odd;
      mark_[w] = was_odd ? even : odd;
      n_odd += was_odd ? -1 : 1;
    }
  });
  return n_odd > 0;
}

// Of the triangles of `from` without `other`, when it goes to `to`.
Refusal CollapseMesh::check_move(std::uint32_t from, std::uint32_t other, const glm::vec3& to,
                                 float min_cosine) const {
  const glm::vec3 at = positions_[from];
  Refusal refusal = Refusal::none;
  for_each_triangle(from, [&](std::uint32_t a, std::uint32_t b) {
    if (a == other || b == other || refusal != Refusal::none) return;
    const glm::vec3 pa = positions_[a], pb = positions_[b];
    const glm::vec3 before = glm::cross(pa - at, pb - at);
    const glm::vec3 after = glm::cross(pa - to, pb - to);
    const float limit = min_cosine * std::sqrt(glm::dot(before, before) * glm::dot(after, after));
    if (glm::dot(before, after) < limit) refusal = Refusal::flip;
    // no area, or next to none for its longest edge (a needle shows as a crack): height < 1e-3 edge
    const float longest = std::max(
        {glm::dot(pa - to, pa - to), glm::dot(pb - to, pb - to), glm::dot(pa - pb, pa - pb)});
    if (!(glm::dot(after, after) > 1e-6f * longest * longest)) refusal = Refusal::sliver;
  });
  return refusal;
}

void CollapseMesh::unlink(std::uint32_t v, std::uint32_t corner) {
  std::uint32_t* link = &head_[v];
  while (*link != corner) link = &corners_[*link].next;
  *link = corners_[corner].next;
}

void CollapseMesh::collapse(std::uint32_t u, std::uint32_t v, CollapseTrace* trace) {
  if (trace) trace->died.clear(), trace->moved.clear();
  std::uint32_t last = kEnd;  // the last corner of u that lives on
  for (std::uint32_t c = head_[u]; c != kEnd;) {
    const std::uint32_t after = corners_[c].next, t = c / 3;
    if (vertex_at(3 * t) == v || vertex_at(3 * t + 1) == v || vertex_at(3 * t + 2) == v) {
      for (std::uint32_t k = 0; k < 3; ++k) unlink(vertex_at(3 * t + k), 3 * t + k);
      alive_[t] = false;
      --n_triangles_;
      if (trace) trace->died.push_back(t);
    } else {
      corners_[c].vertex = v;
      last = c;
      if (trace) trace->moved.push_back(c);
    }
    c = after;
  }
  if (last != kEnd) {
    corners_[last].next = head_[v];
    head_[v] = head_[u];
  }
  head_[u] = kEnd;
}

std::vector<Triangle> CollapseMesh::triangles() const {
  std::vector<Triangle> out;
  out.reserve(n_triangles_);
  for (std::size_t t = 0; t < alive_.size(); ++t)
    if (alive_[t]) out.push_back({vertex_at(3 * t), vertex_at(3 * t + 1), vertex_at(3 * t + 2)});
  return out;
}

}  // namespace viewcell

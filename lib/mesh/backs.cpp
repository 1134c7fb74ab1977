#include "mesh/backs.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "base/error.h"
#include "mesh/edges.h"
#include "mesh/topology.h"

namespace viewcell {
namespace {

struct Corner {
  std::uint32_t triangle, at;
  std::size_t index() const { return 3 * std::size_t{triangle} + at; }
};

class BackCutter {
 public:
  BackCutter(TriMesh& mesh, std::span<const std::uint32_t> place) : mesh_(mesh) {
    welded_.triangles = mesh.triangles;
    for (Triangle& t : welded_.triangles)
      for (std::uint32_t& v : t) v = place[v];
    welded_.positions.resize(mesh.positions.size());
    edges_ = build_edge_table(welded_);
    is_done_.resize(mesh.triangles.size(), false);
  }

  std::size_t cut_all() {
    std::size_t n = 0;
    for (std::uint32_t t = 0; t < welded_.triangles.size(); ++t)
      for (std::uint32_t k = 0; k < 3 && !is_done_[t]; ++k) n += cut_at({t, k});
    return n;
  }

 private:
  std::uint32_t place(const Corner& c) const { return welded_.triangles[c.triangle][c.at]; }
  static Corner next(const Corner& c) { return {c.triangle, (c.at + 1) % 3}; }
  static Corner before(const Corner& c) { return {c.triangle, (c.at + 2) % 3}; }

  // The one other triangle at the edge from `half` to the corner behind it, by the corner where it
  // starts there; nothing where there are more, or both run one way.
  std::optional<Corner> across(const Corner& half) const {
    const std::uint32_t edge = edges_.edge_of[half.index()];
    if (edge == kNoEdge || edges_.halves(edge).size() != 2) return {};
    for (const std::uint32_t h : edges_.halves(edge)) {
      const Corner other{h / 3, h % 3};
      if (other.triangle != half.triangle && place(other) == place(next(half))) return other;
    }
    return {};
  }

  // A triangle that runs from place a over b to c, not cut yet, among those at the edge of `half`,
  // whose ends are a and b; by its corner at a.
  std::optional<Corner> find(const Corner& half, std::uint32_t a, std::uint32_t b,
                             std::uint32_t c) const {
    const std::uint32_t edge = edges_.edge_of[half.index()];
    if (edge == kNoEdge) return {};
    for (const std::uint32_t h : edges_.halves(edge)) {
      const Corner first{h / 3, h % 3};
      if (!is_done_[first.triangle] && place(first) == a && place(next(first)) == b &&
          place(before(first)) == c)
        return first;
    }
    return {};
  }

  glm::dvec3 normal(std::uint32_t t) const { return area_normal(mesh_, mesh_.triangles[t]); }
  bool is_one_wedge(const Corner& a, const Corner& b) const {
    return mesh_.triangles[a.triangle][a.at] == mesh_.triangles[b.triangle][b.at] &&
           (mesh_.texcoords.empty() || mesh_.texcoords[a.index()] == mesh_.texcoords[b.index()]);
  }

  // The front's diagonal is the edge from p to q, with r on this side and s on the other.
  std::size_t cut_at(const Corner& p) {
    const std::optional<Corner> other = across(p);
    if (!other || is_done_[other->triangle]) return 0;
    const Corner q = next(p), r = before(p), s = before(*other);
    if (place(r) == place(s)) return 0;
    // The back: s over r to q, and r over s to p; found at the sides q r and s p of the front.
    const auto back_q = find(q, place(r), place(q), place(s));
    const auto back_p = find(next(*other), place(s), place(p), place(r));
    if (!back_q || !back_p || back_q->triangle == back_p->triangle) return 0;
    // At a sheet's border the triangle across is the back's.
    const glm::dvec3 front = normal(p.triangle);
    if (!(glm::dot(front, normal(other->triangle)) > 0) ||
        !(glm::dot(front, normal(back_q->triangle)) < 0) ||
        !(glm::dot(front, normal(back_p->triangle)) < 0))
      return 0;
    const Corner q1 = next(*back_q), p2 = next(*back_p);
    if (!is_one_wedge(*back_q, before(*back_p)) || !is_one_wedge(before(*back_q), *back_p))
      return 0;
    if (!mesh_.materials.empty() &&
        mesh_.materials[back_q->triangle] != mesh_.materials[back_p->triangle])
      return 0;
    for (const std::uint32_t t : {p.triangle, other->triangle, back_q->triangle, back_p->triangle})
      is_done_[t] = true;
    recut(*back_q, q1, *back_p, p2);
    return 2;
  }

  // (r q s) and (s p r) become (r q p) and (s p q).
  void recut(const Corner& r1, const Corner& q1, const Corner& s2, const Corner& p2) {
    const Corner s1 = before(r1), r2 = before(s2);
    set_corner(mesh_.triangles[s1.triangle][s1.at], mesh_.triangles[p2.triangle][p2.at],
               mesh_.triangles[r2.triangle][r2.at], mesh_.triangles[q1.triangle][q1.at]);
    if (!mesh_.texcoords.empty())
      set_corner(mesh_.texcoords[s1.index()], mesh_.texcoords[p2.index()],
                 mesh_.texcoords[r2.index()], mesh_.texcoords[q1.index()]);
    if (!mesh_.corner_normals.empty())
      set_corner(mesh_.corner_normals[s1.index()], mesh_.corner_normals[p2.index()],
                 mesh_.corner_normals[r2.index()], mesh_.corner_normals[q1.index()]);
  }
  template <typename Value>
  static void set_corner(Value& s1, const Value& p2, Value& r2, const Value& q1) {
    s1 = p2, r2 = q1;
  }

  TriMesh& mesh_;
  TriMesh welded_;  // triangles over places
  EdgeTable edges_;
  std::vector<bool> is_done_;
};

}  // namespace

std::size_t cut_backs_alike(TriMesh& mesh, std::span<const std::uint32_t> place) {
  VIEWCELL_CHECK(place.size() == mesh.positions.size(), place.size());
  return BackCutter(mesh, place).cut_all();
}

std::size_t cut_backs_alike(TriMesh& mesh) {
  const std::vector<std::uint32_t> place = match_positions(mesh);
  std::size_t n_places = 0;
  for (std::uint32_t v = 0; v < place.size(); ++v) n_places += place[v] == v;
  return may_have_backs(mesh.triangles.size(), n_places) ? cut_backs_alike(mesh, place) : 0;
}

}  // namespace viewcell

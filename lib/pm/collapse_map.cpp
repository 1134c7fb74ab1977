#include "pm/collapse_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesh/closest_point.h"
#include "pm/nearest.h"

namespace viewcell {
namespace {

// Boxes are rounded outwards by this share: a float's last digit and some for the sums before.
constexpr float kOutward = 1e-6f;

double cross2(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

double CollapseMap::largest_shift() const {
  return std::sqrt(largest2_);
}

bool CollapseMap::gather(std::uint32_t u) {
  spokes_.clear();
  mesh_.for_each_corner(u, [&](std::uint32_t c) {
    const std::uint32_t t = 3 * (c / 3), a = t + (c + 1 - t) % 3, b = t + (c + 2 - t) % 3;
    spokes_.push_back({c / 3, mesh_.vertex_at(a), mesh_.vertex_at(b), wedges_.at(c), wedges_.at(a),
                       wedges_.at(b)});
  });
  // by texture chart; the order within does not matter
  std::sort(spokes_.begin(), spokes_.end(), [](const Spoke& x, const Spoke& y) {
    return x.wedge_u != y.wedge_u ? x.wedge_u < y.wedge_u : x.face < y.face;
  });
  return !spokes_.empty();
}

// Spokes [first, last) as a fan from v on: closed, or open with v at one end (then walked from v,
// whichever way that turns).
bool CollapseMap::order_sector(std::size_t first, std::size_t last, std::uint32_t v) {
  const auto find = [&](std::uint32_t Spoke::*side, std::uint32_t vertex) {
    std::size_t i = first;
    while (i < last && spokes_[i].*side != vertex) ++i;
    return i;
  };
  rim_.clear();
  std::size_t at = find(&Spoke::a, v);
  const bool forward = at < last;
  const auto from = forward ? &Spoke::a : &Spoke::b, to = forward ? &Spoke::b : &Spoke::a;
  const auto wedge_from = forward ? &Spoke::wedge_a : &Spoke::wedge_b;
  const auto wedge_to = forward ? &Spoke::wedge_b : &Spoke::wedge_a;
  if (!forward) at = find(&Spoke::b, v);
  if (at == last) return false;
  is_closed_ = false;
  for (std::size_t n = first; n < last; ++n) {
    const Spoke& spoke = spokes_[at];
    rim_.push_back({spoke.*from, spoke.*wedge_from, spoke.face, {}, {}});
    if (n + 1 < last) {
      at = find(from, spoke.*to);
      if (at == last) return false;  // v is inside an open fan, or there are several fans
    } else {
      is_closed_ = spoke.*to == v;
      if (!is_closed_) rim_.push_back({spoke.*to, spoke.*wedge_to, 0, {}, {}});
    }
  }
  // A closed fan must meet each neighbour once; an open one must not come back.
  for (std::size_t i = 0; i < rim_.size(); ++i)
    for (std::size_t j = i + 1; j < rim_.size(); ++j)
      if (rim_[i].vertex == rim_[j].vertex) return false;
  return is_closed_ ? rim_.size() >= 3 : true;
}

bool CollapseMap::lay(std::uint32_t u, std::uint32_t v) {
  cells_.clear();
  largest2_ = 0;
  keeps_orientation_ = true;
  if (!gather(u)) return false;
  for (std::size_t first = 0, last = 0; first < spokes_.size(); first = last) {
    while (last < spokes_.size() && spokes_[last].wedge_u == spokes_[first].wedge_u) ++last;
    if (!order_sector(first, last, v)) return false;
    if (!texcoords_.empty()) u_uv_ = glm::dvec2(texcoords_[spokes_[first].wedge_u]);
    if (!lay_sector(u, v)) return false;
  }
  return true;
}

bool CollapseMap::lay_sector(std::uint32_t u, std::uint32_t v) {
  u_at_ = glm::dvec3(positions_[u]);
  for (Rim& r : rim_) {
    r.at = glm::dvec3(positions_[r.vertex]);
    if (!texcoords_.empty()) r.uv = glm::dvec2(texcoords_[r.wedge]);
  }
  if (!choose_face()) return false;
  if (!texcoords_.empty()) check_orientation();
  const std::size_t m = middle_;
  if (rim_.size() == 2) {  // a lone triangle, of which an edge remains
    std::uint32_t heir = 0;
    bool found = false;
    mesh_.for_each_corner(v, [&](std::uint32_t c) {
      const std::uint32_t t = 3 * (c / 3), a = t + (c + 1 - t) % 3, b = t + (c + 2 - t) % 3;
      const std::uint32_t va = mesh_.vertex_at(a), vb = mesh_.vertex_at(b);
      if (va != u && vb != u && (va == rim_[1].vertex || vb == rim_[1].vertex))
        heir = c / 3, found = true;
    });
    const std::array<Corner, 3> corners{
        {{u_at_, u_after_}, {rim_[0].at, rim_[0].at}, {rim_[1].at, rim_[1].at}}};
    if (!found) return false;
    add_cell(rim_[0].face, heir, corners);
    cells_.push_back({heir, heir, {}});
    return true;
  }
  const std::array<Corner, 3> corners{
      {{u_at_, u_after_}, {rim_[m].at, rim_[m].at}, {rim_[m + 1].at, rim_[m + 1].at}}};
  add_cell(rim_[m].face, rim_[m].face, corners);
  add_side(true);
  if (is_closed_) add_side(false);
  return true;
}

// New faces are (v, rim[j], rim[j + 1]) for j in [1, size - 2], open or closed.
bool CollapseMap::choose_face() {
  if (!is_closed_)
    choose_on_edge();
  else if (matching_ == Matching::texture)
    choose_by_texture();
  else
    choose_by_distance();
  return std::isfinite(u_after_.x + u_after_.y + u_after_.z);
}

void CollapseMap::choose_on_edge() {
  middle_ = rim_.size() - 2;
  const Rim& far = rim_.back();
  double t = 0;
  if (matching_ == Matching::texture) {
    const glm::dvec2 edge = far.uv - rim_[0].uv;
    const double length2 = glm::dot(edge, edge);
    t = length2 > 0 ? std::clamp(glm::dot(u_uv_ - rim_[0].uv, edge) / length2, 0.0, 1.0) : 0;
  } else {
    t = closest_on_segment(u_at_, rim_[0].at, far.at);
  }
  u_after_ = glm::mix(rim_[0].at, far.at, t);
}

// The new face that u's texture coordinates lie in, or the one that they are least outside of.
void CollapseMap::choose_by_texture() {
  double best = -std::numeric_limits<double>::infinity();
  u_after_ = glm::dvec3(std::numeric_limits<double>::infinity());
  const glm::dvec2 a = rim_[0].uv;
  for (std::size_t j = 1; j + 1 < rim_.size(); ++j) {
    const glm::dvec2 b = rim_[j].uv, c = rim_[j + 1].uv;
    const double area = cross2(b - a, c - a);
    if (area == 0) continue;
    glm::dvec3 w(cross2(b - u_uv_, c - u_uv_), cross2(c - u_uv_, a - u_uv_),
                 cross2(a - u_uv_, b - u_uv_));
    w /= area;
    const double inside = std::min({w.x, w.y, w.z});
    if (!(inside > best)) continue;
    best = inside;
    middle_ = j;
    w = glm::max(w, glm::dvec3(0));
    w /= w.x + w.y + w.z;
    u_after_ = w.x * rim_[0].at + w.y * rim_[j].at + w.z * rim_[j + 1].at;
  }
}

void CollapseMap::choose_by_distance() {
  double best = std::numeric_limits<double>::infinity();
  u_after_ = glm::dvec3(best);
  for (std::size_t j = 1; j + 1 < rim_.size(); ++j) {
    const glm::dvec3 p = closest_point_on_triangle(u_at_, rim_[0].at, rim_[j].at, rim_[j + 1].at);
    const double distance2 = glm::dot(p - u_at_, p - u_at_);
    if (!(distance2 < best)) continue;
    best = distance2;
    middle_ = j;
    u_after_ = p;
  }
}

// Old edge u - rim[i] and new edge v - rim[j].
CollapseMap::Corner CollapseMap::cross(std::size_t i, std::size_t j) const {
  const Rim &n = rim_[i], &w = rim_[j], &v = rim_[0];
  double s = 0, t = 0;
  if (matching_ == Matching::texture) {
    const glm::dvec2 a = n.uv - u_uv_, b = w.uv - v.uv, d = v.uv - u_uv_;
    const double det = cross2(a, b);
    s = det != 0 ? std::clamp(cross2(d, b) / det, 0.0, 1.0) : 0.5;
    t = det != 0 ? std::clamp(cross2(d, a) / det, 0.0, 1.0) : 0.5;
  } else {
    closest_on_segments(u_at_, n.at, v.at, w.at, s, t);
  }
  return {glm::mix(u_at_, n.at, s), glm::mix(v.at, w.at, t)};
}

// Where old edge i meets new edge j, on the side of the middle where rim numbers are lower (left)
// or higher. All new edges start at v, the old edge 0 (and, from the right, size) ends there;
// beyond the middle there is u.
CollapseMap::Corner CollapseMap::corner(std::size_t i, std::size_t j, bool is_left) const {
  const std::size_t beyond = is_left ? middle_ + 1 : middle_;
  if (i == 0 || i == rim_.size()) return {rim_[0].at, rim_[0].at};
  if (i == j) return {rim_[i].at, rim_[i].at};
  if (j == beyond) return {u_at_, u_after_};
  return cross(i, j);
}

// Old face i lies between old edges i and i + 1, new face j between new edges j and j + 1. On the
// left old face i < middle meets the new faces i ... middle, on the right i > middle meets
// middle ... i.
void CollapseMap::add_side(bool is_left) {
  const std::size_t n = rim_.size(), m = middle_;
  const std::size_t first = is_left ? 0 : m + 1, last = is_left ? m : n;
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t j0 = is_left ? std::max<std::size_t>(i, 1) : m;
    const std::size_t j1 = is_left ? m : std::min(i, n - 2);
    for (std::size_t j = j0; j <= j1; ++j) {
      std::array<Corner, 4> corners;
      std::size_t n_corners = 0;
      const std::pair<std::size_t, std::size_t> around[4] = {
          {i, j}, {i, j + 1}, {i + 1, j + 1}, {i + 1, j}};
      for (const auto& [edge, ray] : around) {
        const bool meets = edge == 0 || edge == n || (is_left ? ray >= edge : ray <= edge);
        if (meets) corners[n_corners++] = corner(edge, ray, is_left);
      }
      add_cell(rim_[i].face, rim_[j].face, {corners.data(), n_corners});
    }
  }
}

// corners: around the cell.
void CollapseMap::add_cell(std::uint32_t old_face, std::uint32_t new_face,
                           std::span<const Corner> corners) {
  std::array<glm::dvec3, 4> shift;
  glm::dvec3 lo(std::numeric_limits<double>::infinity()), hi(-lo);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    shift[i] = corners[i].before - corners[i].after;
    lo = glm::min(lo, shift[i]), hi = glm::max(hi, shift[i]);
    largest2_ = std::max(largest2_, glm::dot(shift[i], shift[i]));
  }
  const glm::vec3 l(lo), h(hi);
  const glm::vec3 out = kOutward * glm::max(glm::abs(l), glm::abs(h));
  MapCell cell{old_face, new_face, {l - out, h + out}};
  for (std::size_t i = 1; with_moments_ && i + 1 < corners.size(); ++i) {
    const glm::dvec3 p = corners[0].before;
    const double area =
        0.5 * glm::length(glm::cross(corners[i].before - p, corners[i + 1].before - p));
    const glm::dvec3 sum = shift[0] + shift[i] + shift[i + 1];
    cell.area += area;
    cell.mean += area / 3 * sum;
    cell.square += area / 12 *
                   (glm::dot(shift[0], shift[0]) + glm::dot(shift[i], shift[i]) +
                    glm::dot(shift[i + 1], shift[i + 1]) + glm::dot(sum, sum));
  }
  if (cell.area > 0) cell.mean /= cell.area, cell.square /= cell.area;
  cells_.push_back(cell);
}

void CollapseMap::check_orientation() {
  for (std::size_t j = 1; j + 1 < rim_.size(); ++j) {
    const glm::dvec2 b = rim_[j].uv, c = rim_[j + 1].uv;
    const double before = cross2(b - u_uv_, c - u_uv_);
    const double after = cross2(b - rim_[0].uv, c - rim_[0].uv);
    if (!(before * after > 0)) keeps_orientation_ = false;
  }
}

}  // namespace viewcell

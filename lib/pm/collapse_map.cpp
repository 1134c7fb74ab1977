#include "pm/collapse_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesh/closest_point.h"
#include "pm/nearest.h"

namespace viewcell {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Boxes are rounded outwards by this share: a float's last digit and some for the sums before.
constexpr float kOutward = 1e-6f;

double cross2(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

// The rim as it is met when walked from v.
struct Walk {
  const CollapseStar::Sector& sector;
  std::size_t v;
  int step;
  std::size_t index(std::size_t i) const {
    const std::size_t n = sector.rim.size();
    if (step > 0) return v + i < n ? v + i : v + i - n;
    return v >= i ? v - i : v + n - i;
  }
  const CollapseStar::Rim& operator[](std::size_t i) const { return sector.rim[index(i)]; }
  // Of the triangle from the i-th neighbour to the next.
  std::uint32_t face(std::size_t i) const {
    return sector.rim[step > 0 ? index(i) : index(i + 1)].face;
  }
};

}  // namespace

double CollapseMap::largest_shift() const {
  return std::sqrt(largest2_);
}

bool CollapseMap::place(std::uint32_t u, std::uint32_t v) {
  if (star_.of() != u) {
    placed_.clear();
    places_.clear();
    if (!star_.gather(u)) return false;
  } else if (!star_.gather(u)) {
    return false;
  }
  const std::size_t n = star_.sectors().size();
  auto found = std::find_if(placed_.begin(), placed_.end(), [&](auto& p) { return p.v == v; });
  if (found == placed_.end()) {
    Placed placed{v, true, places_.size()};
    for (const CollapseStar::Sector& sector : star_.sectors()) {
      places_.emplace_back();
      placed.is_legal = placed.is_legal && place_sector(sector, v, places_.back());
    }
    found = placed_.insert(placed_.end(), placed);
  }
  last_ = std::span<const Place>(places_).subspan(found->first, n);
  return found->is_legal;
}

bool CollapseMap::place_sector(const CollapseStar::Sector& sector, std::uint32_t v,
                               Place& place) const {
  const auto& rim = sector.rim;
  while (place.v < rim.size() && rim[place.v].vertex != v) ++place.v;
  if (place.v == rim.size()) return false;
  place.after = glm::dvec3(kInfinity);
  if (!sector.is_closed) {
    if (place.v != 0 && place.v + 1 != rim.size()) return false;
    place.step = place.v == 0 ? 1 : -1;
    choose_on_edge(sector, place);
  } else if (matching_ == Matching::texture) {
    choose_by_texture(sector, place);
  } else {
    choose_by_distance(sector, place);
  }
  place.face = Walk{sector, place.v, place.step}.face(place.middle);
  return std::isfinite(place.after.x + place.after.y + place.after.z);
}

void CollapseMap::choose_on_edge(const CollapseStar::Sector& sector, Place& place) const {
  const Walk rim{sector, place.v, place.step};
  const std::size_t n = sector.rim.size();
  place.middle = n - 2;
  const CollapseStar::Rim &v = rim[0], &far = rim[n - 1];
  double t = 0;
  if (matching_ == Matching::texture) {
    const glm::dvec2 edge = far.uv - v.uv;
    const double length2 = glm::dot(edge, edge);
    t = length2 > 0 ? std::clamp(-glm::dot(v.uv, edge) / length2, 0.0, 1.0) : 0;
  } else {
    t = closest_on_segment(glm::dvec3(0), v.to, far.to);
  }
  place.after = glm::mix(v.to, far.to, t);
}

// The new face that u's texture coordinates lie in, or the one that they are least outside of.
void CollapseMap::choose_by_texture(const CollapseStar::Sector& sector, Place& place) const {
  const Walk rim{sector, place.v, place.step};
  double best = -kInfinity;
  const CollapseStar::Rim& v = rim[0];
  for (std::size_t j = 1; j + 1 < sector.rim.size(); ++j) {
    const CollapseStar::Rim &b = rim[j], &c = rim[j + 1];
    const double area = cross2(b.uv - v.uv, c.uv - v.uv);
    if (area == 0) continue;
    glm::dvec3 w(cross2(b.uv, c.uv), cross2(c.uv, v.uv), cross2(v.uv, b.uv));
    w /= area;
    const double inside = std::min({w.x, w.y, w.z});
    if (!(inside > best)) continue;
    best = inside;
    place.middle = j;
    w = glm::max(w, glm::dvec3(0));
    w /= w.x + w.y + w.z;
    place.after = w.x * v.to + w.y * b.to + w.z * c.to;
  }
}

void CollapseMap::choose_by_distance(const CollapseStar::Sector& sector, Place& place) const {
  const Walk rim{sector, place.v, place.step};
  double best = kInfinity;
  for (std::size_t j = 1; j + 1 < sector.rim.size(); ++j) {
    const glm::dvec3 p =
        closest_point_on_triangle(glm::dvec3(0), rim[0].to, rim[j].to, rim[j + 1].to);
    const double distance2 = glm::dot(p, p);
    if (!(distance2 < best)) continue;
    best = distance2;
    place.middle = j;
    place.after = p;
  }
}

bool CollapseMap::lay(std::uint32_t u, std::uint32_t v) {
  cells_.clear();
  moments_.clear();
  largest2_ = 0;
  if (!place(u, v)) return false;
  for (std::size_t i = 0; i < last_.size(); ++i)
    if (!lay_sector(star_.sectors()[i], last_[i], v)) return false;
  return true;
}

bool CollapseMap::lay_sector(const CollapseStar::Sector& sector, const Place& place,
                             std::uint32_t v) {
  if (sector.rim.size() == 2) return lay_lone(sector, place, v);
  make_rays(sector, place);
  const std::size_t n = rays_.size(), m = place.middle;
  const Double4 after = make_double4(place.after);
  largest2_ = std::max(largest2_, dot(after, after));
  const Corner at_u{-after, {}}, left{{}, rays_[m].to}, right{{}, rays_[m + 1].to};
  add_cell({place.face, place.face}, {at_u, left, right, right});
  add_side(m, true, after);
  if (sector.is_closed) add_side(n - 2 - m, false, after);
  return true;
}

// A lone triangle, of which an edge remains: some face there takes it.
bool CollapseMap::lay_lone(const CollapseStar::Sector& sector, const Place& place,
                           std::uint32_t v) {
  const Walk rim{sector, place.v, place.step};
  const std::uint32_t u = star_.of(), far = rim[1].vertex;
  std::uint32_t heir = 0;
  bool found = false;
  mesh_.for_each_corner(v, [&](std::uint32_t c) {
    const std::uint32_t t = 3 * (c / 3), a = t + (c + 1 - t) % 3, b = t + (c + 2 - t) % 3;
    const std::uint32_t va = mesh_.vertex_at(a), vb = mesh_.vertex_at(b);
    if (va != u && vb != u && (va == far || vb == far)) heir = c / 3, found = true;
  });
  if (!found) return false;
  const std::uint32_t to = star_.place_of(heir);
  const Double4 after = make_double4(place.after);
  largest2_ = std::max(largest2_, dot(after, after));
  const Corner at_u{-after, {}}, left{{}, make_double4(rim[0].to)};
  const Corner right{{}, make_double4(rim[1].to)};
  add_cell({rim.face(0), to}, {at_u, left, right, right});
  cells_.push_back({to, to, VectorBox{}});
  if (with_moments_) moments_.emplace_back();
  return true;
}

// The rim from v on, and v once more where it is closed.
void CollapseMap::make_rays(const CollapseStar::Sector& sector, const Place& place) {
  const Walk rim{sector, place.v, place.step};
  const std::size_t n = sector.rim.size() + (sector.is_closed ? 1 : 0);
  to_v_ = make_double4(rim[0].to);
  uv_to_v_ = rim[0].uv;
  rays_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const CollapseStar::Rim& r = i < sector.rim.size() ? rim[i] : rim[0];
    const Double4 to = make_double4(r.to), from_v = to - to_v_;
    rays_[i] = {to,
                from_v,
                dot(to, to),
                dot(from_v, from_v),
                dot(to, to_v_),
                dot(from_v, to_v_),
                r.uv,
                i + 1 < n ? rim.face(i) : 0};
  }
}

// Where an old and a new edge cross.
CollapseMap::Corner CollapseMap::cross(const Ray& old_edge, const Ray& new_edge) {
  double s = 0, t = 0;
  if (matching_ == Matching::texture) {
    const glm::dvec2 a = old_edge.uv, b = new_edge.uv - uv_to_v_;
    const double det = cross2(a, b);
    s = det != 0 ? std::clamp(cross2(uv_to_v_, b) / det, 0.0, 1.0) : 0.5;
    t = det != 0 ? std::clamp(cross2(uv_to_v_, a) / det, 0.0, 1.0) : 0.5;
  } else {
    closest_on_segments({.aa = old_edge.to2,
                         .bb = new_edge.from_v2,
                         .ab = dot(old_edge.to, new_edge.from_v),
                         .ar = -old_edge.to_v,
                         .br = -new_edge.from_v_v},
                        s, t);
  }
  const Double4 before = s * old_edge.to, shift = before - to_v_ - t * new_edge.from_v;
  largest2_ = std::max(largest2_, dot(shift, shift));
  return {shift, before};
}

// One side of the star, from v to the middle; the left is the one on which the rim's numbers are
// lower. Old edges i = 0 ... middle (0 ends at v) make rows of corners with new edges j > i, up to
// the one beyond the middle, where u is. Old face i lies between rows i and i + 1, new face j
// between columns j and j + 1.
void CollapseMap::add_side(std::size_t middle, bool is_left, const Double4& u_after) {
  const std::size_t last = rays_.size() - 1;
  const auto ray = [&](std::size_t i) -> const Ray& { return rays_[is_left ? i : last - i]; };
  const auto face = [&](std::size_t i) { return rays_[is_left ? i : last - i - 1].face; };
  const std::size_t beyond = middle + 1;
  row_.assign(beyond + 1, Corner{{}, to_v_});
  next_row_.resize(beyond + 1);
  for (std::size_t i = 0; i < middle; ++i) {
    next_row_[i + 1] = Corner{{}, ray(i + 1).to};
    for (std::size_t j = i + 2; j < beyond; ++j) next_row_[j] = cross(ray(i + 1), ray(j));
    next_row_[beyond] = Corner{-u_after, {}};
    for (std::size_t j = std::max<std::size_t>(i, 1); j <= middle; ++j) {
      const Corner& last_corner = j > i ? next_row_[j] : next_row_[j + 1];
      add_cell({face(i), face(j)}, {row_[j], row_[j + 1], next_row_[j + 1], last_corner});
    }
    std::swap(row_, next_row_);
  }
}

void CollapseMap::add_cell(const MapCell& of, const Around& around) {
  const auto& [a, b, c, d] = around;
  Double4 lo = a.shift < b.shift ? a.shift : b.shift, hi = a.shift > b.shift ? a.shift : b.shift;
  for (const Double4& shift : {c.shift, d.shift}) {
    lo = lo < shift ? lo : shift;
    hi = hi > shift ? hi : shift;
  }
  const Float4 l = __builtin_convertvector(lo, Float4), h = __builtin_convertvector(hi, Float4);
  const Float4 far = h > -l ? h : -l;  // the larger absolute value
  cells_.push_back({of.old_face, of.new_face, {l - kOutward * far, h + kOutward * far}});
  if (with_moments_) add_moments(around);
}

void CollapseMap::add_moments(const Around& around) {
  const auto at = [](const Double4& v) { return glm::dvec3(v[0], v[1], v[2]); };
  CellMoments& cell = moments_.emplace_back();
  const glm::dvec3 a = at(around.a.shift), p = at(around.a.before);
  for (const auto& [second, third] : {std::pair(&around.b, &around.c), {&around.c, &around.d}}) {
    const glm::dvec3 q = at(second->before) - p, r = at(third->before) - p;
    const glm::dvec3 b = at(second->shift), c = at(third->shift), sum = a + b + c;
    const double area = 0.5 * glm::length(glm::cross(q, r));
    cell.area += area;
    cell.mean += area / 3 * sum;
    cell.square +=
        area / 12 * (glm::dot(a, a) + glm::dot(b, b) + glm::dot(c, c) + glm::dot(sum, sum));
  }
  if (cell.area > 0) cell.mean /= cell.area, cell.square /= cell.area;
}

bool CollapseMap::keeps_texture_orientation() const {
  if (!star_.has_texcoords()) return true;
  for (std::size_t i = 0; i < last_.size(); ++i) {
    const CollapseStar::Sector& sector = star_.sectors()[i];
    const Walk rim{sector, last_[i].v, last_[i].step};
    for (std::size_t j = 1; j + 1 < sector.rim.size(); ++j) {
      const glm::dvec2 b = rim[j].uv, c = rim[j + 1].uv, v = rim[0].uv;
      if (!(cross2(b, c) * cross2(b - v, c - v) > 0)) return false;
    }
  }
  return true;
}

}  // namespace viewcell

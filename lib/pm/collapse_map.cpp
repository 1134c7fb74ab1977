#include "pm/collapse_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtx/exterior_product.hpp>
#include <limits>

#include "mesh/closest_on_segment.h"
#include "mesh/closest_point.h"

namespace viewcell {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// In the texture u keeps this far from the edges of its new face, as a weight of a corner: cells
// at an edge would vanish.
constexpr double kInside = 1.0 / 16384;

// Weights of a point of a triangle, not below 0; of one corner where the triangle has no area.
glm::dvec3 barycentric(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                       const glm::dvec3& c) {
  const glm::dvec3 n = glm::cross(b - a, c - a);
  glm::dvec3 w(glm::dot(n, glm::cross(b - p, c - p)), glm::dot(n, glm::cross(c - p, a - p)),
               glm::dot(n, glm::cross(a - p, b - p)));
  w = glm::max(w, glm::dvec3(0));
  const double sum = w.x + w.y + w.z;
  return sum > 0 ? w / sum : glm::dvec3(1, 0, 0);
}

bool is_finite(const glm::dvec3& p) {
  return std::isfinite(p.x + p.y + p.z);
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

bool CollapseMap::gather(std::uint32_t u) {
  if (star_.of() != u) located_.clear(), locations_.clear();
  return star_.gather(u);
}

bool CollapseMap::locate(std::uint32_t u, std::uint32_t v) {
  if (!gather(u)) return false;
  auto found = std::find_if(located_.begin(), located_.end(), [&](auto& p) { return p.v == v; });
  if (found == located_.end()) {
    Located located{v, true, locations_.size()};
    for (const Sector& sector : star_.sectors()) {
      Location& location = locations_.emplace_back();
      located.is_legal =
          located.is_legal && locate_sector(sector, v, location) && choose_face(sector, location);
    }
    found = located_.insert(located_.end(), located);
  }
  last_ = std::span<const Location>(locations_).subspan(found->first, star_.sectors().size());
  return found->is_legal;
}

bool CollapseMap::locate_sector(const Sector& sector, std::uint32_t v, Location& location) const {
  const auto& rim = sector.rim;
  while (location.v < rim.size() && rim[location.v].vertex != v) ++location.v;
  if (location.v == rim.size()) return false;
  if (!sector.is_closed && location.v != 0 && location.v + 1 != rim.size()) return false;
  location.step = sector.is_closed || location.v == 0 ? 1 : -1;
  location.apex = rim[location.v].to;
  return true;
}

// New faces are (v, rim[j], rim[j + 1]) for j in [1, size - 2], open or closed.
bool CollapseMap::choose_face(const Sector& sector, Location& location) const {
  location.after = {glm::dvec3(kInfinity)};
  if (!sector.is_closed)
    choose_on_edge(sector, location);
  else if (matching_ == Matching::texture)
    choose_by_texture(sector, location);
  else
    choose_by_distance(sector, location);
  location.face = Walk{sector, location.v, location.step}.face(location.middle);
  return is_finite(location.after.at);
}

void CollapseMap::choose_on_edge(const Sector& sector, Location& location) const {
  const Walk rim{sector, location.v, location.step};
  const std::size_t n = sector.rim.size();
  location.middle = n - 2;
  const CollapseStar::Rim &v = rim[0], &far = rim[n - 1];
  double t = 0;
  if (matching_ == Matching::texture) {
    const glm::dvec2 edge = far.uv - v.uv;
    const double length2 = glm::dot(edge, edge);
    t = length2 > 0 ? std::clamp(-glm::dot(v.uv, edge) / length2, 0.0, 1.0) : 0;
  } else {
    t = closest_on_segment(glm::dvec3(0), location.apex, far.to);
  }
  const double inside = matching_ == Matching::texture ? t : std::clamp(t, kInside, 1 - kInside);
  location.after = {glm::mix(location.apex, far.to, t), glm::mix(v.uv, far.uv, inside)};
}

// The new face that u's texture coordinates lie in, or the one that they are least outside of.
void CollapseMap::choose_by_texture(const Sector& sector, Location& location) const {
  const Walk rim{sector, location.v, location.step};
  double best = -kInfinity;
  const CollapseStar::Rim& v = rim[0];
  for (std::size_t j = 1; j + 1 < sector.rim.size(); ++j) {
    const CollapseStar::Rim &b = rim[j], &c = rim[j + 1];
    const double area = glm::cross(b.uv - v.uv, c.uv - v.uv);
    if (area == 0) continue;
    glm::dvec3 w(glm::cross(b.uv, c.uv), glm::cross(c.uv, v.uv), glm::cross(v.uv, b.uv));
    w /= area;
    const double inside = std::min({w.x, w.y, w.z});
    if (!(inside > best)) continue;
    best = inside;
    location.middle = j;
    w = glm::max(w, glm::dvec3(0));
    w /= w.x + w.y + w.z;
    location.after = {w.x * location.apex + w.y * b.to + w.z * c.to,
                      w.x * v.uv + w.y * b.uv + w.z * c.uv};
  }
}

void CollapseMap::choose_by_distance(const Sector& sector, Location& location) const {
  const Walk rim{sector, location.v, location.step};
  double best = kInfinity;
  for (std::size_t j = 1; j + 1 < sector.rim.size(); ++j) {
    const glm::dvec3 p =
        closest_point_on_triangle(glm::dvec3(0), location.apex, rim[j].to, rim[j + 1].to);
    const double distance2 = glm::dot(p, p);
    if (!(distance2 < best)) continue;
    best = distance2;
    location.middle = j;
    location.after.at = p;
  }
  if (best < kInfinity)
    location.after = point_on({location.apex, rim[0].uv}, rim[location.middle],
                              rim[location.middle + 1], location.after.at);
}

bool CollapseMap::build(std::uint32_t u, std::uint32_t v) {
  overlay_.clear();
  return locate(u, v) && build_located(v);
}

bool CollapseMap::build(std::uint32_t u, std::uint32_t v, const glm::dvec3& apex) {
  overlay_.clear();
  if (!gather(u)) return false;
  moved_.clear();
  for (const Sector& sector : star_.sectors()) {
    Location& location = moved_.emplace_back();
    if (!locate_sector(sector, v, location)) return false;
    location.apex = apex - glm::dvec3(positions_[u]);
    if (!choose_face(sector, location)) return false;
  }
  last_ = moved_;
  return build_located(v);
}

bool CollapseMap::build_located(std::uint32_t v) {
  for (std::size_t i = 0; i < last_.size(); ++i) {
    const Sector& sector = star_.sectors()[i];
    if (sector.rim.size() > 2)
      build_sector(sector, last_[i]);
    else if (!build_vanishing(sector, last_[i], v))
      return false;
  }
  return true;
}

void CollapseMap::build_sector(const Sector& sector, const Location& location) {
  const Walk rim{sector, location.v, location.step};
  const std::size_t n = sector.rim.size(), m = location.middle;
  const FanPoint apex{location.apex, rim[0].uv};
  overlay_.start(apex, sector.origin, location.step < 0);
  overlay_.add_ray(apex, rim.face(0));
  for (std::size_t i = 1; i < n; ++i) overlay_.add_ray({rim[i].to, rim[i].uv}, rim.face(i));
  overlay_.add_old_apex(m, location.after);
  overlay_.add_side(0, true, m, apex, location.after);
  if (sector.is_closed) overlay_.add_side(n, false, n - 1 - m, apex, location.after);
}

// A face at the edge a b that has not the vertex `but`.
bool CollapseMap::find_face_at(std::uint32_t a, std::uint32_t b, std::uint32_t but,
                               std::uint32_t& face) const {
  if (mesh_.is_hub(a) && mesh_.n_sheet_triangles(b) < mesh_.n_sheet_triangles(a)) std::swap(a, b);
  const std::uint32_t found = mesh_.lists().find(a, [&](std::uint32_t c) {
    const std::uint32_t t = 3 * (c / 3);
    const std::uint32_t x = mesh_.vertex_at(t + (c + 1 - t) % 3);
    const std::uint32_t y = mesh_.vertex_at(t + (c + 2 - t) % 3);
    return x != but && y != but && (x == b || y == b);
  });
  face = found / 3;
  return found != CornerLists::kNone;
}

// A triangle that is alone in its sector vanishes but for an edge: some face at that edge inherits
// its surface.
bool CollapseMap::build_vanishing(const Sector& sector, const Location& location, std::uint32_t v) {
  const Walk rim{sector, location.v, location.step};
  const std::uint32_t u = star_.of(), far = rim[1].vertex;
  std::uint32_t inheriting_face = 0;
  if (!find_face_at(v, far, u, inheriting_face)) return false;
  const std::uint32_t to = star_.index_of(inheriting_face);
  const FanPoint apex{location.apex, rim[0].uv};
  overlay_.start(apex, sector.origin, location.step < 0);
  overlay_.add_ray(apex, rim.face(0));
  overlay_.add_ray({rim[1].to, rim[1].uv}, rim.face(0));
  overlay_.add_vanishing_face(to, location.after);
  return true;
}

bool CollapseMap::build_move(std::uint32_t v, const glm::dvec3& apex,
                             std::span<const WedgeMove> texcoords) {
  overlay_.clear();
  if (!gather(v)) return false;
  const glm::dvec3 to = apex - glm::dvec3(positions_[v]);
  if (!is_finite(to)) return false;
  for (const Sector& sector : star_.sectors()) {
    FanPoint location{to};
    for (const WedgeMove& move : texcoords)
      if (move.wedge == sector.wedge) location.texture = glm::dvec2(move.texcoord) - sector.origin;
    if (!(sector.is_closed ? move_closed(sector, location) : move_open(sector, location)))
      return false;
  }
  return true;
}

// The point of the face (top, b, c) that lies at `at`; in the texture inside of it.
FanPoint CollapseMap::point_on(const FanPoint& top, const CollapseStar::Rim& b,
                               const CollapseStar::Rim& c, const glm::dvec3& at) const {
  if (!overlay_.keeps_texture()) return {at};
  glm::dvec3 w = barycentric(at, top.at, b.to, c.to);
  w = (w + glm::dvec3(kInside)) / (1 + 3 * kInside);
  return {at, w.x * top.texture + w.y * b.uv + w.z * c.uv};
}

// The new apex lies in the old face of ray 0, the old apex in the new face of ray m.
bool CollapseMap::move_closed(const Sector& sector, const FanPoint& apex) {
  const std::size_t n = sector.rim.size();
  const auto at = [&](std::size_t i) -> const CollapseStar::Rim& { return sector.rim[i % n]; };
  glm::dvec3 before(0), after(0);
  const auto find = [&](const glm::dvec3& p, const glm::dvec3& top, std::size_t but,
                        glm::dvec3& nearest) {
    double best = kInfinity;
    std::size_t found = n;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == but) continue;
      const glm::dvec3 q = closest_point_on_triangle(p, top, at(i).to, at(i + 1).to);
      const double distance2 = glm::dot(q - p, q - p);
      if (distance2 < best) best = distance2, found = i, nearest = q;
    }
    return found;
  };
  const std::size_t k = find(apex.at, glm::dvec3(0), n, before);
  const std::size_t face = find(glm::dvec3(0), apex.at, k, after);
  if (k == n || face == n) return false;
  overlay_.start(apex, sector.origin);
  for (std::size_t i = 0; i < n; ++i)
    overlay_.add_ray({at(k + i).to, at(k + i).uv}, at(k + i).face);
  overlay_.repeat_ray(0), overlay_.repeat_ray(1);
  const std::size_t m = (face + n - k) % n;
  const FanPoint new_on_old = point_on({}, at(k), at(k + 1), before);
  const FanPoint old_on_new = point_on(apex, at(face), at(face + 1), after);
  overlay_.add_old_apex(m, old_on_new);
  overlay_.add_new_apex(0, new_on_old);
  overlay_.add_side(0, true, m, new_on_old, old_on_new);
  overlay_.add_side(n + 1, false, n - m, new_on_old, old_on_new);
  return true;
}

// The new apex goes to the nearer of the two old boundary edges, the old apex to the other's new
// one.
bool CollapseMap::move_open(const Sector& sector, const FanPoint& apex) {
  const std::size_t n = sector.rim.size();
  const auto along = [&](const CollapseStar::Rim& rim) {
    return closest_on_segment(apex.at, glm::dvec3(0), rim.to);
  };
  const auto inside = [](double t) { return std::clamp(t, kInside, 1 - kInside); };
  const double first = along(sector.rim[0]), last = along(sector.rim[n - 1]);
  const bool is_first = glm::distance(first * sector.rim[0].to, apex.at) <=
                        glm::distance(last * sector.rim[n - 1].to, apex.at);
  const Walk rim{sector, is_first ? 0 : n - 1, is_first ? 1 : -1};
  const double s = is_first ? first : last;
  const FanPoint before{s * rim[0].to, inside(s) * rim[0].uv};
  const double t = closest_on_segment(glm::dvec3(0), apex.at, rim[n - 1].to);
  const FanPoint after{glm::mix(apex.at, rim[n - 1].to, t),
                       glm::mix(apex.texture, rim[n - 1].uv, inside(t))};
  overlay_.start(apex, sector.origin, !is_first);
  for (std::size_t i = 0; i < n; ++i)
    overlay_.add_ray({rim[i].to, rim[i].uv}, i + 1 < n ? rim.face(i) : 0);
  if (n == 2) {  // one face before and after
    overlay_.add_old_apex(0, apex);
    return true;
  }
  overlay_.add_old_apex(n - 2, after);
  overlay_.add_new_apex(0, before);
  overlay_.add_side(0, true, n - 2, before, after);
  return true;
}

}  // namespace viewcell

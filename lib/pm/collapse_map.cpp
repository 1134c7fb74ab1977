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
  std::span<const CollapseStar::Rim> rim;
  std::size_t v;
  int step;
  std::size_t index(std::size_t i) const {
    const std::size_t n = rim.size();
    if (step > 0) return v + i < n ? v + i : v + i - n;
    return v >= i ? v - i : v + n - i;
  }
  const CollapseStar::Rim& operator[](std::size_t i) const { return rim[index(i)]; }
  // Of the triangle from the i-th neighbour to the next.
  std::uint32_t face(std::size_t i) const { return rim[step > 0 ? index(i) : index(i + 1)].face; }
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
    const std::size_t first = locations_.size();
    const glm::dvec3 apex = glm::dvec3(positions_[v]) - glm::dvec3(positions_[u]);
    const bool is_legal = locate_all(v, apex, locations_);
    found = located_.insert(located_.end(), {v, is_legal, first, locations_.size() - first});
  }
  last_ = std::span<const Location>(locations_).subspan(found->first, found->n);
  return found->is_legal;
}

bool CollapseMap::locate_all(std::uint32_t v, const glm::dvec3& apex,
                             std::vector<Location>& to) const {
  for (const Sector& sector : star_.sectors()) {
    const std::span<const CollapseStar::Rim> rim = sector.rim;
    const std::size_t n = rim.size();
    std::size_t i = 0;
    while (i < n && rim[i].vertex != v) ++i;
    if (i == n) {
      if (!locate_moved(sector, v, apex, to)) return false;
    } else if (sector.is_closed || i == 0 || i + 1 == n) {
      if (!locate_at(sector, rim, i, apex, to)) return false;
    } else if (!sector.is_cut || !locate_at(sector, rim.first(i + 1), i, apex, to) ||
               !locate_at(sector, rim.subspan(i), 0, apex, to)) {
      return false;
    }
  }
  return true;
}

// v is the i-th of the rim, which is the sector's or one side's.
bool CollapseMap::locate_at(const Sector& sector, std::span<const CollapseStar::Rim> rim,
                            std::size_t i, const glm::dvec3& apex,
                            std::vector<Location>& to) const {
  Location& location = to.emplace_back(sector, rim, apex);
  location.step = sector.is_closed || i == 0 ? 1 : -1;
  location.v = i;
  return choose_face(location);
}

// In the texture it goes where a fan of its chart goes that v is in; without one u would leave the
// border of the chart.
bool CollapseMap::locate_moved(const Sector& sector, std::uint32_t v, const glm::dvec3& apex,
                               std::vector<Location>& to) const {
  if (matching_ == Matching::texture) return false;
  Location& location = to.emplace_back(sector, sector.rim, apex);
  location.is_moved = true;
  const CollapseStar::Rim* met = nullptr;
  for (const Sector& other : star_.sectors())
    if (other.chart == sector.chart)
      for (const CollapseStar::Rim& rim : other.rim)
        if (rim.vertex == v) met = &rim;
  if (!met) return false;
  location.apex_uv = met->uv;
  const std::optional<Move> move = find_move(sector, {apex, location.apex_uv});
  if (!move) return false;
  location.after = move->after;
  location.face = sector.rim[move->second].face;
  return is_finite(location.after.at);
}

// New faces are (v, rim[j], rim[j + 1]) for j in [1, size - 2], open or closed.
bool CollapseMap::choose_face(Location& location) const {
  location.after = {glm::dvec3(kInfinity)};
  if (!location.sector->is_closed)
    choose_on_edge(location);
  else if (matching_ == Matching::texture)
    choose_by_texture(location);
  else
    choose_by_distance(location);
  location.face = Walk{location.rim, location.v, location.step}.face(location.middle);
  return is_finite(location.after.at);
}

void CollapseMap::choose_on_edge(Location& location) const {
  const Walk rim{location.rim, location.v, location.step};
  const std::size_t n = location.rim.size();
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
void CollapseMap::choose_by_texture(Location& location) const {
  const Walk rim{location.rim, location.v, location.step};
  double best = -kInfinity, area_there = 0;
  glm::dvec3 there(0);  // weights of its corners, times its area
  const CollapseStar::Rim &v = rim[0], *b = &rim[1];
  glm::dvec2 to_b = b->uv - v.uv;
  double weight_c = glm::cross(v.uv, b->uv);
  for (std::size_t j = 1; j + 1 < location.rim.size(); ++j) {
    const CollapseStar::Rim* c = &rim[j + 1];
    const glm::dvec2 to_c = c->uv - v.uv;
    const double area = glm::cross(to_b, to_c), weight_b = glm::cross(c->uv, v.uv);
    const glm::dvec3 w(glm::cross(b->uv, c->uv), weight_b, weight_c);
    b = c, to_b = to_c, weight_c = -weight_b;  // of the next face
    if (area == 0) continue;
    const double least = area > 0 ? std::min({w.x, w.y, w.z}) : -std::max({w.x, w.y, w.z});
    if (!(least > best * std::abs(area))) continue;
    best = least / std::abs(area);
    location.middle = j;
    there = w, area_there = area;
  }
  if (area_there == 0) return;
  const CollapseStar::Rim &left = rim[location.middle], &right = rim[location.middle + 1];
  glm::dvec3 w = glm::max(there / area_there, glm::dvec3(0));
  w /= w.x + w.y + w.z;
  location.after = {w.x * location.apex + w.y * left.to + w.z * right.to,
                    w.x * v.uv + w.y * left.uv + w.z * right.uv};
}

void CollapseMap::choose_by_distance(Location& location) const {
  const Walk rim{location.rim, location.v, location.step};
  double best = kInfinity;
  for (std::size_t j = 1; j + 1 < location.rim.size(); ++j) {
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
  if (!locate_all(v, apex - glm::dvec3(positions_[u]), moved_)) return false;
  last_ = moved_;
  return build_located(v);
}

bool CollapseMap::build_located(std::uint32_t v) {
  for (const Location& location : last_) {
    if (location.is_moved) {
      if (!move_sector(*location.sector, {location.apex, location.apex_uv})) return false;
    } else if (location.rim.size() > 2) {
      build_sector(location);
    } else if (!build_vanishing(location, v)) {
      return false;
    }
  }
  return true;
}

void CollapseMap::build_sector(const Location& location) {
  const Walk rim{location.rim, location.v, location.step};
  const std::size_t n = location.rim.size(), m = location.middle;
  const FanPoint apex{location.apex, rim[0].uv};
  overlay_.start(apex, location.sector->origin, location.step < 0);
  overlay_.add_ray(apex, rim.face(0));
  for (std::size_t i = 1; i < n; ++i) overlay_.add_ray({rim[i].to, rim[i].uv}, rim.face(i));
  overlay_.add_old_apex(m, location.after);
  overlay_.add_side(0, true, m, apex, location.after);
  if (location.sector->is_closed) overlay_.add_side(n, false, n - 1 - m, apex, location.after);
}

// A face at the edge a b that has not the vertex `but`.
std::optional<std::uint32_t> CollapseMap::find_face_at(std::uint32_t a, std::uint32_t b,
                                                       std::uint32_t but) const {
  if (mesh_.is_hub(a) && mesh_.n_sheet_triangles(b) < mesh_.n_sheet_triangles(a)) std::swap(a, b);
  const std::uint32_t found = mesh_.lists().find(a, [&](std::uint32_t c) {
    const std::uint32_t t = 3 * (c / 3);
    const std::uint32_t x = mesh_.vertex_at(t + (c + 1 - t) % 3);
    const std::uint32_t y = mesh_.vertex_at(t + (c + 2 - t) % 3);
    return x != but && y != but && (x == b || y == b);
  });
  if (found == CornerLists::kNone) return {};
  return found / 3;
}

// A face of v that has not the vertex `but`.
std::optional<std::uint32_t> CollapseMap::find_other_face(std::uint32_t v,
                                                          std::uint32_t but) const {
  const std::uint32_t found = mesh_.lists().find(v, [&](std::uint32_t c) {
    const std::uint32_t t = 3 * (c / 3);
    return mesh_.vertex_at(t) != but && mesh_.vertex_at(t + 1) != but &&
           mesh_.vertex_at(t + 2) != but;
  });
  if (found == CornerLists::kNone) return {};
  return found / 3;
}

// A triangle that is alone in its sector vanishes but for an edge: some face at that edge inherits
// its surface. Where it was a fin, the edge goes with it, and a face at v inherits.
bool CollapseMap::build_vanishing(const Location& location, std::uint32_t v) {
  const Walk rim{location.rim, location.v, location.step};
  const std::uint32_t u = star_.of();
  const auto at_edge = find_face_at(v, rim[1].vertex, u);
  const auto inheriting_face = at_edge ? at_edge : find_other_face(v, u);
  if (!inheriting_face) return false;
  const std::uint32_t to = star_.index_of(*inheriting_face);
  const FanPoint apex{location.apex, rim[0].uv};
  overlay_.start(apex, location.sector->origin, location.step < 0);
  overlay_.add_ray(apex, rim.face(0));
  overlay_.add_ray({rim[1].to, rim[1].uv}, rim.face(0));
  at_edge ? overlay_.add_vanishing_face(to, location.after) : overlay_.add_vanishing_fin(to);
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
    if (!move_sector(sector, location)) return false;
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

std::optional<CollapseMap::Move> CollapseMap::find_move(const Sector& sector,
                                                        const FanPoint& apex) const {
  return sector.is_closed ? find_closed_move(sector, apex) : find_open_move(sector, apex);
}

std::optional<CollapseMap::Move> CollapseMap::find_closed_move(const Sector& sector,
                                                               const FanPoint& apex) const {
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
  if (k == n || face == n) return {};
  return Move{k, face, point_on({}, at(k), at(k + 1), before),
              point_on(apex, at(face), at(face + 1), after)};
}

// The new apex goes to the nearer of the two old boundary edges, the old apex to the other's new
// one.
CollapseMap::Move CollapseMap::find_open_move(const Sector& sector, const FanPoint& apex) const {
  const std::size_t n = sector.rim.size();
  const auto along = [&](const CollapseStar::Rim& rim) {
    return closest_on_segment(apex.at, glm::dvec3(0), rim.to);
  };
  const auto inside = [](double t) { return std::clamp(t, kInside, 1 - kInside); };
  const double first = along(sector.rim[0]), last = along(sector.rim[n - 1]);
  const bool is_first = glm::distance(first * sector.rim[0].to, apex.at) <=
                        glm::distance(last * sector.rim[n - 1].to, apex.at);
  const CollapseStar::Rim &near = sector.rim[is_first ? 0 : n - 1],
                          &far = sector.rim[is_first ? n - 1 : 0];
  const double s = is_first ? first : last;
  const double t = closest_on_segment(glm::dvec3(0), apex.at, far.to);
  const FanPoint after{glm::mix(apex.at, far.to, t), glm::mix(apex.texture, far.uv, inside(t))};
  return {is_first ? 0 : n - 1,
          is_first ? n - 2 : 0,
          {s * near.to, inside(s) * near.uv},
          n == 2 ? apex : after};
}

bool CollapseMap::move_sector(const Sector& sector, const FanPoint& apex) {
  const std::optional<Move> move = find_move(sector, apex);
  if (!move) return false;
  sector.is_closed ? move_closed(sector, apex, *move) : move_open(sector, apex, *move);
  return true;
}

// The new apex lies in the old face of ray 0, the old apex in the new face of ray m.
void CollapseMap::move_closed(const Sector& sector, const FanPoint& apex, const Move& move) {
  const std::size_t n = sector.rim.size(), k = move.first;
  const auto at = [&](std::size_t i) -> const CollapseStar::Rim& { return sector.rim[i % n]; };
  overlay_.start(apex, sector.origin);
  for (std::size_t i = 0; i < n; ++i)
    overlay_.add_ray({at(k + i).to, at(k + i).uv}, at(k + i).face);
  overlay_.repeat_ray(0), overlay_.repeat_ray(1);
  const std::size_t m = (move.second + n - k) % n;
  overlay_.add_old_apex(m, move.after);
  overlay_.add_new_apex(0, move.before);
  overlay_.add_side(0, true, m, move.before, move.after);
  overlay_.add_side(n + 1, false, n - m, move.before, move.after);
}

void CollapseMap::move_open(const Sector& sector, const FanPoint& apex, const Move& move) {
  const std::size_t n = sector.rim.size();
  const Walk rim{sector.rim, move.first, move.first == 0 ? 1 : -1};
  overlay_.start(apex, sector.origin, move.first != 0);
  for (std::size_t i = 0; i < n; ++i)
    overlay_.add_ray({rim[i].to, rim[i].uv}, i + 1 < n ? rim.face(i) : 0);
  overlay_.add_old_apex(n - 2, move.after);
  if (n == 2) return;  // one face before and after
  overlay_.add_new_apex(0, move.before);
  overlay_.add_side(0, true, n - 2, move.before, move.after);
}

}  // namespace viewcell

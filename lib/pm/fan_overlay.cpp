#include "pm/fan_overlay.h"

#include <algorithm>
#include <cmath>
#include <glm/gtx/exterior_product.hpp>

#include "mesh/closest_on_segment.h"

namespace viewcell {
namespace {

// Boxes are rounded outwards by this share: a float's last digit and some for the sums before.
constexpr float kOutward = 1e-6f;

// The least distance of corners along an edge, and of its ends, as a share of it: cells keep some
// area, and no texel moves that need not.
constexpr double kGap = 1.0 / 16384;

// Moves parameters along an edge by the least sum of squares so that from 0 to 1 they rise by at
// least a gap each. Returns whether some had to move. [Barlow et al. 1972, pool adjacent violators]
bool space_out(std::vector<double>& along, std::vector<std::pair<double, double>>& pools) {
  const auto n = static_cast<double>(along.size());
  const double gap = std::min(kGap, 0.5 / (n + 1));
  bool changes = false;
  for (std::size_t i = 0; i < along.size(); ++i)
    changes = changes || along[i] - (i > 0 ? along[i - 1] : 0) < gap;
  if (!changes && (along.empty() || along.back() <= 1 - gap)) return false;
  pools.clear();
  for (std::size_t i = 0; i < along.size(); ++i) {
    pools.emplace_back(along[i] - double(i + 1) * gap, 1);
    while (pools.size() > 1 && pools[pools.size() - 2].first > pools.back().first) {
      const auto [mean, weight] = pools.back();
      pools.pop_back();
      auto& into = pools.back();
      into.first = (into.first * into.second + mean * weight) / (into.second + weight);
      into.second += weight;
    }
  }
  std::size_t i = 0;
  for (const auto& [mean, weight] : pools)
    for (double k = 0; k < weight; ++k, ++i)
      along[i] = std::clamp(mean, 0.0, 1 - (n + 1) * gap) + double(i + 1) * gap;
  return true;
}

}  // namespace

double FanOverlay::largest_shift() const {
  return std::sqrt(largest2_);
}

void FanOverlay::clear() {
  cells_.clear();
  moments_.clear();
  textures_.clear();
  points_.clear();
  n_moved_points_ = 0;
  largest2_ = 0;
}

void FanOverlay::start(const FanPoint& new_apex, const glm::dvec2& origin, bool is_backward) {
  apex_ = make_double4(new_apex.at);
  apex_texture_ = new_apex.texture;
  origin_ = origin;
  is_backward_ = is_mirrored_ = is_backward;
  old_apex_point_ = new_apex_point_ = kNone;
  rays_.clear();
}

void FanOverlay::add_ray(const FanPoint& corner, std::uint32_t face) {
  Ray& ray = rays_.emplace_back(corner, apex_, face);
  if (keep_.texture) ray.point = add_point(corner.texture, corner.texture);
  if (matching_ == Matching::nearest) ray.set_nearest(apex_);
}

std::uint32_t FanOverlay::add_point(const glm::dvec2& before, const glm::dvec2& after) {
  points_.push_back({origin_ + before, origin_ + after});
  return static_cast<std::uint32_t>(points_.size() - 1);
}

FanOverlay::Corner FanOverlay::old_apex(const FanPoint& after) {
  if (keep_.texture && old_apex_point_ == kNone) {
    old_apex_point_ = add_point(glm::dvec2(0), after.texture);
    points_.back().is_old_apex = true;
  }
  return {-make_double4(after.at), Double4{}, old_apex_point_};
}

FanOverlay::Corner FanOverlay::new_apex(const FanPoint& before) {
  if (keep_.texture && new_apex_point_ == kNone) {
    new_apex_point_ = add_point(before.texture, apex_texture_);
    points_.back().is_new_apex = true;
  }
  const Double4 on_old = make_double4(before.at);
  return {on_old - apex_, on_old, new_apex_point_};
}

FanOverlay::Corner FanOverlay::on_rim(const Ray& ray) const {
  return {Double4{}, ray.to, ray.point};
}

void FanOverlay::add_old_apex(std::size_t ray, const FanPoint& after) {
  add_apex(ray, rays_[ray].face, old_apex(after));
}

void FanOverlay::add_new_apex(std::size_t ray, const FanPoint& before) {
  add_apex(ray, rays_[ray].face, new_apex(before));
}

void FanOverlay::add_vanishing_face(std::uint32_t inheriting_face, const FanPoint& after) {
  add_apex(0, inheriting_face, old_apex(after));
  keep_face(inheriting_face);
}

void FanOverlay::add_vanishing_fin(std::uint32_t inheriting_face) {
  const Ray &at_apex = rays_[0], &far = rays_[1];
  const Corner apex = old_apex({glm::dvec3(apex_[0], apex_[1], apex_[2]), apex_texture_});
  Corner gone{far.to - apex_, far.to};
  if (keep_.texture) gone.point = add_point(far.texture, apex_texture_);
  for (const Corner& corner : {apex, gone})
    largest2_ = std::max(largest2_, dot(corner.shift, corner.shift));
  add_cell(at_apex.face, inheriting_face, {apex, on_rim(at_apex), gone, gone});
  keep_face(inheriting_face);
}

// Its own part, which does not change.
void FanOverlay::keep_face(std::uint32_t face) {
  cells_.push_back({face, face});
  if (keep_.moments) moments_.emplace_back();
  if (keep_.texture) textures_.emplace_back();
}

void FanOverlay::add_apex(std::size_t ray, std::uint32_t new_face, const Corner& apex) {
  const Corner left = on_rim(rays_[ray]), right = on_rim(rays_[ray + 1]);
  largest2_ = std::max(largest2_, dot(apex.shift, apex.shift));
  add_cell(rays_[ray].face, new_face, {apex, left, right, right});
}

// Where an old and a new edge cross.
FanOverlay::Corner FanOverlay::cross(const Ray& old_edge, const Ray& new_edge) {
  double s = 0, t = 0;
  if (matching_ == Matching::texture) {
    const glm::dvec2 a = old_edge.texture, b = new_edge.texture - apex_texture_;
    const double det = glm::cross(a, b);
    s = det != 0 ? std::clamp(glm::cross(apex_texture_, b) / det, 0.0, 1.0) : 0.5;
    t = det != 0 ? std::clamp(glm::cross(apex_texture_, a) / det, 0.0, 1.0) : 0.5;
  } else {
    closest_on_segments({.aa = old_edge.to2,
                         .bb = new_edge.from_apex2,
                         .ab = dot(old_edge.to, new_edge.from_apex),
                         .ar = -old_edge.to_a,
                         .br = -new_edge.from_apex_a},
                        s, t);
  }
  const Double4 before = s * old_edge.to, shift = before - apex_ - t * new_edge.from_apex;
  largest2_ = std::max(largest2_, dot(shift, shift));
  if (!keep_.texture) return {shift, before};
  crossings_.push_back({s, t});
  return {shift, before, add_point(glm::dvec2(0), glm::dvec2(0))};
}

// A crossing that is moved along its old edge goes to the nearest point of its new edge.
//
// Along old edge i the crossings with new edges i + 1 ... middle come ever nearer to the old apex;
// along new edge j those with old edges 1 ... j - 1 go ever farther from the new apex.
template <typename RayAt>
void FanOverlay::order_crossings(std::size_t middle, const RayAt& ray) {
  const auto at = [&](std::size_t i, std::size_t j) -> Crossing& {
    return crossings_[(i - 1) * middle - i * (i - 1) / 2 + (j - i - 1)];
  };
  for (std::size_t i = 1; i < middle; ++i) {
    along_.clear();
    for (std::size_t j = middle; j > i; --j) along_.push_back(at(i, j).s);
    if (!space_out(along_, pools_)) continue;
    ++n_moved_points_;
    for (std::size_t j = middle; j > i; --j) {
      Crossing& crossing = at(i, j);
      if (crossing.s == along_[middle - j]) continue;
      crossing.s = along_[middle - j];
      const Double4 before = crossing.s * ray(i).to - apex_;
      if (ray(j).from_apex2 > 0)
        crossing.t = std::clamp(dot(before, ray(j).from_apex) / ray(j).from_apex2, 0.0, 1.0);
    }
  }
  for (std::size_t j = 2; j <= middle; ++j) {
    along_.clear();
    for (std::size_t i = 1; i < j; ++i) along_.push_back(at(i, j).t);
    if (!space_out(along_, pools_)) continue;
    ++n_moved_points_;
    for (std::size_t i = 1; i < j; ++i) at(i, j).t = along_[i - 1];
  }
}

// The points of a side's crossings, which were added as the last ones, row by row.
template <typename RayAt>
void FanOverlay::set_crossing_points(std::size_t middle, const RayAt& ray) {
  order_crossings(middle, ray);
  std::size_t k = 0;
  for (std::size_t i = 1; i < middle; ++i)
    for (std::size_t j = i + 1; j <= middle; ++j, ++k) {
      TexturePoint& point = points_[points_.size() - crossings_.size() + k];
      point.before = origin_ + crossings_[k].s * ray(i).texture;
      point.after = origin_ + glm::mix(apex_texture_, ray(j).texture, crossings_[k].t);
    }
}

void FanOverlay::add_side(std::size_t first, bool is_forward, std::size_t middle,
                          const FanPoint& before, const FanPoint& after) {
  const auto ray = [&](std::size_t i) -> const Ray& {
    return rays_[is_forward ? first + i : first - i];
  };
  const auto face = [&](std::size_t i) {
    return rays_[is_forward ? first + i : first - i - 1].face;
  };
  const std::size_t beyond = middle + 1;
  is_mirrored_ = is_backward_ != is_forward;
  row_.assign(beyond + 1, new_apex(before));
  next_row_.resize(beyond + 1);
  const Corner apex = old_apex(after);
  crossings_.clear();
  for (std::size_t i = 0; i < middle; ++i) {
    next_row_[i + 1] = on_rim(ray(i + 1));
    for (std::size_t j = i + 2; j < beyond; ++j) next_row_[j] = cross(ray(i + 1), ray(j));
    next_row_[beyond] = apex;
    for (std::size_t j = std::max<std::size_t>(i, 1); j <= middle; ++j) {
      const Corner& last = j > i ? next_row_[j] : next_row_[j + 1];
      add_cell(face(i), face(j), {row_[j], row_[j + 1], next_row_[j + 1], last});
    }
    std::swap(row_, next_row_);
  }
  if (keep_.texture) set_crossing_points(middle, ray);
  is_mirrored_ = is_backward_;
}

void FanOverlay::add_cell(std::uint32_t old_face, std::uint32_t new_face, const Around& around) {
  const auto& [a, b, c, d] = around;
  Double4 lo = a.shift < b.shift ? a.shift : b.shift, hi = a.shift > b.shift ? a.shift : b.shift;
  for (const Corner* corner : {&c, &d}) {
    lo = lo < corner->shift ? lo : corner->shift;
    hi = hi > corner->shift ? hi : corner->shift;
  }
  const Float4 l = __builtin_convertvector(lo, Float4), h = __builtin_convertvector(hi, Float4);
  const Float4 far = h > -l ? h : -l;  // the larger absolute value
  cells_.push_back({old_face, new_face, {l - kOutward * far, h + kOutward * far}});
  if (keep_.moments) add_moments(around);
  if (!keep_.texture) return;
  CellCorners& corners = textures_.emplace_back(CellCorners{a.point, b.point, c.point, d.point});
  if (is_mirrored_) std::swap(corners[1], corners[3]);
}

void FanOverlay::add_moments(const Around& around) {
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

}  // namespace viewcell

#include "pm/fan_overlay.h"

#include <algorithm>
#include <cmath>

#include "pm/nearest.h"

namespace viewcell {
namespace {

// Boxes are rounded outwards by this share: a float's last digit and some for the sums before.
constexpr float kOutward = 1e-6f;

double cross2(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

double FanOverlay::largest_shift() const {
  return std::sqrt(largest2_);
}

void FanOverlay::clear() {
  cells_.clear();
  moments_.clear();
  textures_.clear();
  largest2_ = 0;
}

void FanOverlay::start(const FanPoint& new_apex, const glm::dvec2& origin, bool is_backward) {
  apex_ = make_double4(new_apex.at);
  apex_texture_ = new_apex.texture;
  origin_ = origin;
  is_backward_ = is_mirrored_ = is_backward;
  rays_.clear();
}

void FanOverlay::add_ray(const FanPoint& place, std::uint32_t face) {
  const Double4 to = make_double4(place.at), from_apex = to - apex_;
  rays_.push_back({to, from_apex, dot(to, to), dot(from_apex, from_apex), dot(to, apex_),
                   dot(from_apex, apex_), place.texture, face});
}

FanOverlay::Corner FanOverlay::old_apex(const FanPoint& after) const {
  return {-make_double4(after.at), Double4{}, glm::dvec2(0), after.texture};
}

FanOverlay::Corner FanOverlay::new_apex(const FanPoint& before) const {
  const Double4 place = make_double4(before.at);
  return {place - apex_, place, before.texture, apex_texture_};
}

FanOverlay::Corner FanOverlay::on_rim(const Ray& ray) const {
  return {Double4{}, ray.to, ray.texture, ray.texture};
}

void FanOverlay::add_old_apex(std::size_t ray, const FanPoint& after) {
  add_apex(ray, rays_[ray].face, old_apex(after));
}

void FanOverlay::add_new_apex(std::size_t ray, const FanPoint& before) {
  add_apex(ray, rays_[ray].face, new_apex(before));
}

void FanOverlay::add_lone(std::uint32_t heir, const FanPoint& after) {
  add_apex(0, heir, old_apex(after));
  cells_.push_back({heir, heir});
  if (keep_.moments) moments_.emplace_back();
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
    const double det = cross2(a, b);
    s = det != 0 ? std::clamp(cross2(apex_texture_, b) / det, 0.0, 1.0) : 0.5;
    t = det != 0 ? std::clamp(cross2(apex_texture_, a) / det, 0.0, 1.0) : 0.5;
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
  return {shift, before, s * old_edge.texture,
          apex_texture_ + t * (new_edge.texture - apex_texture_)};
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
  for (std::size_t i = 0; i < middle; ++i) {
    next_row_[i + 1] = on_rim(ray(i + 1));
    for (std::size_t j = i + 2; j < beyond; ++j) next_row_[j] = cross(ray(i + 1), ray(j));
    next_row_[beyond] = old_apex(after);
    for (std::size_t j = std::max<std::size_t>(i, 1); j <= middle; ++j) {
      const Corner& last = j > i ? next_row_[j] : next_row_[j + 1];
      add_cell(face(i), face(j), {row_[j], row_[j + 1], next_row_[j + 1], last});
    }
    std::swap(row_, next_row_);
  }
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
  CellTexture& texture = textures_.emplace_back();
  std::array<const Corner*, 4> corners{&a, &b, &c, &d};
  if (is_mirrored_) std::swap(corners[1], corners[3]);
  for (std::size_t i = 0; i < 4; ++i) {
    texture.before[i] = origin_ + corners[i]->old_texture;
    texture.after[i] = origin_ + corners[i]->new_texture;
  }
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

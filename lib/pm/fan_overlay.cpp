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
  largest2_ = 0;
}

void FanOverlay::start(const glm::dvec3& new_apex, const glm::dvec2& texture) {
  apex_ = make_double4(new_apex);
  apex_texture_ = texture;
  rays_.clear();
}

void FanOverlay::add_ray(const glm::dvec3& place, const glm::dvec2& texture, std::uint32_t face) {
  const Double4 to = make_double4(place), from_apex = to - apex_;
  rays_.push_back({to, from_apex, dot(to, to), dot(from_apex, from_apex), dot(to, apex_),
                   dot(from_apex, apex_), texture, face});
}

void FanOverlay::add_old_apex(std::size_t ray, const glm::dvec3& after) {
  add_apex(ray, rays_[ray].face, Corner{-make_double4(after), {}});
}

void FanOverlay::add_new_apex(std::size_t ray, const glm::dvec3& before) {
  const Double4 place = make_double4(before);
  add_apex(ray, rays_[ray].face, Corner{place - apex_, place});
}

void FanOverlay::add_lone(std::uint32_t heir, const glm::dvec3& after) {
  add_apex(0, heir, Corner{-make_double4(after), {}});
  cells_.push_back({heir, heir});
  if (with_moments_) moments_.emplace_back();
}

void FanOverlay::add_apex(std::size_t ray, std::uint32_t new_face, const Corner& apex) {
  const Corner left{{}, rays_[ray].to}, right{{}, rays_[ray + 1].to};
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
  return {shift, before};
}

void FanOverlay::add_side(std::size_t first, bool is_forward, std::size_t middle,
                          const glm::dvec3& before, const glm::dvec3& after) {
  const auto ray = [&](std::size_t i) -> const Ray& {
    return rays_[is_forward ? first + i : first - i];
  };
  const auto face = [&](std::size_t i) {
    return rays_[is_forward ? first + i : first - i - 1].face;
  };
  const Double4 place = make_double4(before);
  const std::size_t beyond = middle + 1;
  row_.assign(beyond + 1, Corner{place - apex_, place});
  next_row_.resize(beyond + 1);
  for (std::size_t i = 0; i < middle; ++i) {
    next_row_[i + 1] = Corner{{}, ray(i + 1).to};
    for (std::size_t j = i + 2; j < beyond; ++j) next_row_[j] = cross(ray(i + 1), ray(j));
    next_row_[beyond] = Corner{-make_double4(after), {}};
    for (std::size_t j = std::max<std::size_t>(i, 1); j <= middle; ++j) {
      const Corner& last = j > i ? next_row_[j] : next_row_[j + 1];
      add_cell(face(i), face(j), {row_[j], row_[j + 1], next_row_[j + 1], last});
    }
    std::swap(row_, next_row_);
  }
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
  if (with_moments_) add_moments(around);
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

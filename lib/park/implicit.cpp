// Follows: distance functions after I. Quilez's articles (round cone, ellipsoid, box), and the
// polynomial smooth minimum of the same source.
#include "park/implicit.h"

#include <algorithm>
#include <cmath>

namespace viewcell {
namespace {

constexpr float kFar = 1e9f;

float smooth_min(float a, float b, float width) {
  if (width <= 0) return std::min(a, b);
  const float h = std::max(width - std::abs(a - b), 0.0f) / width;
  return std::min(a, b) - 0.25f * h * h * width;
}

float smooth_max(float a, float b, float width) {
  return -smooth_min(-a, -b, width);
}

float distance_round_cone(const Solid& s, const glm::vec3& p) {
  const glm::vec3 axis = s.b - s.a, pa = p - s.a;
  const float l2 = glm::dot(axis, axis), dr = s.ra - s.rb, a2 = l2 - dr * dr;
  if (a2 <= 0)  // one ball holds the other
    return std::min(glm::length(pa) - s.ra, glm::length(p - s.b) - s.rb);
  const float il2 = 1 / l2, y = glm::dot(pa, axis), z = y - l2;
  const glm::vec3 across = pa * l2 - axis * y;
  const float x2 = glm::dot(across, across), y2 = y * y * l2, z2 = z * z * l2;
  const float k = (dr > 0 ? 1.0f : dr < 0 ? -1.0f : 0.0f) * dr * dr * x2;
  if ((z > 0 ? 1.0f : -1.0f) * a2 * z2 > k) return std::sqrt(x2 + z2) * il2 - s.rb;
  if ((y > 0 ? 1.0f : -1.0f) * a2 * y2 < k) return std::sqrt(x2 + y2) * il2 - s.ra;
  return (std::sqrt(x2 * a2 * il2) + y * dr) * il2 - s.ra;
}

float distance_ellipsoid(const Solid& s, const glm::vec3& p) {
  const glm::vec3 q = (p - s.a) * s.axes;  // the transpose times it: into the solid's axes
  const float k0 = glm::length(q / s.size), k1 = glm::length(q / (s.size * s.size));
  if (k1 < 1e-9f) return -std::min({s.size.x, s.size.y, s.size.z});
  return k0 * (k0 - 1) / k1;
}

float distance_box(const Solid& s, const glm::vec3& p) {
  const glm::vec3 d = glm::abs((p - s.a) * s.axes) - s.size + s.round;
  return glm::length(glm::max(d, 0.0f)) + std::min(std::max({d.x, d.y, d.z}), 0.0f) - s.round;
}

float distance_drum(const Solid& s, const glm::vec3& p) {
  const glm::vec3 q = (p - s.a) * s.axes;
  const float height = glm::length(s.b - s.a);
  const float t = std::clamp(q.z / height, 0.0f, 1.0f);
  const glm::vec2 section = glm::vec2(q.x / s.size.x, q.y / s.size.y);
  float radius = glm::mix(s.ra, s.rb, t);
  float steepness = (s.rb - s.ra) / height;
  if (s.n_flutes > 0) {
    steepness += 0.5f * static_cast<float>(s.n_flutes) * s.flute_depth / s.rb;
    const float angle = std::atan2(section.y, section.x) + t * s.twist_rad;
    radius -= s.flute_depth * t * (0.5f + 0.5f * std::cos(static_cast<float>(s.n_flutes) * angle));
  }
  const float across = (glm::length(section) - radius) * std::min(s.size.x, s.size.y) /
                       std::sqrt(1 + steepness * steepness);
  const glm::vec2 d(across + s.round, std::abs(q.z - 0.5f * height) - 0.5f * height + s.round);
  return glm::length(glm::max(d, 0.0f)) + std::min(std::max(d.x, d.y), 0.0f) - s.round;
}

float distance_to(const Solid& s, const glm::vec3& p) {
  switch (s.shape) {
    case Solid::Shape::kRoundCone:
      return distance_round_cone(s, p);
    case Solid::Shape::kEllipsoid:
      return distance_ellipsoid(s, p);
    case Solid::Shape::kBox:
      return distance_box(s, p);
    case Solid::Shape::kDrum:
      return distance_drum(s, p);
  }
  return kFar;
}

float join(const Limb& limb, float before, float own) {
  switch (limb.op) {
    case Limb::Op::kUnite:
      return smooth_min(before, own, limb.blend);
    case Limb::Op::kCut:
      return smooth_max(before, -own, limb.blend);
  }
  return before;
}

// The radius of a ball about s.a, or about the middle of its axis, that holds the solid.
std::pair<glm::vec3, float> ball_around(const Solid& s) {
  switch (s.shape) {
    case Solid::Shape::kEllipsoid:
      return {s.a, std::max({s.size.x, s.size.y, s.size.z})};
    case Solid::Shape::kBox:
      return {s.a, glm::length(s.size)};
    case Solid::Shape::kDrum:
      return {0.5f * (s.a + s.b),
              0.5f * glm::length(s.b - s.a) + std::max(s.ra, s.rb) * std::max(s.size.x, s.size.y)};
    default:
      return {0.5f * (s.a + s.b), 0.5f * glm::length(s.b - s.a) + std::max(s.ra, s.rb)};
  }
}

std::vector<Solid> mirrored(const std::vector<Solid>& solids, int axis) {
  std::vector<Solid> out;
  for (const Solid& s : solids) out.push_back(mirror(s, axis));
  return out;
}

}  // namespace

Solid make_round_cone(const glm::vec3& a, float ra, const glm::vec3& b, float rb) {
  Solid s;
  s.a = a, s.b = b, s.ra = ra, s.rb = rb;
  return s;
}

Solid make_ball(const glm::vec3& centre, float radius) {
  return make_ellipsoid(centre, glm::vec3(radius));
}

Solid make_ellipsoid(const glm::vec3& centre, const glm::vec3& radii, const glm::mat3& axes) {
  Solid s;
  s.shape = Solid::Shape::kEllipsoid;
  s.a = s.b = centre;
  s.size = radii, s.axes = axes;
  return s;
}

Solid make_box(const glm::vec3& centre, const glm::vec3& half, float round, const glm::mat3& axes) {
  Solid s = make_ellipsoid(centre, half, axes);
  s.shape = Solid::Shape::kBox;
  s.round = round;
  return s;
}

Solid make_drum(const glm::vec3& a, float ra, const glm::vec3& b, float rb, float round,
                const glm::vec2& stretch) {
  Solid s = make_round_cone(a, ra, b, rb);
  s.shape = Solid::Shape::kDrum;
  s.round = round;
  s.size = glm::vec3(stretch, 1);
  if (a.x != b.x || a.y != b.y)
    s.axes = axes_along(b - a);
  else if (b.z < a.z)
    s.axes = turn_x(180);
  return s;
}

Solid mirror(const Solid& solid, int axis) {
  Solid s = solid;
  s.a[axis] = -s.a[axis];
  s.b[axis] = -s.b[axis];
  // M R M, with M the mirror: still a rotation, and every solid is symmetric in its own axes.
  for (int column = 0; column < 3; ++column) {
    s.axes[column][axis] = -s.axes[column][axis];
    if (column == axis) s.axes[column] = -s.axes[column];
  }
  s.twist_rad = -s.twist_rad;
  return s;
}

glm::mat3 turn_x(float deg) {
  const float c = std::cos(glm::radians(deg)), s = std::sin(glm::radians(deg));
  return {{1, 0, 0}, {0, c, s}, {0, -s, c}};
}

glm::mat3 turn_y(float deg) {
  const float c = std::cos(glm::radians(deg)), s = std::sin(glm::radians(deg));
  return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
}

glm::mat3 turn_z(float deg) {
  const float c = std::cos(glm::radians(deg)), s = std::sin(glm::radians(deg));
  return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
}

glm::mat3 axes_along(const glm::vec3& z) {
  const glm::vec3 w = glm::normalize(z);
  const glm::vec3 helper = std::abs(w.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
  const glm::vec3 u = glm::normalize(glm::cross(helper, w));
  return {u, glm::cross(w, u), w};
}

void Figure::unite(float blend, std::vector<Solid> solids, float inner_blend) {
  limbs.push_back({Limb::Op::kUnite, blend, inner_blend, std::move(solids)});
}

void Figure::cut(float blend, std::vector<Solid> solids, float inner_blend) {
  limbs.push_back({Limb::Op::kCut, blend, inner_blend, std::move(solids)});
}

void Figure::unite_pair(int axis, float blend, const std::vector<Solid>& solids, float inner) {
  unite(blend, solids, inner);
  unite(blend, mirrored(solids, axis), inner);
}

void Figure::cut_pair(int axis, float blend, const std::vector<Solid>& solids, float inner) {
  cut(blend, solids, inner);
  cut(blend, mirrored(solids, axis), inner);
}

void Figure::add(const Figure& other, float scale, const glm::mat3& turn, const glm::vec3& move) {
  for (Limb limb : other.limbs) {
    limb.blend *= scale, limb.inner_blend *= scale;
    for (Solid& s : limb.solids) {
      s.a = move + turn * (scale * s.a), s.b = move + turn * (scale * s.b);
      s.axes = turn * s.axes;
      s.ra *= scale, s.rb *= scale, s.round *= scale, s.flute_depth *= scale;
      if (s.shape != Solid::Shape::kDrum) s.size *= scale;  // a drum's are ratios
    }
    limbs.push_back(std::move(limb));
  }
}

Knot point_on_chain(std::span<const Knot> knots, float t) {
  const int n = static_cast<int>(knots.size());
  const int i = std::clamp(static_cast<int>(t), 0, std::max(n - 2, 0));
  const float u = t - static_cast<float>(i);
  const auto at = [&](int k) {
    const Knot& knot = knots[static_cast<std::size_t>(std::clamp(k, 0, n - 1))];
    return glm::vec4(knot.point, knot.radius);
  };
  const glm::vec4 a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
  const glm::vec4 p =
      0.5f * (2.0f * b + (c - a) * u + (2.0f * a - 5.0f * b + 4.0f * c - d) * u * u +
              (3.0f * b - a - 3.0f * c + d) * u * u * u);
  return {glm::vec3(p), std::max(p.w, 0.01f)};
}

std::vector<Solid> make_chain(std::span<const Knot> knots, int steps) {
  std::vector<Solid> solids;
  const int n = (static_cast<int>(knots.size()) - 1) * steps;
  for (int i = 0; i < n; ++i) {
    const Knot from = point_on_chain(knots, static_cast<float>(i) / static_cast<float>(steps));
    const Knot to = point_on_chain(knots, static_cast<float>(i + 1) / static_cast<float>(steps));
    solids.push_back(make_round_cone(from.point, from.radius, to.point, to.radius));
  }
  return solids;
}

FigureView::FigureView(const Figure& figure) {
  for (const Limb& limb : figure.limbs) {
    const auto first = static_cast<std::uint32_t>(solids_.size());
    for (const Solid& s : limb.solids) solids_.push_back(&s);
    parts_.push_back({&limb, first, static_cast<std::uint32_t>(solids_.size())});
  }
}

float FigureView::value(const glm::vec3& p) const {
  float all = kFar;
  for (const Part& part : parts_) {
    float own = kFar;
    for (std::uint32_t i = part.first; i < part.last; ++i)
      own = smooth_min(own, distance_to(*solids_[i], p), part.limb->inner_blend);
    all = join(*part.limb, all, own);
  }
  return all;
}

FigureView FigureView::near(const glm::vec3& centre, float radius) const {
  // By how much a value may differ from the centre's within the radius. 1.3: an ellipsoid's value
  // is not quite a distance.
  const float reach = 1.3f * radius;
  FigureView out;
  float all = kFar;  // the value at the centre so far
  for (const Part& part : parts_) {
    const Limb& limb = *part.limb;
    const auto first = static_cast<std::uint32_t>(out.solids_.size());
    float own = kFar;
    for (std::uint32_t i = part.first; i < part.last; ++i) {
      const float distance = distance_to(*solids_[i], centre);
      own = smooth_min(own, distance, limb.inner_blend);
      // A solid that is farther than this everywhere near moves no zero.
      if (distance <= reach + limb.blend + limb.inner_blend) out.solids_.push_back(solids_[i]);
    }
    const auto last = static_cast<std::uint32_t>(out.solids_.size());
    const bool cuts = limb.op == Limb::Op::kCut;
    const bool wins = own < -(reach + limb.blend) || (!cuts && all - own > 2 * reach + limb.blend);
    const bool loses =
        cuts ? all + own > 2 * reach + limb.blend : own - all > 2 * reach + limb.blend;
    all = join(limb, all, own);
    if (last == first || loses) {
      out.solids_.resize(first);
    } else if (wins) {  // what stood before is all covered, or all cut away
      out.solids_.erase(out.solids_.begin(), out.solids_.begin() + first);
      out.parts_.clear();
      if (!cuts) out.parts_.push_back({&limb, 0, last - first});
      if (cuts) out.solids_.clear();
    } else {
      out.parts_.push_back({&limb, first, last});
    }
  }
  return out;
}

Box figure_box(const Figure& figure) {
  Box box;
  for (const Limb& limb : figure.limbs) {
    if (limb.op != Limb::Op::kUnite) continue;
    for (const Solid& s : limb.solids) {
      const auto [centre, radius] = ball_around(s);
      const float margin = radius + 0.25f * (limb.blend + limb.inner_blend);
      box.add(glm::dvec3(centre - margin));
      box.add(glm::dvec3(centre + margin));
    }
  }
  return box;
}

}  // namespace viewcell

#include "uv/distort.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "uv/parameterize.h"
#include "uv/uv_stretch.h"

namespace viewcell {
namespace {

constexpr double kLeastAreaShare = 0.01;  // of a triangle's area that must remain
constexpr int kBisections = 20;

// The functions below are of points in [-1, 1]^2.

// (1 - r)^2 turns of the strength: flat at the rim, so the swirl has no crease there.
glm::dvec2 swirl(const glm::dvec2& p, double strength) {
  const double inward = std::max(0.0, 1 - glm::length(p));
  const double angle = 2 * std::numbers::pi * strength * inward * inward;
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}

glm::dvec2 stretch(const glm::dvec2& p, double strength) {
  const double u = (p.x + 1) / 2;
  return {2 * std::expm1(strength * u) / std::expm1(strength) - 1, p.y};
}

glm::dvec2 to_unit(const glm::dvec2& uv) {
  return (uv - 0.5) / (0.5 - kUvMargin);
}

// By how much areas grow around the point of texture space.
double area_scale(const glm::dvec2& uv, UvDistortion distortion, double strength) {
  if (distortion == UvDistortion::swirl || strength == 0) return 1;
  return strength * std::exp(strength * (to_unit(uv).x + 1) / 2) / std::expm1(strength);
}

double float_area(const std::vector<glm::dvec2>& uv, const Triangle& t) {
  const auto rounded = [&](std::size_t k) { return glm::dvec2(glm::vec2(uv[t[k]])); };
  return twice_area(rounded(0), rounded(1), rounded(2));
}

bool is_one_to_one(const TriMesh& mesh, const std::vector<glm::dvec2>& before,
                   const std::vector<glm::dvec2>& after, UvDistortion distortion, double strength) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    const glm::dvec2 centre = (before[t[0]] + before[t[1]] + before[t[2]]) / 3.0;
    const double expected = float_area(before, t) * area_scale(centre, distortion, strength);
    const double area = float_area(after, t);
    return area > 0 && area >= kLeastAreaShare * expected;
  });
}

}  // namespace

glm::dvec2 distort_point(const glm::dvec2& p, UvDistortion distortion, double strength) {
  if (strength == 0) return p;
  const glm::dvec2 unit = to_unit(p);
  const glm::dvec2 moved =
      distortion == UvDistortion::swirl ? swirl(unit, strength) : stretch(unit, strength);
  return 0.5 + (0.5 - kUvMargin) * moved;
}

DistortedUv distort_uv(const TriMesh& mesh, const std::vector<glm::dvec2>& uv,
                       UvDistortion distortion, double strength) {
  VIEWCELL_CHECK(is_one_to_one(mesh, uv, uv, distortion, 0), "flipped before it is distorted");
  DistortedUv out{uv, 0};
  double low = 0, high = 1;  // share of the strength: low is one to one
  for (int i = 0; i <= kBisections; ++i) {
    const double share = i == 0 ? 1 : (low + high) / 2;
    std::vector<glm::dvec2> moved;
    for (const glm::dvec2& p : uv) moved.push_back(distort_point(p, distortion, share * strength));
    if (is_one_to_one(mesh, uv, moved, distortion, share * strength)) {
      low = share;
      out = {std::move(moved), share * strength};
      if (i == 0) break;
    } else {
      high = share;
    }
  }
  return out;
}

}  // namespace viewcell

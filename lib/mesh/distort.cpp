#include "mesh/distort.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "mesh/uv_stretch.h"

namespace viewcell {
namespace {

constexpr double kTurn = 6.283185307179586;
constexpr double kLeastShare = 0.01;  // of a triangle's area that must remain
constexpr int kBisections = 20;

// (1 - r / 0.5)^2 turns of the strength: flat at the rim, so the swirl has no crease there.
glm::dvec2 swirl(const glm::dvec2& p, double strength) {
  const glm::dvec2 d = p - 0.5;
  const double inward = std::max(0.0, 1 - 2 * glm::length(d));
  const double angle = kTurn * strength * inward * inward;
  const double c = std::cos(angle), s = std::sin(angle);
  return glm::dvec2(c * d.x - s * d.y, s * d.x + c * d.y) + 0.5;
}

glm::dvec2 stretch(const glm::dvec2& p, double strength) {
  return strength == 0 ? p : glm::dvec2(std::expm1(strength * p.x) / std::expm1(strength), p.y);
}

// By how much areas grow around the point.
double area_scale(const glm::dvec2& p, UvDistortion distortion, double strength) {
  if (distortion == UvDistortion::swirl || strength == 0) return 1;
  return strength * std::exp(strength * p.x) / std::expm1(strength);
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
    return area > 0 && area >= kLeastShare * expected;
  });
}

}  // namespace

glm::dvec2 distort_point(const glm::dvec2& p, UvDistortion distortion, double strength) {
  return distortion == UvDistortion::swirl ? swirl(p, strength) : stretch(p, strength);
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

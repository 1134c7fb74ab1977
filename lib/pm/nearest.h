// Nearest points of segments, for inner loops. For triangles see mesh/closest_point.h.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

namespace viewcell {

/// t in [0, 1] of the point of segment a b nearest to p.
inline double closest_on_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 edge = b - a;
  const double length2 = glm::dot(edge, edge);
  return length2 > 0 ? std::clamp(glm::dot(p - a, edge) / length2, 0.0, 1.0) : 0.0;
}

/// s and t in [0, 1] of the points of segments a b and c d that are nearest to each other; where
/// the segments are parallel, of one such pair. [Ericson 2005, 5.1.9]
inline void closest_on_segments(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                                const glm::dvec3& d, double& s, double& t) {
  const glm::dvec3 u = b - a, v = d - c, r = a - c;
  const double uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v);
  const double ur = glm::dot(u, r), vr = glm::dot(v, r);
  s = t = 0;
  if (!(uu > 0) || !(vv > 0)) {
    if (uu > 0) s = std::clamp(-ur / uu, 0.0, 1.0);
    if (vv > 0) t = std::clamp(vr / vv, 0.0, 1.0);
    return;
  }
  const double det = uu * vv - uv * uv;
  if (det > 1e-14 * uu * vv) s = std::clamp((uv * vr - ur * vv) / det, 0.0, 1.0);
  t = (uv * s + vr) / vv;
  if (t < 0) {
    t = 0;
    s = std::clamp(-ur / uu, 0.0, 1.0);
  } else if (t > 1) {
    t = 1;
    s = std::clamp((uv - ur) / uu, 0.0, 1.0);
  }
}

}  // namespace viewcell

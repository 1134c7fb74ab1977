// Nearest points of segments and triangles, for inner loops.
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

/// The point of triangle a b c nearest to p; of a degenerate one, of some edge of it.
/// [Ericson 2005, 5.1.5]
inline glm::dvec3 closest_on_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                                      const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const glm::dvec3 bp = p - b;
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const glm::dvec3 cp = p - c;
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

}  // namespace viewcell

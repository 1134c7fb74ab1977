// Nearest points of segments. For triangles see mesh/closest_point.h.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>

namespace viewcell {

/// t in [0, 1] of the point of segment a b nearest to p, in the plane or in space; 0 where the
/// segment is a point.
template <int N>
double closest_on_segment(const glm::vec<N, double>& p, const glm::vec<N, double>& a,
                          const glm::vec<N, double>& b) {
  const glm::vec<N, double> edge = b - a;
  const double length2 = glm::dot(edge, edge);
  return length2 > 0 ? std::clamp(glm::dot(p - a, edge) / length2, 0.0, 1.0) : 0.0;
}

/// Dot products of two segments' directions a and b and of r, from the second's start to the
/// first's.
struct SegmentDots {
  double aa, bb, ab, ar, br;
};

/// s and t in [0, 1] of the points of the segments that are nearest to each other; where the
/// segments are parallel, of one such pair. [Ericson 2005, 5.1.9]
inline void closest_on_segments(const SegmentDots& d, double& s, double& t) {
  s = t = 0;
  if (!(d.aa > 0) || !(d.bb > 0)) {
    if (d.aa > 0) s = std::clamp(-d.ar / d.aa, 0.0, 1.0);
    if (d.bb > 0) t = std::clamp(d.br / d.bb, 0.0, 1.0);
    return;
  }
  const double det = d.aa * d.bb - d.ab * d.ab;
  if (det > 1e-14 * d.aa * d.bb) s = std::clamp((d.ab * d.br - d.ar * d.bb) / det, 0.0, 1.0);
  t = (d.ab * s + d.br) / d.bb;
  if (t < 0) {
    t = 0;
    s = std::clamp(-d.ar / d.aa, 0.0, 1.0);
  } else if (t > 1) {
    t = 1;
    s = std::clamp((d.ab - d.ar) / d.aa, 0.0, 1.0);
  }
}

}  // namespace viewcell

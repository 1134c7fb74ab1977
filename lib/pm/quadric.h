// Quadrics: sums of squared distances to planes [Garland, Heckbert 1997].
#pragma once

#include <glm/glm.hpp>

namespace viewcell {

/// value(p) = sum over planes of weight * (distance of p to the plane)^2.
struct Quadric {
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;  ///< the symmetric matrix
  double x = 0, y = 0, z = 0;                             ///< the linear part
  double c = 0;
  double weight = 0;

  /// The plane through `point` with the unit normal.
  void add_plane(const glm::dvec3& normal, const glm::dvec3& point, double w) {
    const double d = -glm::dot(normal, point);
    xx += w * normal.x * normal.x, yy += w * normal.y * normal.y, zz += w * normal.z * normal.z;
    xy += w * normal.x * normal.y, xz += w * normal.x * normal.z, yz += w * normal.y * normal.z;
    x += w * normal.x * d, y += w * normal.y * d, z += w * normal.z * d;
    c += w * d * d;
    weight += w;
  }
  void add(const Quadric& q) {
    xx += q.xx, yy += q.yy, zz += q.zz, xy += q.xy, xz += q.xz, yz += q.yz;
    x += q.x, y += q.y, z += q.z, c += q.c, weight += q.weight;
  }
  double value(const glm::dvec3& p) const {
    const double a = xx * p.x + 2 * (xy * p.y + xz * p.z + x);
    const double b = yy * p.y + 2 * (yz * p.z + y);
    return p.x * a + p.y * b + p.z * (zz * p.z + 2 * z) + c;
  }
};

}  // namespace viewcell

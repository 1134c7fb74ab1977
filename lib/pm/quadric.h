// Quadrics: sums of squared distances to planes [Garland, Heckbert 1997].
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace viewcell {

/// xx, yy, zz, xy, xz, yz.
using Symmetric3 = std::array<double, 6>;

inline glm::dvec3 times(const Symmetric3& a, const glm::dvec3& x) {
  return {a[0] * x.x + a[3] * x.y + a[4] * x.z, a[3] * x.x + a[1] * x.y + a[5] * x.z,
          a[4] * x.x + a[5] * x.y + a[2] * x.z};
}

/// x with A x = b; A regular.
inline glm::dvec3 solve_symmetric(const Symmetric3& a, const glm::dvec3& b) {
  const auto [xx, yy, zz, xy, xz, yz] = a;
  const double c00 = yy * zz - yz * yz, c01 = xz * yz - xy * zz, c02 = xy * yz - xz * yy;
  const double c11 = xx * zz - xz * xz, c12 = xy * xz - xx * yz, c22 = xx * yy - xy * xy;
  const double det = xx * c00 + xy * c01 + xz * c02;
  return glm::dvec3(c00 * b.x + c01 * b.y + c02 * b.z, c01 * b.x + c11 * b.y + c12 * b.z,
                    c02 * b.x + c12 * b.y + c22 * b.z) /
         det;
}

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
  /// Where value() is least. Where the planes leave a direction all but free (below 1e-6 of the
  /// stiffest) the point stays beside `anchor` in it.
  glm::dvec3 minimiser(const glm::dvec3& anchor) const {
    const double e = kSlack * (xx + yy + zz);
    if (!(e > 0)) return anchor;
    return solve_symmetric({xx + e, yy + e, zz + e, xy, xz, yz}, e * anchor - glm::dvec3(x, y, z));
  }

  static constexpr double kSlack = 1e-6;
};

}  // namespace viewcell

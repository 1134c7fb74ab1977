// Boxes of vectors, four numbers at a time.
#pragma once

#include <glm/glm.hpp>

namespace viewcell {

/// Vectors of the compiler's (GCC, Clang) that become one register each; the fourth number is 0.
using Float4 = float __attribute__((vector_size(16)));
using Double4 = double __attribute__((vector_size(32)));

inline Double4 make_double4(const glm::dvec3& v) {
  return Double4{v.x, v.y, v.z, 0};
}
inline double dot(const Double4& a, const Double4& b) {
  const Double4 p = a * b;
  return p[0] + p[1] + p[2];
}

/// A box of vectors, in float, rounded outwards by whoever makes it.
struct VectorBox {
  Float4 lo{}, hi{};  ///< the zero vector alone

  void add(const VectorBox& b) {
    lo = lo < b.lo ? lo : b.lo;
    hi = hi > b.hi ? hi : b.hi;
  }
  /// Of sums of one vector from each.
  VectorBox plus(const VectorBox& b) const { return {lo + b.lo, hi + b.hi}; }
  /// Squared length of the longest vector.
  float reach2() const {
    const Float4 far = hi > -lo ? hi : -lo;  // lo <= hi, so that is the larger absolute value
    const Float4 p = far * far;
    return p[0] + p[1] + p[2];
  }
};

}  // namespace viewcell

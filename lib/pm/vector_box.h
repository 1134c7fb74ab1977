// Boxes of vectors.
#pragma once

#include <glm/glm.hpp>

namespace viewcell {

/// A box of vectors, in float, rounded outwards by whoever makes it.
struct VectorBox {
  glm::vec3 lo{0}, hi{0};  ///< the zero vector alone
  void add(const VectorBox& b) { lo = glm::min(lo, b.lo), hi = glm::max(hi, b.hi); }
  /// Of sums of one vector from each.
  VectorBox plus(const VectorBox& b) const { return {lo + b.lo, hi + b.hi}; }
  /// Squared length of the longest vector.
  float reach2() const {
    const glm::vec3 far = glm::max(glm::abs(lo), glm::abs(hi));
    return glm::dot(far, far);
  }
};

}  // namespace viewcell

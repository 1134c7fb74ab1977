// Quadrics over position and texture [Garland, Heckbert 1998].
#pragma once

#include <array>

#include "pm/quadric.h"

namespace viewcell {

using Vec5 = std::array<double, 5>;

/// value(x) = sum over planes in R^5 of weight * (distance of x to the plane)^2. A plane is spanned
/// by a triangle's corners (position, scaled texture coordinates) [Garland, Heckbert 1998].
struct Quadric5 {
  std::array<double, 15> a{};  ///< upper triangle of the matrix, row by row
  Vec5 b{};
  double c = 0, weight = 0;

  void add_triangle(const Vec5& p, const Vec5& q, const Vec5& r, double w);
  void add(const Quadric5& q);
  /// A quadric of positions only.
  void add(const Quadric& q);
  double value(const Vec5& x) const;
  /// Where value() is least. Where the planes leave a direction all but free (below 1e-6 of the
  /// stiffest) the point stays beside `anchor` in it.
  Vec5 minimiser(const Vec5& anchor) const;
};

}  // namespace viewcell

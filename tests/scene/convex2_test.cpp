#include "scene/convex2.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace viewcell {
namespace {

ConvexPolygon random_polygon(Random& random, double spread) {
  const glm::dvec2 centre(random.uniform(-spread, spread), random.uniform(-spread, spread));
  std::vector<glm::dvec2> points;
  for (std::uint32_t n = 3 + random.below(8); n > 0; --n)
    points.push_back(centre + glm::dvec2(random.uniform(-1, 1), random.uniform(-1, 1)));
  return convex_hull(points);
}

TEST(ConvexDistance, OfSquaresByHand) {
  const ConvexPolygon a{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto moved = [&](double x, double y) {
    ConvexPolygon b = a;
    for (glm::dvec2& p : b) p += glm::dvec2(x, y);
    return b;
  };
  EXPECT_EQ(distance(a, moved(3, 0)), 2);
  EXPECT_EQ(distance(a, moved(4, 5)), 5);  // corner to corner: 3, 4, 5
  EXPECT_EQ(distance(a, moved(0.5, 0.5)), 0);
  EXPECT_EQ(distance(a, moved(1, 0)), 0);  // they share a side
  EXPECT_EQ(distance(a, ConvexPolygon{{0.5, 0.5}}), 0);
  EXPECT_EQ(distance(ConvexPolygon{{0.5, 3}}, a), 2);
}

// The distance is 0 when a point of one is in the other; otherwise no pair of points is nearer.
TEST(ConvexDistance, AgreesWithRandomPointsOfThePolygons) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const ConvexPolygon a = random_polygon(random, 1.5), b = random_polygon(random, 1.5);
    const double d = distance(a, b);
    EXPECT_EQ(d, distance(b, a));
    const auto point_of = [&](const ConvexPolygon& polygon) {
      glm::dvec2 sum(0);
      double whole = 0;
      for (const glm::dvec2& p : polygon) {
        const double w = std::pow(random.uniform(), 4);
        sum += w * p, whole += w;
      }
      return sum / whole;
    };
    double least = 1e300;
    for (int i = 0; i < 400; ++i) {
      const glm::dvec2 p = point_of(a), q = point_of(b);
      least = std::min(least, glm::length(p - q));
      EXPECT_LT(distance({p}, a), 1e-12);
      EXPECT_TRUE(d == 0 || !contains(b, p));
    }
    EXPECT_LE(d, least + 1e-12);
  }
}

}  // namespace
}  // namespace viewcell

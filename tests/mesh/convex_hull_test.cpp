#include "mesh/convex_hull.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace viewcell {
namespace {

template <typename Real>
class ConvexHull : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(ConvexHull, Reals);

TYPED_TEST(ConvexHull, OfASquareWithPointsInsideAndOnItsEdges) {
  using Points = std::vector<glm::vec<2, TypeParam>>;
  const Points points{{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}, {1, 0}, {0, 0}};
  EXPECT_EQ(convex_hull(points), (Points{{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
  EXPECT_EQ(convex_hull(Points{{2, 2}, {0, 0}, {1, 1}}), (Points{{0, 0}, {2, 2}}));
  EXPECT_EQ(convex_hull(Points{{3, 3}, {3, 3}}), (Points{{3, 3}}));
  EXPECT_TRUE(convex_hull(Points{}).empty());
}

TYPED_TEST(ConvexHull, HoldsItsPointsAndIsConvex) {
  using Vec2 = glm::vec<2, TypeParam>;
  const double rounding = std::is_same_v<TypeParam, float> ? 1e-6 : 1e-15;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<Vec2> points;
    for (std::uint32_t n = 3 + random.below(40); n > 0; --n)
      points.emplace_back(random.uniform(), random.uniform());
    const std::vector<Vec2> hull = convex_hull(points);
    ASSERT_GE(hull.size(), 3u);
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const glm::dvec2 a = hull[i], b = hull[(i + 1) % hull.size()];
      for (const glm::dvec2 p : points)
        EXPECT_GE((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x), -rounding);
    }
  }
}

}  // namespace
}  // namespace viewcell

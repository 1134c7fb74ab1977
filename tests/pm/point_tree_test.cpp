#include "pm/point_tree.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace viewcell {
namespace {

// Points on a coarse grid, so that many are equally far and some at one place.
TEST(PointTree, FindsTheNearestOfThoseThatAreThere) {
  for (const std::uint32_t n : {1u, 2u, 7u, 300u}) {
    Random random(n);
    const auto place = [&] { return static_cast<float>(random.below(6)); };
    std::vector<glm::vec3> points;
    for (std::uint32_t i = 0; i < n; ++i) points.emplace_back(place(), place(), place());
    PointTree tree(points);
    std::vector<bool> is_there(n, true);
    for (int i = 0; i < 500; ++i) {
      const std::uint32_t changed = random.below(n);
      is_there[changed] = random.below(3) == 0;
      tree.set_present(changed, is_there[changed]);
      const glm::dvec3 to(place() / 2, place(), place());
      std::uint32_t nearest = PointTree::kNone;
      double best = 1e300;
      for (std::uint32_t p = 0; p < n; ++p) {
        const glm::dvec3 off = to - glm::dvec3(points[p]);
        if (is_there[p] && glm::dot(off, off) < best) best = glm::dot(off, off), nearest = p;
      }
      ASSERT_EQ(tree.nearest(to), nearest) << "of " << n << ", step " << i;
    }
  }
}

TEST(PointTree, OfNoPointsThereIsNone) {
  EXPECT_EQ(PointTree({}).nearest(glm::dvec3(0)), PointTree::kNone);
}

}  // namespace
}  // namespace viewcell

#include "cells/self_occluding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "cells/small_scene.h"

namespace viewcell {
namespace {

TEST(SelfOccludingError, IsThePapersFormula) {
  EXPECT_DOUBLE_EQ(self_occluding_error_px(50, 100, 25, 1024),
                   std::sqrt(3.0) * 50 * 25 / (2 * 100 * 125) * 1024);
  EXPECT_EQ(self_occluding_error_px(50, 100, 0, 1024), 0);  // no depth, nothing hidden
  // an endless object: half the cell's width over its distance
  EXPECT_NEAR(self_occluding_error_px(50, 100, 1e12, 1024), std::sqrt(3.0) * 50 / 200 * 1024, 1e-6);
}

TEST(SelfOccludingError, IsInfiniteAtNoDistance) {
  EXPECT_EQ(self_occluding_error_px(50, 0, 10, 1024), std::numeric_limits<double>::infinity());
  EXPECT_EQ(self_occluding_error_px(50, -1, 10, 1024), std::numeric_limits<double>::infinity());
  EXPECT_EQ(self_occluding_error_px(50, std::nan(""), 10, 1024),
            std::numeric_limits<double>::infinity());
}

TEST(SelfOccludingError, GrowsWithCellAndDepthFallsWithDistance) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double c = random.uniform(1, 200), d = random.uniform(1, 900), l = random.uniform(1, 99);
    const double s = self_occluding_error_px(c, d, l, 1024);
    EXPECT_GT(self_occluding_error_px(c * 1.01, d, l, 1024), s);
    EXPECT_LT(self_occluding_error_px(c, d * 1.01, l, 1024), s);
    EXPECT_GT(self_occluding_error_px(c, d, l * 1.01, 1024), s);
    EXPECT_NEAR(self_occluding_error_px(c, d, l, 2048), 2 * s, 1e-9 * s);
  }
}

struct Placed {
  std::vector<glm::vec3> positions;
  std::vector<Triangle> triangles;
};

// The box [10, 12] x [-1, 1] x [-1, 1], seen from the origin.
Placed make_placed_box() {
  const TriMesh box = make_unit_box();
  Placed placed{box.positions, box.triangles};
  for (glm::vec3& p : placed.positions) p.x += 11;
  return placed;
}

TEST(MeasureDepth, OfABox) {
  const Placed box = make_placed_box();
  const ObjectDepth depth =
      measure_depth({0, 0, 0}, box.positions, box.triangles, std::vector<bool>(12, false));
  EXPECT_DOUBLE_EQ(depth.nearest, 10);  // the near face's middle, not its corner at sqrt 102
  EXPECT_DOUBLE_EQ(depth.depth, 2);
}

TEST(MeasureDepth, BackFacingTrianglesDoNotCount) {
  const Placed box = make_placed_box();
  std::vector<bool> back(12, true);
  for (std::size_t t = 0; t < 12; ++t) {  // the near face alone
    const Triangle& f = box.triangles[t];
    back[t] = !(box.positions[f[0]].x == 10 && box.positions[f[1]].x == 10 &&
                box.positions[f[2]].x == 10);
  }
  const ObjectDepth depth = measure_depth({0, 0, 0}, box.positions, box.triangles, back);
  EXPECT_DOUBLE_EQ(depth.nearest, 10);
  EXPECT_DOUBLE_EQ(depth.depth, 0);
  const ObjectDepth none =
      measure_depth({0, 0, 0}, box.positions, box.triangles, std::vector<bool>(12, true));
  EXPECT_EQ(none.nearest, 0);
  EXPECT_EQ(none.depth, 0);
}

// A wide wall: its corners are five times as far as its middle.
TEST(MeasureDepth, NearestPointMayBeInsideATriangle) {
  const std::vector<glm::vec3> positions{{10, -50, -5}, {10, 50, -5}, {10, 0, 50}};
  const std::vector<Triangle> triangles{{0, 1, 2}};
  EXPECT_NEAR(measure_depth({0, 0, 0}, positions, triangles, {false}).nearest, 10, 1e-12);
  EXPECT_NEAR(measure_depth({0, 0, -8}, positions, triangles, {false}).nearest, std::hypot(10, 3),
              1e-12);  // on its lower edge
  EXPECT_NEAR(measure_depth({0, 60, -5}, positions, triangles, {false}).nearest, std::hypot(10, 10),
              1e-12);  // at its corner
}

TEST(MeasureDepth, NearestIsNoFartherThanAnySample) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<glm::vec3> positions(20);
    for (glm::vec3& p : positions)
      p = {random.uniform(5, 40), random.uniform(-20, 20), random.uniform(-20, 20)};
    std::vector<Triangle> triangles(15);
    for (Triangle& t : triangles) t = {random.below(20), random.below(20), random.below(20)};
    const double nearest =
        measure_depth({0, 0, 0}, positions, triangles, std::vector<bool>(15, false)).nearest;
    double sampled = 1e300;
    for (int i = 0; i < 20000; ++i) {
      const Triangle& t = triangles[random.below(15)];
      double u = random.uniform(), v = random.uniform();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const glm::dvec3 a(positions[t[0]]), b(positions[t[1]]), c(positions[t[2]]);
      sampled = std::min(sampled, glm::length(a + u * (b - a) + v * (c - a)));
    }
    EXPECT_LE(nearest, sampled + 1e-9);
    EXPECT_GE(nearest, sampled - 1);
  }
}

}  // namespace
}  // namespace viewcell

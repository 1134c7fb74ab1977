#include "visibility/regional.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "base/random.h"

namespace viewcell {
namespace {

using Corners = std::vector<glm::dvec3>;

// A hexagonal prism: the first six corners low, the others high.
Corners make_prism(const glm::dvec2& centre, double size, double low, double high) {
  Corners corners;
  for (const double z : {low, high})
    for (int k = 0; k < 6; ++k) {
      const double angle = glm::radians(60.0 * k);
      corners.emplace_back(centre.x + size * std::cos(angle), centre.y + size * std::sin(angle), z);
    }
  return corners;
}

// A random point of the corners' hull, sometimes a corner itself or on an edge.
glm::dvec3 random_inside(const Corners& corners, Random& random) {
  glm::dvec3 sum(0);
  double weights = 0;
  for (const glm::dvec3& corner : corners) {
    const double w = random.below(3) == 0 ? random.uniform() : 0;
    sum += w * corner;
    weights += w;
  }
  return weights > 0 ? sum / weights : corners[random.below(12)];
}

glm::dvec3 random_point(Random& random, double reach, double z_reach) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach),
          random.uniform(-z_reach, z_reach)};
}

bool is_front_facing(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                     const glm::dvec3& eye) {
  return glm::dot(glm::cross(b - a, c - a), eye - a) > 0;
}

// Counter-clockwise seen from -x, so its outward normal is -x: the sign that the paper has wrong.
//      c
//     / \        eye at -x sees the front, at +x the back
//    a---b
TEST(IsBackFacing, SignIsTheOutwardNormals) {
  const glm::dvec3 a(0, 1, 0), b(0, -1, 0), c(0, 0, 1);
  EXPECT_FALSE(is_back_facing(a, b, c, make_prism({-10, 0}, 2, -1, 1)));
  EXPECT_TRUE(is_back_facing(a, b, c, make_prism({10, 0}, 2, -1, 1)));
  EXPECT_FALSE(is_back_facing(a, c, b, make_prism({10, 0}, 2, -1, 1)));
}

// A region that the triangle's plane cuts sees the front from somewhere.
TEST(IsBackFacing, PlaneThroughTheRegionIsNotBackFacing) {
  const glm::dvec3 a(0, 1, 0), b(0, -1, 0), c(0, 0, 1);
  EXPECT_FALSE(is_back_facing(a, b, c, make_prism({1, 0}, 2, -1, 1)));
  EXPECT_TRUE(is_back_facing(a, b, c, make_prism({2.001, 0}, 2, -1, 1)));
  EXPECT_FALSE(is_back_facing(a, b, c, make_prism({2, 0}, 2, -1, 1)));  // touches
}

TEST(IsBackFacing, TriangleWithoutAreaIsBackFacing) {
  EXPECT_TRUE(is_back_facing({1, 1, 1}, {2, 2, 2}, {3, 3, 3}, make_prism({10, 0}, 2, -1, 1)));
}

// A roof that slopes away: its plane passes over the low corners and under the high ones.
TEST(IsBackFacing, SixCornersAtOneHeightWouldCullWhatTheOthersSee) {
  const glm::dvec3 a(30, -5, 18), b(30, 5, 18), c(40, 0, 18);  // level, upward
  const Corners low = make_prism({0, 0}, 10, 16, 16), both = make_prism({0, 0}, 10, 16, 20);
  EXPECT_GT(glm::cross(b - a, c - a).z * -1, 0);  // as given it looks down
  EXPECT_TRUE(is_back_facing(a, c, b, low));      // turned up: not seen from below
  EXPECT_FALSE(is_back_facing(a, c, b, both));    // but seen from 20
  EXPECT_FALSE(is_back_facing(a, b, c, both));    // and its underside from 16
}

// Back-facing to the hull means back-facing to every point of it.
TEST(IsBackFacing, NoCulledTriangleIsFrontFacingToAnyEyeInside) {
  std::size_t n_culled = 0, n_kept_seen = 0, n_kept = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double low = random.uniform(-20, 30);
    const Corners prism = make_prism({random.uniform(-50, 50), random.uniform(-50, 50)},
                                     random.uniform(1, 60), low, low + random.uniform(0, 10));
    const glm::dvec3 a = random_point(random, 150, 40);
    const glm::dvec3 b = a + random_point(random, 5, 5), c = a + random_point(random, 5, 5);
    const bool is_culled = is_back_facing(a, b, c, prism);
    n_culled += is_culled;
    bool is_seen = false;
    for (int i = 0; i < 1000; ++i)
      is_seen |= is_front_facing(a, b, c, random_inside(prism, random));
    EXPECT_FALSE(is_culled && is_seen);
    n_kept += !is_culled;
    n_kept_seen += !is_culled && is_seen;
  }
  EXPECT_GT(n_culled, 100u);
  EXPECT_GT(n_kept_seen, n_kept * 95 / 100);  // and little is kept that no point sees
}

// The test commutes with turning, moving and scaling everything.
TEST(IsBackFacing, DoesNotDependOnTheFrame) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const glm::dquat turn = glm::normalize(
        glm::dquat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 1.1));
    const glm::dvec3 shift = random_point(random, 900, 900);
    const auto moved = [&](const glm::dvec3& p) { return 2.5 * (turn * p) + shift; };
    const Corners prism = make_prism({0, 0}, 20, 16, 20);
    const glm::dvec3 a = random_point(random, 150, 40);
    const glm::dvec3 b = a + random_point(random, 5, 5), c = a + random_point(random, 5, 5);
    Corners moved_prism;
    for (const glm::dvec3& p : prism) moved_prism.push_back(moved(p));
    EXPECT_EQ(is_back_facing(a, b, c, prism),
              is_back_facing(moved(a), moved(b), moved(c), moved_prism));
  }
}

TEST(FindRegionalBackFaces, OneFlagATriangleOfTheListGiven) {
  const std::vector<glm::vec3> positions{{0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  const std::vector<Triangle> list{{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {0, 0, 1}};
  EXPECT_EQ(find_regional_back_faces(positions, list, make_prism({10, 0}, 2, -1, 1)),
            (std::vector<bool>{true, false, true, true}));
}

}  // namespace
}  // namespace viewcell

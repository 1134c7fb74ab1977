// Quadrics and the metric made of them.
#include "pm/qem.h"

#include <gtest/gtest.h>

#include "pm/shapes.h"
#include "pm/simplify.h"

namespace viewcell {
namespace {

glm::dvec3 random_point(Random& random, double reach) {
  return {random.uniform(-reach, reach), random.uniform(-reach, reach),
          random.uniform(-reach, reach)};
}

TEST(Quadric, ZeroOnItsPlanesAndSquaredDistanceOffThem) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const glm::dvec3 normal = glm::normalize(random_point(random, 1));
    const glm::dvec3 point = random_point(random, 10);
    Quadric q;
    q.add_plane(normal, point, 2);
    const glm::dvec3 within = glm::cross(normal, random_point(random, 5));
    EXPECT_NEAR(q.value(point + within), 0, 1e-9);
    EXPECT_NEAR(q.value(point + within + 3.0 * normal), 2 * 9, 1e-8);
    EXPECT_EQ(q.weight, 2);
  }
}

TEST(Quadric, IsTheWeightedSumOfSquaredDistances) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const glm::dvec3 p = random_point(random, 5);
    Quadric a, b;
    double expected = 0;
    for (int i = 0; i < 10; ++i) {
      const glm::dvec3 normal = glm::normalize(random_point(random, 1));
      const glm::dvec3 point = random_point(random, 5);
      const double weight = random.uniform(0, 2), d = glm::dot(normal, p - point);
      (i % 2 ? a : b).add_plane(normal, point, weight);
      expected += weight * d * d;
    }
    a.add(b);
    EXPECT_NEAR(a.value(p), expected, 1e-9);
  }
}

// Three coordinate planes: the squared distance to the origin.
TEST(Quadric, OfACornerIsTheSquaredDistanceToIt) {
  Quadric q;
  for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}})
    q.add_plane(axis, {0, 0, 0}, 1);
  EXPECT_DOUBLE_EQ(q.value({1, 2, 3}), 14);
}

TEST(QemMetric, FlatGridCostsNothingInside) {
  const TriMesh grid = make_flat_grid(4);
  const QemMetric metric(grid.positions, grid.triangles);
  EXPECT_EQ(metric.cost(12, 13), 0);  // the middle, to the right
  EXPECT_EQ(metric.cost(12, 6), 0);
  EXPECT_NEAR(metric.cost(2, 1), 0, 1e-6);  // along a straight boundary
  EXPECT_GT(metric.cost(2, 7), 0.1f);       // away from it
  EXPECT_GT(metric.cost(0, 1), 0.1f);       // a corner
}

//  A roof along y: slopes z = -|x|, weights equal on both sides. Moving a ridge vertex down one
//  slope by (1, 0, -1) leaves that plane at 0 and the other at sqrt 2: the root of the mean square,
//  over both vertices' planes, is below sqrt 2 and over 0.
TEST(QemMetric, RidgeIsKept) {
  TriMesh roof = make_flat_grid(4);
  for (glm::vec3& p : roof.positions) p.z = -std::abs(p.x - 2);
  const QemMetric metric(roof.positions, roof.triangles);
  EXPECT_NEAR(metric.cost(12, 7), 0, 1e-6);   // along the ridge
  EXPECT_NEAR(metric.cost(11, 6), 0, 1e-6);   // along the slope
  EXPECT_NEAR(metric.cost(11, 12), 0, 1e-6);  // up to the ridge, which lies on the slope too
  // 12's area: three triangles a side. 6 have both planes in equal parts in 12, one plane in 13.
  EXPECT_NEAR(metric.cost(12, 13), std::sqrt(2.0 / 4), 1e-5);
}

TEST(QemMetric, CostIsADistanceAndScalesWithTheMesh) {
  TriMesh sphere = make_noisy_sphere(2, 0.2, 3);
  const QemMetric metric(sphere.positions, sphere.triangles);
  TriMesh scaled = sphere;
  for (glm::vec3& p : scaled.positions) p = p * 8.0f;
  const QemMetric scaled_metric(scaled.positions, scaled.triangles);
  for (const Triangle& t : sphere.triangles)
    EXPECT_NEAR(scaled_metric.cost(t[0], t[1]), 8 * metric.cost(t[0], t[1]), 1e-5);
}

// Far from the origin, float positions keep 2^-24 of 4096; the metric adds nothing to that.
TEST(QemMetric, DoesNotSufferFarFromTheOrigin) {
  TriMesh grid = make_flat_grid(4);
  for (glm::vec3& p : grid.positions) p += glm::vec3(4096, -4096, 4096);
  const QemMetric metric(grid.positions, grid.triangles);
  EXPECT_EQ(metric.cost(12, 13), 0);
}

TEST(QemMetric, CollapsedAddsUp) {
  const TriMesh sphere = make_noisy_sphere(2, 0.2, 4);
  QemMetric metric(sphere.positions, sphere.triangles);
  const float before = metric.cost(0, 1);
  metric.collapsed(1, 2);
  EXPECT_EQ(metric.cost(0, 1), before);  // 1 is gone; what it gathered is 2's
  EXPECT_GE(metric.cost(0, 2), 0);
}

TEST(QemMetric, MeshWithoutAreaCostsNothing) {
  const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<Triangle> triangles{{0, 1, 2}};
  const QemMetric metric(positions, triangles);
  EXPECT_EQ(metric.cost(0, 1), 0);
}

TEST(Qem, CubeStaysACubeToItsTwelveTriangles) {
  for (int n = 1; n <= 12; ++n) {
    SCOPED_TRACE(n);
    const SimplifyResult result = simplify(make_fine_cube(n), {.target_triangles = 12});
    EXPECT_EQ(result.mesh.triangles.size(), 12u);
    EXPECT_LT(result.error, 1e-5 * n);
    EXPECT_TRUE(is_closed_manifold(result.mesh.triangles));
    double volume = 0;
    for (const Triangle& t : result.mesh.triangles) {
      const auto& p = result.mesh.positions;
      volume += glm::dot(p[t[0]], glm::cross(p[t[1]], p[t[2]])) / 6;
    }
    EXPECT_NEAR(volume, n * n * n, 1e-3);
  }
}

}  // namespace
}  // namespace viewcell

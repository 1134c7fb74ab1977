#include "mesh/surface_samples.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "mesh/closest_point.h"
#include "mesh/cube.h"
#include "mesh/knot.h"

namespace viewcell {
namespace {

std::vector<glm::dvec3> face_points(const SurfaceSamples& samples, const TriMesh& mesh) {
  std::vector<glm::dvec3> points(samples.n_face_samples);
  sample_faces(samples, mesh, 0, points);
  return points;
}

TriMesh triangle_mesh(std::vector<glm::vec3> positions, std::vector<Triangle> triangles) {
  TriMesh mesh;
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(triangles);
  return mesh;
}

// Triangles side by side in the plane z = number, of random areas; some have none.
TriMesh random_strips(Random& random, std::uint32_t n) {
  TriMesh mesh;
  for (std::uint32_t t = 0; t < n; ++t) {
    const float z = static_cast<float>(t);
    const float height = random.below(4) ? static_cast<float>(random.uniform(0.01, 3)) : 0.0f;
    for (const glm::vec3& p : {glm::vec3(0, 0, z), glm::vec3(1, 0, z), glm::vec3(0, height, z)})
      mesh.positions.push_back(p);
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

TEST(SurfaceSamples, EveryTriangleGetsItsShare) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const TriMesh mesh = random_strips(random, 60);
    const std::size_t n = 1 + random.below(1000);
    const SurfaceSamples samples = plan_surface_samples(mesh, n, seed);
    std::vector<double> counts(mesh.triangles.size(), 0);
    for (const glm::dvec3& p : face_points(samples, mesh))
      ++counts[static_cast<std::size_t>(std::lround(p.z))];
    for (std::size_t t = 0; t < counts.size(); ++t) {
      const double area = 0.5 * glm::length(area_normal(mesh, mesh.triangles[t]));
      const double share = area / surface_area(mesh) * static_cast<double>(n);
      EXPECT_GE(counts[t], std::floor(share - 1e-9));
      EXPECT_LE(counts[t], std::ceil(share + 1e-9));
      if (area == 0) {
        EXPECT_EQ(counts[t], 0);
      }
    }
  }
}

// Each of 256 equal parts of one triangle gets its sixteen samples, or a few more or less.
TEST(SurfaceSamples, SpreadEvenlyInATriangle) {
  constexpr int kParts = 16;
  const TriMesh mesh = triangle_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const SurfaceSamples samples = plan_surface_samples(mesh, 16 * kParts * kParts, seed);
    std::vector<int> counts(2 * kParts * kParts, 0);
    for (const glm::dvec3& p : face_points(samples, mesh)) {
      ASSERT_GE(p.x, 0);
      ASSERT_GE(p.y, 0);
      ASSERT_LE(p.x + p.y, 1 + 1e-15);
      const double x = p.x * kParts, y = p.y * kParts;
      const int i = std::min(static_cast<int>(x), kParts - 1);
      const int j = std::min(static_cast<int>(y), kParts - 1);
      const bool is_upper = (x - i) + (y - j) > 1;
      ++counts[static_cast<std::size_t>(2 * (i * kParts + j) + is_upper)];
    }
    double squared = 0;
    int n_cells = 0;
    for (int i = 0; i < kParts; ++i)
      for (int j = 0; i + j < kParts; ++j)
        for (int upper = 0; upper < (i + j + 1 < kParts ? 2 : 1); ++upper) {
          const int miss = counts[static_cast<std::size_t>(2 * (i * kParts + j) + upper)] - 16;
          EXPECT_LE(std::abs(miss), 8);
          squared += miss * miss;
          ++n_cells;
        }
    EXPECT_EQ(n_cells, kParts * kParts);
    EXPECT_LT(std::sqrt(squared / n_cells), 2.5);  // 4 for random points
  }
}

// Small triangles, fewer than one sample each, must not favour a corner: the mean of the samples is
// the centre of the surface.
TEST(SurfaceSamples, SpreadEvenlyOverManyTriangles) {
  const TriMesh mesh = make_bumpy_torus(100, 200);
  glm::dvec3 centre(0), mean(0);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      centre += glm::length(area_normal(mesh, t)) / 6 * glm::dvec3(mesh.positions[v]);
  centre /= surface_area(mesh);
  const SurfaceSamples samples = plan_surface_samples(mesh, 20'000, 3);
  for (const glm::dvec3& p : face_points(samples, mesh)) mean += p / 20'000.0;
  EXPECT_LT(glm::distance(mean, centre), 5e-4);  // random points: 8e-3
}

//  3-----2
//  |   / |     5 edges, of lengths 2, 2, 2, 2 and sqrt(8); vertex 4 is not used
//  | /   |
//  0-----1
TEST(SurfaceSamples, VerticesAndEdgesByHand) {
  const TriMesh mesh = triangle_mesh({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {9, 9, 9}},
                                     {{0, 1, 2}, {0, 2, 3}});
  const SurfaceSamples samples = plan_surface_samples(mesh, 16);  // one each 0.5 of edge
  EXPECT_EQ(samples.vertices, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(samples.edges,
            (std::vector<std::array<std::uint32_t, 2>>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}}));
  EXPECT_EQ(samples.edge_starts, (std::vector<std::uint64_t>{0, 4, 9, 13, 17, 21}));
  EXPECT_DOUBLE_EQ(samples.area(), 4);
  EXPECT_DOUBLE_EQ(samples.length, 8 + std::sqrt(8.0));

  std::vector<glm::dvec3> points(21);
  std::vector<double> weights(21);
  sample_edges(samples, mesh, 0, points, weights);
  EXPECT_EQ(points[0], glm::dvec3(0.25, 0, 0));
  EXPECT_EQ(points[3], glm::dvec3(1.75, 0, 0));
  EXPECT_NEAR(glm::distance(points[4], glm::dvec3(0.2, 0.2, 0)), 0, 1e-15);
  EXPECT_EQ(points[20], glm::dvec3(0.25, 2, 0));
  EXPECT_DOUBLE_EQ(weights[0], 0.5);
  EXPECT_DOUBLE_EQ(weights[4], std::sqrt(8.0) / 5);
}

// An edge of a triangle that has almost no area: the number of samples stays within bounds.
TEST(SurfaceSamples, NeedlesHaveNoEndOfEdgeSamples) {
  const TriMesh mesh =
      triangle_mesh({{0, 0, 0}, {1, 0, 0}, {0.5, 1e-20f, 0}}, {{0, 1, 2}, {1, 1, 0}});
  const SurfaceSamples samples = plan_surface_samples(mesh, 100);
  EXPECT_LE(samples.n_edge_samples(), 303u);
  EXPECT_GE(samples.n_edge_samples(), 290u);
}

TEST(SurfaceSamples, PartsAreThoseOfTheWhole) {
  const TriMesh mesh = make_bumpy_torus(10, 20);
  const SurfaceSamples samples = plan_surface_samples(mesh, 1000, 5);
  const std::vector<glm::dvec3> all = face_points(samples, mesh);
  std::vector<glm::dvec3> edges(samples.n_edge_samples()), part(7);
  std::vector<double> weights(edges.size());
  sample_edges(samples, mesh, 0, edges, weights);
  for (std::size_t first = 0; first + 7 <= 1000; first += 13) {
    sample_faces(samples, mesh, first, part);
    EXPECT_TRUE(std::equal(part.begin(), part.end(), all.begin() + static_cast<long>(first)));
    sample_edges(samples, mesh, first, part, std::span(weights).first(7));
    EXPECT_TRUE(std::equal(part.begin(), part.end(), edges.begin() + static_cast<long>(first)));
  }
}

TEST(SurfaceSamples, SeedsShift) {
  const TriMesh mesh = triangle_mesh(cube_positions(), cube_triangles());
  const auto points = [&](std::uint64_t seed) {
    return face_points(plan_surface_samples(mesh, 100, seed), mesh);
  };
  EXPECT_EQ(points(1), points(1));
  EXPECT_NE(points(1), points(2));
}

}  // namespace
}  // namespace viewcell

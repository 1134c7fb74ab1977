#include "mesh/surface_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <numeric>

#include "base/random.h"
#include "common/models.h"
#include "formats/mesh_file.h"
#include "mesh/closest_point.h"
#include "mesh/cube.h"
#include "mesh/knot.h"
#include "mesh/surface_samples.h"

namespace viewcell {
namespace {

// Corners lo and hi.
TriMesh make_box(glm::vec3 lo, glm::vec3 hi) {
  TriMesh mesh = make_cube();
  for (glm::vec3& p : mesh.positions) p = lo + p * (hi - lo);
  return mesh;
}

// n x n squares of [0, 1] x [0, 1] at this height.
TriMesh make_square(std::uint32_t n, float z) {
  TriMesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j)
      mesh.positions.emplace_back(static_cast<float>(i) / static_cast<float>(n),
                                  static_cast<float>(j) / static_cast<float>(n), z);
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  return mesh;
}

TriMesh make_sphere(std::uint32_t n, float radius) {
  TriMesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j < 2 * n; ++j) {
      const double a = std::numbers::pi * i / n, b = std::numbers::pi * j / n;
      mesh.positions.push_back(
          radius * glm::vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < 2 * n; ++j) {
      const std::uint32_t a = 2 * n * i + j, b = 2 * n * i + (j + 1) % (2 * n);
      mesh.triangles.push_back({a, a + 2 * n, b + 2 * n});
      mesh.triangles.push_back({a, b + 2 * n, b});
    }
  return mesh;
}

TriMesh moved(TriMesh mesh, const std::function<glm::dvec3(const glm::dvec3&)>& move) {
  for (glm::vec3& p : mesh.positions) p = glm::vec3(move(glm::dvec3(p)));
  return mesh;
}

TriMesh noisy_torus(std::uint64_t seed, std::uint32_t n = 12) {
  Random random(seed);
  TriMesh mesh = make_bumpy_torus(n, 2 * n);
  for (glm::vec3& p : mesh.positions)
    for (int k = 0; k < 3; ++k) p[k] += static_cast<float>(random.uniform(-0.1, 0.1));
  return mesh;
}

DistanceOptions samples(std::size_t n) {
  DistanceOptions options;
  options.n_samples = n;
  return options;
}

SurfaceDistance measure(const TriMesh& a, const TriMesh& b, std::size_t n = 20'000) {
  return measure_surface_distance(a, b, samples(n));
}

// Max, mean and RMS of a side, all within this part of what is expected.
void expect_side(const OneSidedDistance& side, double max, double mean, double rms,
                 double part = 1e-3) {
  EXPECT_NEAR(side.max, max, part * max);
  EXPECT_NEAR(side.mean, mean, part * mean);
  EXPECT_NEAR(side.rms, rms, part * rms);
}

TEST(SurfaceDistance, ToItselfIsRounding) {
  for (const TriMesh& mesh : {make_bumpy_torus(20, 40), make_bumpy_torus(9, 9, glm::vec3(1e4f)),
                              make_bumpy_torus(9, 9, glm::vec3(0), 1e30f)}) {
    const SurfaceDistance d = measure(mesh, mesh);
    const Box box = bounding_box(mesh);
    const glm::dvec3 farthest = glm::max(glm::abs(box.lo), glm::abs(box.hi));
    EXPECT_LE(d.symmetric().max, 1e-15 * std::max({farthest.x, farthest.y, farthest.z}));
    EXPECT_LE(d.symmetric().rms, d.symmetric().max);
  }
}

TEST(SurfaceDistance, ShiftedSquares) {
  const SurfaceDistance d = measure(make_square(1, 0), make_square(7, 0.25f));
  expect_side(d.forward, 0.25, 0.25, 0.25, 1e-12);
  expect_side(d.backward, 0.25, 0.25, 0.25, 1e-12);
  EXPECT_DOUBLE_EQ(d.forward.p50, 0.25);
  EXPECT_DOUBLE_EQ(d.forward.mean_pooled, 0.25);
  EXPECT_DOUBLE_EQ(d.bbox_diagonal, std::sqrt(2.0));
}

// A square and its half: points at x in [1/2, 1] are x - 1/2 away. Uniform over area, whatever the
// tessellation: mean (1/2)(1/4), mean square (1/2)(1/12), percentiles those of max(0, x - 1/2).
TEST(SurfaceDistance, ASquareAndItsHalf) {
  const TriMesh half =
      moved(make_square(3, 0), [](glm::dvec3 p) { return glm::dvec3(0.5 * p.x, p.y, p.z); });
  TriMesh uneven = make_square(20, 0);  // columns crowd where x is small
  for (glm::vec3& p : uneven.positions) p.x *= p.x;
  for (const TriMesh& square : {make_square(1, 0), make_square(30, 0), uneven}) {
    const SurfaceDistance d = measure(square, half, 100'000);
    expect_side(d.forward, 0.5, 0.125, std::sqrt(1.0 / 24));
    EXPECT_NEAR(d.forward.p50, 0, 1e-3);
    EXPECT_NEAR(d.forward.p95, 0.45, 1e-3);
    EXPECT_NEAR(d.forward.p99, 0.49, 1e-3);
    EXPECT_LE(d.backward.max, 1e-15);
    EXPECT_EQ(d.symmetric().max, d.forward.max);
    EXPECT_EQ(d.symmetric().mean, d.forward.mean);
    EXPECT_EQ(d.symmetric().rms, d.forward.rms);
  }
}

TEST(SurfaceDistance, SpheresOfTwoRadii) {
  const SurfaceDistance d = measure(make_sphere(64, 1), make_sphere(66, 2), 5000);
  expect_side(d.forward, 1, 1, 1);
  expect_side(d.backward, 1, 1, 1);
}

// An outer cube of side 2 around an inner one of side 1, same centre. From the inner: 1/2
// everywhere. From a point of an outer face, (x, y) from its middle: to the inner cube,
// sqrt(1/4 + max(0, |x| - 1/2)^2 + max(0, |y| - 1/2)^2), largest sqrt(3)/2 at the corners; with
// |x|, |y| below 1/2 for a quarter of the face, one of them beyond for half of it, both for the
// rest.
TEST(SurfaceDistance, ACubeInACube) {
  const TriMesh inner = make_box(glm::vec3(-0.5f), glm::vec3(0.5f));
  const TriMesh outer = make_box(glm::vec3(-1), glm::vec3(1));
  double one = 0, two = 0;  // means of the distance where one, or both, are beyond; by midpoints
  constexpr int kSteps = 500;
  for (int i = 0; i < kSteps; ++i) {
    const double x = 0.5 * (i + 0.5) / kSteps;
    one += std::sqrt(0.25 + x * x) / kSteps;
    for (int j = 0; j < kSteps; ++j) {
      const double y = 0.5 * (j + 0.5) / kSteps;
      two += std::sqrt(0.25 + x * x + y * y) / kSteps / kSteps;
    }
  }
  const double mean = 0.25 * 0.5 + 0.5 * one + 0.25 * two;
  const double mean_square = 0.25 + (0.5 + 0.25 * 2) / 12;  // mean of x^2 over [0, 1/2]: 1/12
  const SurfaceDistance d = measure(outer, inner, 100'000);
  expect_side(d.forward, std::sqrt(3.0) / 2, mean, std::sqrt(mean_square));
  expect_side(d.backward, 0.5, 0.5, 0.5, 1e-12);
  EXPECT_EQ(glm::abs(d.forward.worst.point), glm::dvec3(1));
  EXPECT_EQ(glm::abs(d.forward.worst.nearest), glm::dvec3(0.5));
}

TEST(SurfaceDistance, OneTriangle) {
  const TriMesh a = make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const TriMesh b = make_mesh({{0, 0, 2}, {1, 0, 2}, {0, 1, 2}}, {{2, 1, 0}});
  const SurfaceDistance d = measure_surface_distance(a, b, samples(1));
  expect_side(d.forward, 2, 2, 2, 1e-15);
  EXPECT_EQ(d.forward.n_vertices, 3u);
  EXPECT_EQ(d.forward.n_face_samples, 1u);
  EXPECT_EQ(d.vertex_distance, (std::vector<double>{2, 2, 2}));
}

// Segments and points as faces: they are reached, they have vertices and edges, and no area.
TEST(SurfaceDistance, DegenerateTriangles) {
  const TriMesh plain = make_square(2, 0);
  TriMesh more = plain;
  more.positions.insert(more.positions.end(), {{0, 0, 1}, {0.5f, 0, 1}, {1, 0, 1}, {5, 0, 0}});
  more.triangles.push_back({9, 10, 11});   // a segment
  more.triangles.push_back({12, 12, 12});  // a point
  const SurfaceDistance d = measure(more, plain);
  EXPECT_DOUBLE_EQ(d.forward.max, 4);
  EXPECT_LE(d.forward.mean, 1e-15);
  EXPECT_LE(d.backward.max, 1e-15);
  EXPECT_EQ(d.vertex_distance[9], 1);
  EXPECT_EQ(measure(make_square(1, 1), more).forward.worst.distance,
            measure(make_square(1, 1), more).forward.max);
  // (1/2, 0, 2) is nearest to the segment, not to the square two below.
  EXPECT_NEAR(measure(make_box({0.4f, 0, 2}, {0.6f, 0.1f, 2.1f}), more).forward.p50, 1.05, 0.06);
}

TEST(SurfaceDistance, VerticesThatNoTriangleUsesDoNotCount) {
  const TriMesh a = make_square(2, 0), b = make_square(3, 0.5f);
  TriMesh more = a;
  more.positions.push_back({1e30f, 0, 0});
  const SurfaceDistance plain = measure(a, b), d = measure(more, b), back = measure(b, more);
  EXPECT_EQ(d.forward.max, plain.forward.max);
  EXPECT_EQ(d.backward.mean, plain.backward.mean);
  EXPECT_EQ(d.bbox_diagonal, plain.bbox_diagonal);
  EXPECT_EQ(d.forward.n_vertices, 9u);
  EXPECT_EQ(d.vertex_distance.back(), 0);
  EXPECT_EQ(back.forward.max, plain.backward.max);
}

TEST(SurfaceDistance, ForwardIsBackwardTheOtherWayRound) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    const TriMesh a = noisy_torus(seed), b = noisy_torus(seed + 100, 9);
    const SurfaceDistance ab = measure(a, b, 5000), ba = measure(b, a, 5000);
    EXPECT_EQ(ab.forward.max, ba.backward.max);
    EXPECT_EQ(ab.forward.mean, ba.backward.mean);
    EXPECT_EQ(ab.backward.rms, ba.forward.rms);
    EXPECT_EQ(ab.backward.p95, ba.forward.p95);
    EXPECT_EQ(ab.symmetric().max, ba.symmetric().max);
    EXPECT_NE(ab.forward.max, ab.backward.max);
  }
}

// A maximum over samples may fall short by about half their spacing, sqrt(area / n) = 0.05 here.
TEST(SurfaceDistance, TriangleInequality) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const TriMesh a = noisy_torus(3 * seed), b = noisy_torus(3 * seed + 1, 8);
    TriMesh c = noisy_torus(3 * seed + 2, 5);
    for (glm::vec3& p : c.positions) p.x += 0.5f * static_cast<float>(seed % 3);
    const auto max = [](const TriMesh& x, const TriMesh& y) {
      return measure(x, y, 5000).symmetric().max;
    };
    const double ab = max(a, b), bc = max(b, c), ac = max(a, c);
    EXPECT_LE(ac, ab + bc + 0.05);
    EXPECT_LE(ab, ac + bc + 0.05);
    EXPECT_LE(bc, ab + ac + 0.05);
  }
}

// No distance to a vertex is smaller, no sample is missed: against every triangle for each vertex.
TEST(SurfaceDistance, VertexDistancesAsIfEveryTriangleWereTried) {
  const TriMesh a = noisy_torus(1), b = noisy_torus(2, 7);
  const SurfaceDistance d = measure(a, b, 1000);
  for (std::size_t v = 0; v < a.positions.size(); ++v) {
    double best = 1e300;
    const glm::dvec3 p(a.positions[v]);
    for (const Triangle& t : b.triangles)
      best = std::min(best,
                      glm::distance(p, closest_point_on_triangle(p, glm::dvec3(b.positions[t[0]]),
                                                                 glm::dvec3(b.positions[t[1]]),
                                                                 glm::dvec3(b.positions[t[2]]))));
    ASSERT_NEAR(d.vertex_distance[v], best, 1e-14);
    ASSERT_LE(best, d.forward.max + 1e-14);
  }
}

// Both meshes moved alike: figures change by the rounding of float coordinates only.
void expect_invariant(const std::function<glm::dvec3(const glm::dvec3&)>& move, double factor,
                      double tolerance) {
  const TriMesh a = noisy_torus(1), b = noisy_torus(2, 8);
  const SurfaceDistance before = measure(a, b), after = measure(moved(a, move), moved(b, move));
  const auto expect_near = [&](double x, double y) {
    EXPECT_NEAR(x, factor * y, tolerance * factor * y);
  };
  for (const auto& [x, y] :
       {std::pair(&after.forward, &before.forward), std::pair(&after.backward, &before.backward)}) {
    expect_near(x->max, y->max);
    expect_near(x->mean, y->mean);
    expect_near(x->rms, y->rms);
    expect_near(x->p95, y->p95);
    expect_near(x->mean_pooled, y->mean_pooled);
  }
}

TEST(SurfaceDistance, RigidMotion) {
  const glm::dquat turn = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)));
  expect_invariant([&](const glm::dvec3& p) { return turn * p + glm::dvec3(3, -2, 5); }, 1, 1e-4);
}
TEST(SurfaceDistance, Scale) {
  for (const double factor : {1e30, 1e-30, 3.0})
    expect_invariant([&](const glm::dvec3& p) { return factor * p; }, factor, 1e-4);
  expect_invariant([](const glm::dvec3& p) { return std::ldexp(1.0, 90) * p; }, std::ldexp(1.0, 90),
                   1e-15);
}

// A's longest side is 4: figures are a quarter, places are seen from A's lowest corner.
TEST(SurfaceDistance, UnitCube) {
  const TriMesh a = make_box({2, 2, 2}, {6, 4, 4}), b = make_box({2, 2, 2}, {6, 4, 5});
  DistanceOptions options = samples(1000);
  const SurfaceDistance plain = measure_surface_distance(a, b, options);
  options.unit_cube = true;
  const SurfaceDistance unit = measure_surface_distance(a, b, options);
  EXPECT_DOUBLE_EQ(plain.backward.max, 1);
  EXPECT_DOUBLE_EQ(unit.backward.max, 0.25);
  EXPECT_DOUBLE_EQ(unit.backward.mean, plain.backward.mean / 4);
  EXPECT_DOUBLE_EQ(unit.backward.rms_pooled, plain.backward.rms_pooled / 4);
  EXPECT_DOUBLE_EQ(unit.forward.p99, plain.forward.p99 / 4);
  EXPECT_DOUBLE_EQ(unit.bbox_diagonal, std::sqrt(1 + 0.25 + 0.25));
  EXPECT_EQ(unit.backward.worst.point, (plain.backward.worst.point - glm::dvec3(2)) / 4.0);
  EXPECT_DOUBLE_EQ(unit.backward.worst.point.z, 0.75);
  EXPECT_DOUBLE_EQ(unit.units_per_model_unit, 0.25);
}

TEST(SurfaceDistance, Histogram) {
  const TriMesh half =
      moved(make_square(3, 0), [](glm::dvec3 p) { return glm::dvec3(0.5 * p.x, p.y, p.z); });
  DistanceOptions options = samples(100'000);
  options.n_bins = 5;
  const SurfaceDistance d = measure_surface_distance(make_square(1, 0), half, options);
  ASSERT_EQ(d.forward.histogram.size(), 5u);
  EXPECT_NEAR(static_cast<double>(d.forward.histogram[0]), 60'000, 100);  // x below 1/2 + 1/10
  for (std::size_t k = 1; k < 5; ++k)
    EXPECT_NEAR(static_cast<double>(d.forward.histogram[k]), 10'000, 100);
  EXPECT_EQ(d.backward.histogram, (std::vector<std::uint64_t>{100'000, 0, 0, 0, 0}));
  EXPECT_DOUBLE_EQ(d.histogram_most, d.forward.max);
}

// Distances of the unit square from its half x <= 1/2 run to 1/2; of four times the squares, in the
// unit cube, as well.
TEST(SurfaceDistance, HistogramOfAGivenRange) {
  for (const double size : {1.0, 4.0}) {
    const auto scaled = [&](double x) {
      return moved(make_square(3, 0),
                   [=](glm::dvec3 p) { return size * glm::dvec3(x * p.x, p.y, p.z); });
    };
    DistanceOptions options = samples(100'000);
    options.unit_cube = true;
    options.n_bins = 4;
    options.histogram_most = 0.2;
    const SurfaceDistance part = measure_surface_distance(scaled(1), scaled(0.5), options);
    EXPECT_DOUBLE_EQ(part.histogram_most, 0.2);
    ASSERT_EQ(part.forward.histogram.size(), 4u);
    EXPECT_NEAR(static_cast<double>(part.forward.histogram[0]), 55'000, 100);
    EXPECT_NEAR(static_cast<double>(part.forward.histogram[3]), 5'000, 100);
    options.histogram_most = 1;
    const SurfaceDistance more = measure_surface_distance(scaled(1), scaled(0.5), options);
    EXPECT_NEAR(static_cast<double>(more.forward.histogram[1]), 25'000, 100);
    EXPECT_EQ(more.forward.histogram[2] + more.forward.histogram[3], 0u);
    EXPECT_EQ(more.forward.histogram[0] + more.forward.histogram[1], 100'000u);
  }
}

// Metro's counts by hand for 1000 samples in all: 4 vertices; on edges, of length 4 + sqrt(2), one
// for each 1 / sqrt(996) of it; on faces 996 - 4 and those on edges less.
TEST(SurfaceDistance, PooledAsMetroDoes) {
  const TriMesh half =
      moved(make_square(1, 0), [](glm::dvec3 p) { return glm::dvec3(0.5 * p.x, p.y, p.z); });
  const double edges = (4 + std::sqrt(2.0)) * std::sqrt(996.0), faces = 992 - edges;
  // Vertices: two at 0, two at 1/2. Edges: two of mean 1/8, one of 0, one of 1/2, diagonal of 1/8.
  const double on_edges = (2 * 0.125 + 0.5 + std::sqrt(2.0) * 0.125) / (4 + std::sqrt(2.0));
  const double expected = (4 * 0.25 + edges * on_edges + faces * 0.125) / (4 + edges + faces);
  const SurfaceDistance d = measure(make_square(1, 0), half, 1000);
  EXPECT_NEAR(d.forward.mean_pooled, expected, 5e-3 * expected);
  EXPECT_GT(d.forward.mean_pooled, 1.05 * d.forward.mean);
}

TEST(SurfaceDistance, SameForAnyNumberOfThreadsAndForASeed) {
  const TriMesh a = noisy_torus(1, 30), b = noisy_torus(2, 8);
  DistanceOptions options = samples(30'000);
  options.n_threads = 1;
  const SurfaceDistance one = measure_surface_distance(a, b, options);
  for (const int n_threads : {1, 2, 5, 7}) {
    options.n_threads = n_threads;
    const SurfaceDistance more = measure_surface_distance(a, b, options);
    EXPECT_EQ(more.forward.mean, one.forward.mean);
    EXPECT_EQ(more.backward.rms, one.backward.rms);
    EXPECT_EQ(more.forward.mean_pooled, one.forward.mean_pooled);
    EXPECT_EQ(more.forward.worst.point, one.forward.worst.point);
    EXPECT_EQ(more.vertex_distance, one.vertex_distance);
  }
  options.seed = 1;
  const SurfaceDistance other = measure_surface_distance(a, b, options);
  EXPECT_NE(other.forward.mean, one.forward.mean);
  EXPECT_NEAR(other.forward.mean, one.forward.mean, 0.005 * one.forward.mean);
}

// A mesh against itself with its vertices on a lattice of a fiftieth of its size, where many
// triangles have become segments and points.
void expect_steady_means(const TriMesh& mesh) {
  const double step = glm::length(bounding_box(mesh).size()) / 50;
  const TriMesh coarse =
      moved(mesh, [step](const glm::dvec3& p) { return step * glm::round(p / step); });
  const SurfaceDistance few = measure(mesh, coarse, 50'000), many = measure(mesh, coarse, 300'000);
  EXPECT_GT(many.forward.mean, 0.05 * step);
  EXPECT_LT(many.forward.max, step);  // vertices move by less than 0.87 steps
  for (const auto& [x, y] :
       {std::pair(&few.forward, &many.forward), std::pair(&few.backward, &many.backward)}) {
    EXPECT_NEAR(x->max, y->max, 0.1 * y->max);
    EXPECT_NEAR(x->mean, y->mean, 0.01 * y->mean);
    EXPECT_NEAR(x->rms, y->rms, 0.01 * y->rms);
  }
}

TEST(SurfaceDistance, MeansDoNotDependOnTheNumberOfSamples) {
  expect_steady_means(make_lumpy_figure(132));
}

TEST(OutsideSurfaceDistance, MeansOfTheBunnyDoNotDependOnTheNumberOfSamples) {
  const std::filesystem::path file =
      std::filesystem::path(VIEWCELL_SHARED_DATA) / "bunny-69k/bunny70k.ply";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  expect_steady_means(read_mesh(file));
}

// ---- point clouds ----

TriMesh make_points(std::vector<glm::vec3> positions) {
  TriMesh mesh;
  mesh.positions = std::move(positions);
  return mesh;
}

// Points at heights 0, 1, 2, 3 over a square: every figure by hand.
TEST(PointDistance, ByHand) {
  const TriMesh square = make_square(1, 0);
  const TriMesh points =
      make_points({{0.5f, 0.5f, 0}, {0.5f, 0.25f, 1}, {0.25f, 0.5f, -2}, {0.5f, 0.5f, 3}});
  DistanceOptions options;
  options.n_bins = 3;
  for (const PointCloud which : {PointCloud::a, PointCloud::b}) {
    const SurfaceDistance d = measure_point_distance(points, square, which, options);
    EXPECT_EQ(d.points, which);
    EXPECT_DOUBLE_EQ(d.forward.max, 3);
    EXPECT_DOUBLE_EQ(d.forward.mean, 1.5);
    EXPECT_DOUBLE_EQ(d.forward.rms, std::sqrt(14.0 / 4));
    EXPECT_DOUBLE_EQ(d.forward.p50, 1);
    EXPECT_DOUBLE_EQ(d.forward.p95, 3);
    EXPECT_EQ(d.forward.n_vertices, 4u);
    EXPECT_EQ(d.forward.n_all_samples(), 4u);
    EXPECT_EQ(d.backward.n_all_samples(), 0u);
    EXPECT_EQ(d.forward.histogram, (std::vector<std::uint64_t>{1, 1, 2}));
    EXPECT_EQ(d.vertex_distance, (std::vector<double>{0, 1, 2, 3}));
    EXPECT_EQ(d.forward.worst.point, glm::dvec3(0.5, 0.5, 3));
    EXPECT_DOUBLE_EQ(d.bbox_diagonal,
                     which == PointCloud::b ? std::sqrt(2.0) : std::sqrt(25 + 2.0 / 16));
  }
}

// ---- offsets ----

TEST(SurfaceDistance, OffsetsAreTakenOffExactly) {
  const glm::dvec3 far(500000, 4649776, 208);
  TriMesh a = make_box({0, 0, 0}, {4, 4, 4}), b = a;
  a.offset = far;
  b.offset = far + glm::dvec3(16, 0, 0);
  for (glm::vec3& p : b.positions) p.x += -16 + 0.125f;
  const SurfaceDistance d = measure_surface_distance(a, b, samples(1000));
  EXPECT_NEAR(d.forward.max, 0.125, 1e-12);
  EXPECT_NEAR(d.backward.max, 0.125, 1e-12);
  EXPECT_LT(glm::distance(d.forward.worst.point, far + glm::dvec3(2)), 4);
  EXPECT_NEAR(glm::distance(d.forward.worst.point, d.forward.worst.nearest), 0.125, 1e-9);
  DistanceOptions unit = samples(1000);
  unit.unit_cube = true;
  const SurfaceDistance u = measure_surface_distance(a, b, unit);
  EXPECT_NEAR(u.forward.max, 0.125 / 4, 1e-12);
  EXPECT_LE(glm::length(u.forward.worst.point), std::sqrt(3.0) + 1e-12);
  // A large mesh about no offset, and a small one that floats there would spoil.
  const TriMesh ground = make_box({-1e7f, -1e7f, -1e7f}, {1e7f, 1e7f, 208});
  b.offset = far;
  for (glm::vec3& p : b.positions) p = p * 0.001f + glm::vec3(0, 0, 0.5f);
  EXPECT_NEAR(measure_point_distance(make_points(b.positions), ground, PointCloud::a).forward.max,
              207.5, 1e-3);  // about no offset it is deep inside
  TriMesh points = make_points(b.positions);
  points.offset = far;
  EXPECT_NEAR(measure_point_distance(points, ground, PointCloud::a).forward.max, 0.5 + 0.001 * 4,
              1e-6);
}

}  // namespace
}  // namespace viewcell

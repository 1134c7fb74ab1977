#include "pm/simplify.h"

#include <gtest/gtest.h>

#include <cstring>
#include <tuple>

#include "common/same_every_time.h"
#include "mesh/used_vertices.h"
#include "pm/shapes.h"

namespace viewcell {
namespace {

TEST(Simplify, ReachesTheTargetWithinOne) {
  const TriMesh sphere = make_noisy_sphere(4, 0.1, 1);  // 2048 triangles
  for (const std::size_t target : {2047u, 1000u, 501u, 100u, 20u}) {
    const SimplifyResult result = simplify(sphere, {.target_triangles = target});
    EXPECT_LE(result.mesh.triangles.size(), target);
    EXPECT_GE(result.mesh.triangles.size() + 1, target);
    EXPECT_TRUE(is_closed_manifold(result.mesh.triangles));
    EXPECT_EQ(euler_characteristic(result.mesh.triangles), 2);
  }
}

TEST(Simplify, KeepsOriginalVerticesBitForBit) {
  TriMesh sphere = make_noisy_sphere(3, 0.1, 2);
  sphere.normals = make_vertex_normals(sphere);
  for (std::size_t v = 0; v < sphere.positions.size(); ++v)
    sphere.colors.emplace_back(static_cast<float>(v) / 1000);
  const SimplifyResult result = simplify(sphere, {.target_triangles = 100});
  ASSERT_EQ(result.source_vertex.size(), result.mesh.positions.size());
  ASSERT_EQ(result.mesh.normals.size(), result.mesh.positions.size());
  for (std::size_t v = 0; v < result.source_vertex.size(); ++v) {
    const std::uint32_t source = result.source_vertex[v];
    EXPECT_EQ(result.mesh.positions[v], sphere.positions[source]);
    EXPECT_EQ(result.mesh.normals[v], sphere.normals[source]);
    EXPECT_EQ(result.mesh.colors[v], sphere.colors[source]);
    EXPECT_TRUE(v == 0 || result.source_vertex[v - 1] < source);
  }
}

TEST(Simplify, NothingAskedForChangesNothing) {
  const TriMesh sphere = make_noisy_sphere(2, 0.1, 3);
  const SimplifyResult result = simplify(sphere, {.target_triangles = sphere.triangles.size()});
  EXPECT_EQ(result.mesh.triangles, sphere.triangles);
  EXPECT_EQ(result.mesh.positions, sphere.positions);
  EXPECT_EQ(result.error, 0);
}

TEST(Simplify, FlatGridBecomesTwoTrianglesForNothing) {
  const SimplifyResult result = simplify(make_flat_grid(10), {.max_error = 1e-6f});
  EXPECT_EQ(result.mesh.triangles.size(), 2u);
  EXPECT_LT(result.error, 1e-6);
}

TEST(Simplify, MaxErrorIsNotPassed) {
  const TriMesh sphere = make_noisy_sphere(4, 0.02, 4);
  std::size_t last = sphere.triangles.size();
  for (const float most : {0.001f, 0.01f, 0.03f, 0.1f}) {
    const SimplifyResult result = simplify(sphere, {.max_error = most});
    EXPECT_LE(result.error, most);
    EXPECT_LT(result.mesh.triangles.size(), last);
    last = result.mesh.triangles.size();
  }
}

TEST(Simplify, SameBytesEveryTime) {
  const TriMesh sphere = make_noisy_sphere(4, 0.1, 5);
  const auto made = same_every_time([&sphere](std::size_t) {
    const SimplifyResult result = simplify(sphere, {.target_triangles = 200});
    return std::tuple(result.mesh.triangles, result.mesh.positions, result.source_vertex);
  });
  EXPECT_EQ(std::get<0>(made).size(), 200u);
}

TEST(Simplify, DegenerateAndNonManifoldInputIsTaken) {
  TriMesh sphere = make_noisy_sphere(3, 0.1, 6);
  const auto n = static_cast<std::uint32_t>(sphere.positions.size());
  sphere.positions.emplace_back(0, 0, 5);
  sphere.positions.emplace_back(0, 0, 5);
  sphere.triangles.push_back({0, 1, n});            // a fin: edge 0 1 may have three triangles
  sphere.triangles.push_back({n, n + 1, 0});        // no area
  sphere.triangles.push_back({5, 5, 6});            // a repeated index
  sphere.triangles.push_back(sphere.triangles[3]);  // a double
  const SimplifyResult result = simplify(sphere, {.target_triangles = 100});
  EXPECT_LE(result.mesh.triangles.size(), 110u);
  for (const Triangle& t : result.mesh.triangles) {
    EXPECT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
    for (const std::uint32_t v : t) EXPECT_LT(v, result.mesh.positions.size());
  }
}

// [Ericson, Real-Time Collision Detection 5.1.5], by projections and edges.
double distance_to_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                            const glm::dvec3& c) {
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const auto is_left = [&](const glm::dvec3& s, const glm::dvec3& t) {
    return glm::dot(glm::cross(t - s, p - s), n) >= 0;
  };
  if (is_left(a, b) && is_left(b, c) && is_left(c, a))
    return std::abs(glm::dot(p - a, n)) / glm::length(n);
  const auto to_edge = [&](const glm::dvec3& s, const glm::dvec3& t) {
    const double u = std::clamp(glm::dot(p - s, t - s) / glm::dot(t - s, t - s), 0.0, 1.0);
    return glm::length(p - (s + u * (t - s)));
  };
  return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

// Of the original's vertices from the level's surface, over all of both.
double measure_distance(const TriMesh& mesh, const std::vector<Triangle>& triangles) {
  double most = 0;
  for (const glm::vec3& p : mesh.positions) {
    double least = 1e300;
    for (const Triangle& t : triangles)
      least = std::min(least, distance_to_triangle(p, mesh.positions[t[0]], mesh.positions[t[1]],
                                                   mesh.positions[t[2]]));
    most = std::max(most, least);
  }
  return most;
}

TEST(BuildLevels, HalvesAndErrorsNeverFall) {
  const TriMesh sphere = make_noisy_sphere(5, 0.02, 7);  // 8192 triangles
  const std::vector<Level> levels = build_levels(sphere, {.min_triangles = 64});
  ASSERT_EQ(levels.size(), 8u);  // 8192 / 2^7 = 64
  EXPECT_EQ(levels[0].triangles, sphere.triangles);
  EXPECT_EQ(levels[0].error, 0);
  for (std::size_t i = 1; i < levels.size(); ++i) {
    EXPECT_EQ(levels[i].triangles.size(), levels[i - 1].triangles.size() / 2);
    EXPECT_GE(levels[i].error, levels[i - 1].error);
  }
}

// A level is simplify()'s result for the same count.
TEST(BuildLevels, LevelIsWhatSimplifyMakes) {
  const TriMesh sphere = make_noisy_sphere(4, 0.05, 8);
  const std::vector<Level> levels = build_levels(sphere, {.min_triangles = 64});
  for (const Level& level : levels) {
    const SimplifyResult result = simplify(sphere, {.target_triangles = level.triangles.size()});
    EXPECT_EQ(compact(sphere, level.triangles).mesh.triangles, result.mesh.triangles);
  }
}

// The error is a root mean square over planes, not a bound. What holds here: no original vertex is
// farther from a level's surface than 2.67 times its error (1.5 to 2.7 over all levels).
TEST(BuildLevels, ErrorStandsForTheDistance) {
  double worst = 0;
  for (const double noise : {0.0, 0.02, 0.1}) {
    const TriMesh sphere = make_noisy_sphere(4, noise, 9);
    for (const Level& level : build_levels(sphere, {.min_triangles = 32})) {
      if (level.error == 0) continue;
      const double measured = measure_distance(sphere, level.triangles);
      worst = std::max(worst, measured / level.error);
    }
  }
  EXPECT_LT(worst, 3);
}

TEST(BuildLevels, SmallMeshIsItsOnlyLevel) {
  const TriMesh tetrahedron = make_tetrahedron();
  const std::vector<Level> levels = build_levels(tetrahedron);
  ASSERT_EQ(levels.size(), 1u);
  EXPECT_EQ(levels[0].triangles, tetrahedron.triangles);
  EXPECT_EQ(build_levels(TriMesh{}).size(), 1u);
}

}  // namespace
}  // namespace viewcell

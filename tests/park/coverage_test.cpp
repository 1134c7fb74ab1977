#include "park/coverage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace viewcell {
namespace {

// A square wall of half side `half`, across the x axis at `x`, centred on height z.
TriMesh make_wall(float x, float half, float z) {
  TriMesh mesh;
  mesh.positions = {
      {x, -half, z - half}, {x, half, z - half}, {x, half, z + half}, {x, -half, z + half}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(CoverageSamples, LieOnTheSurfaceByArea) {
  TriMesh mesh = make_wall(0, 1, 0);
  const std::uint32_t n = 4;
  for (const glm::vec3& p : make_wall(9, 2, 0).positions) mesh.positions.push_back(p);
  mesh.triangles.push_back({n, n + 1, n + 2});
  mesh.triangles.push_back({n, n + 2, n + 3});
  const CoverageSamples samples = sample_surface(mesh, 1000);
  int n_large = 0;
  for (const glm::vec3& p : samples.points) {
    const bool is_large = p.x > 4.5f;
    EXPECT_NEAR(p.x, is_large ? 9 : 0, 1e-5);
    EXPECT_LE(std::max(std::abs(p.y), std::abs(p.z)), is_large ? 2.0001f : 1.0001f);
    n_large += is_large;
  }
  EXPECT_NEAR(n_large, 800, 1);
}

// Without the far side of a statue to fill the gaps between samples, they must overlap.
CoverageSamples sample_closely(const TriMesh& mesh) {
  CoverageSamples samples = sample_surface(mesh, 40000);
  samples.radius *= 3.5f;
  return samples;
}

// The frame at distance d is 2 d tan(30 deg) wide: a wall of half side h covers (h / d / tan)^2.
TEST(Panorama, AWallCoversItsShareFromAllSides) {
  Random random(4);
  const double edge = std::tan(glm::radians(30.0));
  for (int i = 0; i < 60; ++i) {
    const double half = random.uniform(0.12, 0.9) * 50 * edge, yaw = random.uniform(-6, 6);
    const CoverageSamples samples = sample_closely(make_wall(50, static_cast<float>(half), 7));
    Panorama panorama({0, 0, 7});
    panorama.draw(samples, yaw, {0, 0, 0});
    const double share = std::pow(half / 50 / edge, 2);
    EXPECT_NEAR(panorama.coverage(yaw), share, 0.04 * share + 0.003) << half << " " << yaw;
    EXPECT_NEAR(panorama.coverage(yaw + 3.1), 0, 1e-9);
  }
}

TEST(Panorama, AWallThatFillsTheFrameCoversAll) {
  Panorama panorama({0, 0, 0});
  panorama.draw(sample_closely(make_wall(10, 30, 0)), 1, {0, 0, 0});
  EXPECT_GT(panorama.coverage(1), 0.99);
}

TEST(Panorama, DrawingAgainChangesNothing) {
  const CoverageSamples samples = sample_surface(make_wall(50, 9, 0), 500);
  Panorama panorama({0, 0, 0});
  panorama.draw(samples, 0.4, {3, 1, 2});
  const double once = panorama.coverage(0.4);
  panorama.draw(samples, 0.4, {3, 1, 2});
  EXPECT_EQ(panorama.coverage(0.4), once);
  EXPECT_EQ(panorama.coverage(0.4 - 2 * 3.14159265358979323846), once);
}

}  // namespace
}  // namespace viewcell

#include "park/relief.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace viewcell {
namespace {

// n x n vertices, 1 apart, at z = 5; one far below, so that the floor is elsewhere.
TriMesh make_sheet(std::uint32_t n, double jitter, std::uint64_t seed) {
  Random random(seed);
  TriMesh mesh;
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const bool is_rim = x == 0 || y == 0 || x + 1 == n || y + 1 == n;
      const double by = is_rim ? 0 : jitter;
      mesh.positions.emplace_back(x + random.uniform(-by, by), y + random.uniform(-by, by), 5);
    }
  for (std::uint32_t y = 0; y + 1 < n; ++y)
    for (std::uint32_t x = 0; x + 1 < n; ++x) {
      const std::uint32_t a = y * n + x;
      mesh.triangles.push_back({a, a + 1, a + n + 1});
      mesh.triangles.push_back({a, a + n + 1, a + n});
    }
  mesh.positions.emplace_back(0, 0, 0);
  return mesh;
}

TEST(Waves, RaiseASheetByTheirHeightAndLeaveItsRim) {
  constexpr std::uint32_t n = 120;
  const TriMesh flat = make_sheet(n, 0, 0);
  TriMesh mesh = flat;
  add_waves(mesh, {.height = 0.3, .wavelength = glm::dvec3(4), .seed = 3}, 0.01);
  double sum2 = 0, most = 0;
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const glm::vec3 moved = mesh.positions[y * n + x] - flat.positions[y * n + x];
      EXPECT_EQ(moved.x, 0);
      EXPECT_EQ(moved.y, 0);
      const bool is_rim = x == 0 || y == 0 || x + 1 == n || y + 1 == n;
      EXPECT_TRUE(!is_rim || moved.z == 0);
      sum2 += moved.z * moved.z;
      most = std::max(most, std::abs(static_cast<double>(moved.z)));
    }
  EXPECT_NEAR(std::sqrt(sum2 / (n * n)), 0.3 * 0.86, 0.05);  // edges of 1 beside a mean of 1.14
  EXPECT_LT(most, 0.3 * 2.2 + 1e-6);
}

// No wave on the sheet is shorter than the wavelength, so zeros are at least half of it apart on
// the average; and most waves are not much longer.
TEST(Waves, AreAsLongAsAsked) {
  constexpr std::uint32_t n = 160;
  for (const double wavelength : {4.0, 6.0, 9.0}) {
    TriMesh mesh = make_sheet(n, 0, 0);
    add_waves(mesh, {.height = 0.1, .wavelength = glm::dvec3(wavelength), .seed = 9}, 0.01);
    int n_zeros = 0, n_steps = 0;
    for (std::uint32_t y = 1; y + 1 < n; ++y)
      for (std::uint32_t x = 1; x + 2 < n; ++x, ++n_steps)
        n_zeros += (mesh.positions[y * n + x].z < 5) != (mesh.positions[y * n + x + 1].z < 5);
    const double zeros_per_wave = n_zeros * wavelength / n_steps;
    EXPECT_LT(zeros_per_wave, 2) << wavelength;
    EXPECT_GT(zeros_per_wave, 0.8) << wavelength;
  }
}

TEST(Waves, DoNotMoveTheFloor) {
  TriMesh mesh = make_sheet(20, 0, 0);
  mesh.positions.pop_back();  // now the sheet is the floor
  const auto before = mesh.positions;
  add_waves(mesh, {.height = 0.3, .wavelength = glm::dvec3(4), .seed = 3}, 0.01);
  EXPECT_EQ(mesh.positions, before);
}

TEST(Relax, EvensEdgesWithinTheSurface) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    const TriMesh rough = make_sheet(30, 0.35, seed);
    TriMesh mesh = rough;
    relax_tangentially(mesh, 3, 0.01);
    const auto spread = [](const TriMesh& m) {
      const double mean = mean_edge_length(m);
      double sum = 0;
      for (const Triangle& t : m.triangles)
        sum += std::pow(glm::length(m.positions[t[0]] - m.positions[t[1]]) - mean, 2);
      return sum;
    };
    EXPECT_LT(spread(mesh), 0.7 * spread(rough));
    for (std::size_t v = 0; v + 1 < mesh.positions.size(); ++v)
      EXPECT_NEAR(mesh.positions[v].z, 5, 1e-5);
    EXPECT_EQ(mesh.positions[0], rough.positions[0]);  // the rim stays
    EXPECT_EQ(mesh.positions[29], rough.positions[29]);
  }
}

}  // namespace
}  // namespace viewcell

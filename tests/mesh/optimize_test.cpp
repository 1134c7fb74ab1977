#include "mesh/optimize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/random.h"
#include "common/models.h"
#include "formats/mesh_file.h"
#include "mesh/knot.h"

namespace viewcell {
namespace {

std::vector<Triangle> sorted(std::vector<Triangle> triangles) {
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

// Vertices that miss a first-in first-out cache of 16.
std::size_t count_misses(const std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> cache;
  std::size_t n = 0;
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) {
      if (std::find(cache.begin(), cache.end(), v) != cache.end()) continue;
      ++n;
      cache.push_back(v);
      if (cache.size() > 16) cache.erase(cache.begin());
    }
  return n;
}

TriMesh make_shuffled_torus() {
  TriMesh mesh = make_bumpy_torus(40, 100);
  Random random(1);
  for (std::size_t t = mesh.triangles.size(); t > 1; --t)
    std::swap(mesh.triangles[t - 1], mesh.triangles[random.below(static_cast<std::uint32_t>(t))]);
  return mesh;
}

TEST(IndexOrder, SameTrianglesFewerMisses) {
  const TriMesh mesh = make_shuffled_torus();
  const std::vector<Triangle> better = optimize_index_order(mesh.triangles, mesh.positions.size());
  EXPECT_EQ(sorted(better), sorted(mesh.triangles));  // corner for corner
  EXPECT_LT(count_misses(better), mesh.triangles.size() * 8 / 10);
  EXPECT_GT(count_misses(mesh.triangles), mesh.triangles.size() * 2);
  EXPECT_TRUE(optimize_index_order({}, 0).empty());
}

TEST(FetchOrder, IsAPermutationByFirstUse) {
  EXPECT_EQ(make_fetch_order({{4, 2, 0}, {2, 4, 5}}, 6),
            (std::vector<std::uint32_t>{2, 4, 1, 5, 0, 3}));
  const TriMesh mesh = make_shuffled_torus();
  std::vector<std::uint32_t> ids = make_fetch_order(mesh.triangles, mesh.positions.size());
  std::sort(ids.begin(), ids.end());
  for (std::uint32_t v = 0; v < ids.size(); ++v) EXPECT_EQ(ids[v], v);
}

void expect_ladder(const std::vector<DetailLevel>& levels, const TriMesh& mesh) {
  EXPECT_EQ(sorted(levels[0].triangles), sorted(mesh.triangles));
  EXPECT_EQ(levels[0].error, 0);
  for (std::size_t i = 1; i < levels.size(); ++i) {
    EXPECT_LT(levels[i].triangles.size(), levels[i - 1].triangles.size());
    EXPECT_GE(levels[i].error, levels[i - 1].error);
    for (const Triangle& t : levels[i].triangles)
      for (const std::uint32_t v : t) EXPECT_LT(v, mesh.positions.size());
  }
}

TEST(DetailLevels, FewerTrianglesAndNoSmallerErrors) {
  const TriMesh mesh = make_bumpy_torus(40, 100);
  const std::vector<DetailLevel> levels = build_meshopt_levels(mesh);
  expect_ladder(levels, mesh);
  EXPECT_GT(levels.size(), 8u);
  EXPECT_LT(levels.back().triangles.size(), 100u);
  EXPECT_LT(levels[1].error, 0.01);
  EXPECT_GT(levels.back().error, levels[1].error);
}

TEST(DetailLevels, ErrorsAreInModelUnits) {
  const auto small = build_meshopt_levels(make_bumpy_torus(30, 60));
  const auto large = build_meshopt_levels(make_bumpy_torus(30, 60, glm::vec3(0), 64));
  ASSERT_EQ(small.size(), large.size());
  for (std::size_t i = 0; i < small.size(); ++i)
    EXPECT_NEAR(large[i].error, 64 * small[i].error, 1e-3 * large[i].error + 1e-12);
}

// Where a mesh was welded, vertices are left that nothing uses, at the places of others.
TEST(DetailLevels, UnusedVerticesHoldNothing) {
  const TriMesh mesh = make_bumpy_torus(30, 60);
  TriMesh doubled = mesh;
  for (std::size_t v = 0; v < mesh.positions.size(); v += 3)
    doubled.positions.push_back(mesh.positions[v]);
  doubled.positions.insert(doubled.positions.begin(), glm::vec3(1e6f));
  for (Triangle& t : doubled.triangles)
    for (std::uint32_t& v : t) ++v;
  const auto levels = build_meshopt_levels(mesh), others = build_meshopt_levels(doubled);
  ASSERT_EQ(levels.size(), others.size());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    EXPECT_EQ(levels[i].error, others[i].error);
    std::vector<Triangle> moved = levels[i].triangles;
    for (Triangle& t : moved)
      for (std::uint32_t& v : t) ++v;
    EXPECT_EQ(moved, others[i].triangles);
  }
}

TEST(DetailLevels, SmallAndEmptyMeshes) {
  EXPECT_EQ(build_meshopt_levels({}).size(), 1u);
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(build_meshopt_levels(mesh).size(), 1u);
  EXPECT_EQ(build_meshopt_levels(make_bumpy_torus(40, 100), {.n_most = 3}).size(), 3u);
}

void expect_levels_of_scan(const TriMesh& mesh) {
  const std::vector<DetailLevel> levels = build_meshopt_levels(mesh);
  expect_ladder(levels, mesh);
  EXPECT_LT(levels.back().triangles.size(), mesh.triangles.size() / 3);
}

TEST(DetailLevels, AScanDespiteItsNonManifoldEdges) {
  expect_levels_of_scan(make_rough_scan(53).mesh);
}

TEST(OutsideDetailLevels, TheDragonDespiteItsNonManifoldEdges) {
  const std::filesystem::path file =
      std::filesystem::path(VIEWCELL_SHARED_DATA) / "dragon-11k/dragon_vrip_res4.ply.gz";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  expect_levels_of_scan(read_mesh(file));
}

}  // namespace
}  // namespace viewcell

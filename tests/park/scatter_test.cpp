#include "park/scatter.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "park/stand_ins.h"

namespace viewcell {
namespace {

// An upright box of the table's size.
TriMesh make_block(const glm::dvec3& size) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back((i & 1 ? 0.5 : -0.5) * size.x, (i & 2 ? 0.5 : -0.5) * size.y,
                                i & 4 ? size.z : 0.0);
  mesh.triangles = {{0, 1, 4}};
  return mesh;
}

std::vector<SceneMesh> make_blocks() {
  std::vector<SceneMesh> meshes(kStatueKinds);
  for (std::size_t k = 0; k < kStatueKinds; ++k) {
    meshes[k].name = statue_kinds()[k].name;
    meshes[k].mesh = make_block(statue_kinds()[k].size);
  }
  return meshes;
}

TEST(Scatter, HasTheTablesNumbersTierByTier) {
  const auto objects = scatter_statues(make_blocks(), 1);
  std::array<std::map<std::size_t, int>, kParkSizes> counts;
  for (std::size_t i = 0; i < objects.size(); ++i)
    for (int size = 0; size < kParkSizes; ++size)
      if (i < count_statues(ParkSize(size)))
        ++counts[static_cast<std::size_t>(size)][index(objects[i].mesh)];
  for (std::size_t size = 0; size < kParkSizes; ++size)
    for (std::size_t k = 0; k < kStatueKinds; ++k)
      EXPECT_EQ(counts[size][k], statue_kinds()[k].counts[size]);
  std::set<std::string> names;
  for (const SceneObject& object : objects) names.insert(object.name);
  EXPECT_EQ(names.size(), 253u);
}

TEST(Scatter, NothingOverlapsOrLeavesTheArea) {
  const std::vector<SceneMesh> meshes = make_blocks();
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const auto objects = scatter_statues(meshes, seed);
    std::vector<ConvexPolygon> hulls;
    for (const SceneObject& object : objects) {
      EXPECT_NEAR(glm::length(object.rotation), 1, 1e-12);
      EXPECT_EQ(object.translation.z, 0);
      ConvexPolygon corners;  // from the vertices, not by the code under test
      for (const glm::vec3& p : meshes[index(object.mesh)].mesh.positions) {
        const glm::dvec3 q = object.world_from_model(glm::dvec3(p));
        EXPECT_TRUE(q.x > 0 && q.x < 1650 && q.y > 0 && q.y < 2035);
        corners.emplace_back(q);
      }
      hulls.push_back(convex_hull(corners));
    }
    for (std::size_t i = 0; i < hulls.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) ASSERT_GT(distance(hulls[i], hulls[j]), 13.9);
  }
}

TEST(Scatter, IsUniform) {
  std::array<int, 4> quarter{};
  std::array<int, 4> turn{};
  const std::vector<SceneMesh> meshes = make_blocks();
  int n = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const SceneObject& object : scatter_statues(meshes, seed)) {
      ++quarter[static_cast<std::size_t>((object.translation.x > 825) +
                                         2 * (object.translation.y > 1017.5))];
      const double angle = 2 * std::atan2(object.rotation.z, object.rotation.w);  // 0 to 2 pi
      ++turn[static_cast<std::size_t>(std::min(3.0, angle / 1.5708))];
      ++n;
    }
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(quarter[i], n / 4, 0.08 * n / 4);
    EXPECT_NEAR(turn[i], n / 4, 0.08 * n / 4);
  }
}

TEST(Scatter, SeedsDiffer) {
  const auto a = scatter_statues(make_blocks(), 1), b = scatter_statues(make_blocks(), 2);
  EXPECT_NE(a[0].translation, b[0].translation);
}

}  // namespace
}  // namespace viewcell

#include "mesh/used_vertices.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "mesh/surfaces.h"

namespace viewcell {
namespace {

using Numbers = std::vector<std::uint32_t>;

TEST(UsedVertices, KeepTheirOrderOrThatOfUse) {
  const std::vector<Triangle> triangles{{8, 7, 4}, {4, 7, 1}};
  const UsedVertices old = find_used_vertices(triangles, 9);
  EXPECT_EQ(old.source, (Numbers{1, 4, 7, 8}));
  EXPECT_EQ(old.new_index[8], 3u);
  EXPECT_EQ(old.new_index[5], kUnusedVertex);
  EXPECT_EQ(old.renumber(triangles), (std::vector<Triangle>{{3, 2, 1}, {1, 2, 0}}));
  const UsedVertices first = find_used_vertices(triangles, 9, VertexOrder::first_use);
  EXPECT_EQ(first.source, (Numbers{8, 7, 4, 1}));
  EXPECT_EQ(first.renumber(triangles), (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(first.pick(Numbers{10, 11, 12, 13, 14, 15, 16, 17, 18}), (Numbers{18, 17, 14, 11}));
  EXPECT_TRUE(first.pick(Numbers{}).empty());
  EXPECT_EQ(find_used_vertices({}, 5).size(), 0u);
}

// Whatever the triangles, in either order: old and new numbers are each other's inverse, and no
// used vertex is left out.
TEST(UsedVertices, NumbersGoBothWays) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::uint32_t n = 1 + random.below(60);
    std::vector<Triangle> triangles(random.below(40));
    for (Triangle& t : triangles)
      for (std::uint32_t& v : t) v = random.below(n);
    for (const VertexOrder order : {VertexOrder::old, VertexOrder::first_use}) {
      const UsedVertices used = find_used_vertices(triangles, n, order);
      std::size_t n_placed = 0;
      for (const std::uint32_t place : used.new_index) n_placed += place != kUnusedVertex;
      ASSERT_EQ(n_placed, used.size());
      for (std::uint32_t v = 0; v < used.size(); ++v) ASSERT_EQ(used.new_index[used.source[v]], v);
      const std::vector<Triangle> renumbered = used.renumber(triangles);
      for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
          ASSERT_EQ(used.source[renumbered[t][k]], triangles[t][k]);
    }
  }
}

TEST(UsedVertices, CompactTakesAttributesAlong) {
  TriMesh grid = make_grid(2);
  for (std::uint32_t v = 0; v < 9; ++v) grid.normals.emplace_back(v, 0, 1);
  const CompactMesh result = compact(grid, std::vector<Triangle>{{8, 7, 4}, {4, 7, 1}});
  EXPECT_EQ(result.source_vertex, (Numbers{1, 4, 7, 8}));
  EXPECT_EQ(result.mesh.triangles, (std::vector<Triangle>{{3, 2, 1}, {1, 2, 0}}));
  ASSERT_EQ(result.mesh.normals.size(), 4u);
  for (std::size_t v = 0; v < 4; ++v) {
    EXPECT_EQ(result.mesh.positions[v], grid.positions[result.source_vertex[v]]);
    EXPECT_EQ(result.mesh.normals[v], grid.normals[result.source_vertex[v]]);
  }
  EXPECT_TRUE(result.mesh.colors.empty());
}

}  // namespace
}  // namespace viewcell

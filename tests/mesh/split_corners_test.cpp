#include "mesh/split_corners.h"

#include <gtest/gtest.h>

#include "mesh/surfaces.h"
#include "mesh/topology.h"

namespace viewcell {
namespace {

// Two triangles that meet at a right angle in the edge 0 1; one normal each.
TriMesh folded_sheet() {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  const glm::vec3 up(0, 0, 1), ahead(0, 1, 0);
  mesh.corner_normals = {up, up, up, ahead, ahead, ahead};
  return mesh;
}

// Every triangle with vertices of its own.
TriMesh tear(const TriMesh& mesh) {
  TriMesh out;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    for (const std::uint32_t v : t) out.positions.push_back(mesh.positions[v]);
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

TEST(SplitCorners, VerticesOfSeveralNormalsAreSplitBehindTheOthers) {
  const SplitMesh split = split_corners(folded_sheet());
  EXPECT_EQ(split.mesh.positions.size(), 6u);
  EXPECT_EQ(split.mesh.triangles[0], (Triangle{0, 1, 2}));
  EXPECT_EQ(split.mesh.triangles[1], (Triangle{4, 5, 3}));
  EXPECT_EQ(split.mesh.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(split.mesh.normals[5], glm::vec3(0, 1, 0));
  EXPECT_EQ(split.weld.of(4), 1u);
  EXPECT_EQ(split.weld.of(5), 0u);
  EXPECT_EQ(split.weld.weld(split.mesh.triangles), (std::vector<Triangle>{{0, 1, 2}, {1, 0, 3}}));
  // One normal of the surface for both: half-way, as both triangles have a right angle at 0.
  EXPECT_EQ(split.weld.normals[0], split.weld.normals[5]);
  EXPECT_NEAR(split.weld.normals[0].y, std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(split.weld.normals[0].z, std::sqrt(0.5), 1e-6);
  EXPECT_EQ(split.weld.normals[2], glm::vec3(0, 0, 1));
}

TEST(SplitCorners, DrawnVerticesAreThoseOfTheTrianglesSide) {
  const SplitMesh split = split_corners(folded_sheet());
  const std::vector<Triangle> welded = split.weld.weld(split.mesh.triangles);
  EXPECT_EQ(choose_drawn_vertices(split.mesh, split.weld, welded), split.mesh.triangles);
}

TEST(SplitCorners, NothingToSplitChangesNothing) {
  TriMesh ball = make_ball(4);
  ball.normals = make_vertex_normals(ball);
  const SplitMesh split = split_corners(ball);
  EXPECT_TRUE(split.weld.is_empty());
  EXPECT_FALSE(split.has_twins);
  EXPECT_EQ(split.mesh.positions, ball.positions);
  EXPECT_EQ(split.mesh.normals, ball.normals);
  EXPECT_EQ(split.mesh.triangles, ball.triangles);
}

// A soup hangs together and is smooth, as the mesh that it was torn from.
TEST(SplitCorners, SoupIsWelded) {
  const TriMesh ball = make_ball(4);
  const std::vector<glm::vec3> normals = make_vertex_normals(ball);
  const SplitMesh split = split_corners(tear(ball));
  EXPECT_EQ(split.mesh.positions.size(), 3 * ball.triangles.size());
  TriMesh joined = split.mesh;
  joined.triangles = split.weld.weld(split.mesh.triangles);
  const MeshTopology topology = measure_topology(joined);
  EXPECT_TRUE(topology.is_closed_manifold());
  EXPECT_EQ(topology.n_components, 1u);
  for (std::size_t t = 0; t < ball.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(glm::dot(split.mesh.normals[3 * t + k], normals[ball.triangles[t][k]]), 1, 1e-6);
}

// Front and back of a sheet on the same vertices: each side keeps its own normal.
TEST(SplitCorners, TwoSidesHaveNormalsOfTheirOwn) {
  TriMesh sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}};
  const SplitMesh split = split_corners(sheet);
  EXPECT_TRUE(split.has_twins);
  EXPECT_EQ(split.mesh.positions.size(), 8u);
  for (std::size_t t = 0; t < 4; ++t)
    for (const std::uint32_t v : split.mesh.triangles[t])
      EXPECT_EQ(split.mesh.normals[v], glm::vec3(0, 0, t < 2 ? 1 : -1));
}

TEST(MatchTwins, PairsOppositeTurnsOnly) {
  const std::vector<Triangle> t{{0, 1, 2}, {1, 2, 0}, {2, 1, 0}, {0, 1, 3}, {1, 0, 2}};
  EXPECT_EQ(match_twins(t, 4), (std::vector<std::uint32_t>{2, 4, 0, kNoTwin, 1}));
  EXPECT_TRUE(match_twins(std::vector<Triangle>{{0, 1, 2}, {1, 2, 0}}, 3).empty());
}

}  // namespace
}  // namespace viewcell

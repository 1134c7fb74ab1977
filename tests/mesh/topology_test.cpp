#include "mesh/topology.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"
#include "mesh/cube.h"

namespace viewcell {
namespace {

TEST(Topology, ClosedCube) {
  const MeshTopology t = measure_topology(make_cube());
  EXPECT_TRUE(t.is_closed_manifold());
  EXPECT_EQ(t.n_edges, 18u);
  EXPECT_EQ(t.n_components, 1u);
  EXPECT_EQ(t.euler_characteristic, 2);
  EXPECT_EQ(t.n_unreferenced_vertices, 0u);
}

TEST(Topology, OpenCubeHasABoundary) {
  std::vector<Triangle> triangles = cube_triangles();
  triangles.resize(10);  // one square off
  const MeshTopology t = measure_topology(make_mesh(cube_positions(), triangles));
  EXPECT_EQ(t.n_boundary_edges, 4u);
  EXPECT_EQ(t.n_nonmanifold_vertices, 0u);
  EXPECT_EQ(t.euler_characteristic, 1);
  EXPECT_FALSE(t.is_closed_manifold());
}

//  Three wings on the edge 0-1, seen along it:   2   4
//                                                 \ /
//                                                  0-1---3
TEST(Topology, ThreeTrianglesOnAnEdge) {
  const MeshTopology t = measure_topology(
      make_mesh(std::vector<glm::vec3>(5, glm::vec3(0)), {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
  EXPECT_EQ(t.n_nonmanifold_edges, 1u);
  EXPECT_EQ(t.n_boundary_edges, 6u);
  EXPECT_EQ(t.n_nonmanifold_vertices, 2u);
  EXPECT_EQ(t.n_opposed_edges, 0u);
}

//  1---2
//   \ /
//    0      two triangles that share one vertex: a bow tie
//   / .
//  3---4
TEST(Topology, BowTie) {
  const MeshTopology t =
      measure_topology(make_mesh(std::vector<glm::vec3>(6, glm::vec3(0)), {{0, 2, 1}, {0, 3, 4}}));
  EXPECT_EQ(t.n_nonmanifold_vertices, 1u);
  EXPECT_EQ(t.n_components, 1u);
  EXPECT_EQ(t.n_unreferenced_vertices, 1u);
  EXPECT_EQ(t.euler_characteristic, 5 - 6 + 2);
}

TEST(Topology, OpposedTurns) {
  const MeshTopology t =
      measure_topology(make_mesh(std::vector<glm::vec3>(4), {{0, 1, 2}, {0, 1, 3}}));
  EXPECT_EQ(t.n_opposed_edges, 1u);
  EXPECT_EQ(t.n_boundary_edges, 4u);
}

TEST(Topology, ComponentsAndEmptyMeshes) {
  EXPECT_EQ(measure_topology({}).n_components, 0u);
  const MeshTopology t = measure_topology(
      make_mesh(std::vector<glm::vec3>(9), {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {5, 5, 0}}));
  EXPECT_EQ(t.n_components, 3u);  // the triangle that names 5 twice does not join them
}

TEST(CleanMesh, RemovesWhatShowsNothing) {
  TriMesh mesh = make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {9, 9, 9}},
                           {{0, 1, 2},    // stays
                            {0, 1, 1},    // names 1 twice
                            {0, 3, 1},    // on a line
                            {1, 2, 0},    // the first, turned
                            {0, 2, 1},    // the first's other side: stays
                            {2, 3, 1}});  // stays
  mesh.materials = {0, 1, 2, 3, 4, 5};
  for (int corner = 0; corner < 18; ++corner) mesh.texcoords.emplace_back(corner, 0);
  const MeshDefects defects = clean_mesh(mesh);
  EXPECT_EQ(defects.n_repeated_index, 1u);
  EXPECT_EQ(defects.n_zero_area, 1u);
  EXPECT_EQ(defects.n_duplicates, 1u);
  EXPECT_EQ(defects.n_removed(), 3u);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 1}, {2, 3, 1}}));
  EXPECT_EQ(mesh.materials, (std::vector<std::int32_t>{0, 4, 5}));
  EXPECT_EQ(mesh.texcoords[3], glm::vec2(12, 0));
  EXPECT_EQ(mesh.texcoords[8], glm::vec2(17, 0));
  EXPECT_EQ(mesh.positions.size(), 5u);
  EXPECT_EQ(defects.topology.n_unreferenced_vertices, 1u);
  EXPECT_EQ(clean_mesh(mesh).n_removed(), 0u);
}

// Random triangle soups: counts against their definitions, by comparing every pair.
TEST(CleanMesh, AgreesWithComparingEveryPair) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriMesh mesh;
    for (int v = 0; v < 6; ++v)
      mesh.positions.emplace_back(random.below(3), random.below(3), random.below(2));
    for (int t = 0; t < 12; ++t)
      mesh.triangles.push_back({random.below(6), random.below(6), random.below(6)});
    std::vector<Triangle> kept;
    for (Triangle t : mesh.triangles) {
      if (!(glm::length(area_normal(mesh, t)) > 0)) continue;
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      if (std::find(kept.begin(), kept.end(), t) == kept.end()) kept.push_back(t);
    }
    const MeshDefects defects = clean_mesh(mesh);
    EXPECT_EQ(mesh.triangles.size(), kept.size());
    EXPECT_EQ(defects.n_removed(), 12 - kept.size());
    std::size_t n_edges = 0, n_boundary = 0;
    for (std::uint32_t a = 0; a < 6; ++a)
      for (std::uint32_t b = a + 1; b < 6; ++b) {
        const auto n = std::count_if(kept.begin(), kept.end(), [&](const Triangle& t) {
          return std::count(t.begin(), t.end(), a) && std::count(t.begin(), t.end(), b);
        });
        n_edges += n > 0;
        n_boundary += n == 1;
      }
    EXPECT_EQ(defects.topology.n_edges, n_edges);
    EXPECT_EQ(defects.topology.n_boundary_edges, n_boundary);
  }
}

}  // namespace
}  // namespace viewcell

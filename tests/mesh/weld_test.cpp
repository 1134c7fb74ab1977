#include "mesh/weld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "mesh/surfaces.h"
#include "mesh/topology.h"

namespace viewcell {
namespace {

TriMesh welded(const TriMesh& mesh, const std::vector<std::uint32_t>& of) {
  TriMesh out = mesh;
  for (Triangle& t : out.triangles)
    for (std::uint32_t& v : t) v = of[v];
  return out;
}

std::vector<std::uint32_t> none_welded(const TriMesh& mesh) {
  std::vector<std::uint32_t> of(mesh.positions.size());
  std::iota(of.begin(), of.end(), 0u);
  return of;
}

TEST(Weld, SoupOfABallIsTheBallAgain) {
  const TriMesh ball = make_ball(12);
  for (const double noise : {0.0, 1e-7, 1e-6, 5e-6})
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(testing::Message() << "noise " << noise << " seed " << seed);
      const TriMesh soup = make_noisy_soup(ball, noise, seed);
      const auto of = weld_vertices(soup, default_weld_tolerance(soup));
      for (std::uint32_t v = 0; v < of.size(); ++v) EXPECT_TRUE(of[v] <= v && of[of[v]] == of[v]);
      EXPECT_EQ(std::set<std::uint32_t>(of.begin(), of.end()).size(), ball.positions.size());
      const MeshTopology topology = measure_topology(welded(soup, of));
      EXPECT_TRUE(topology.is_closed_manifold());
      EXPECT_EQ(topology.euler_characteristic, 2);
    }
}

TEST(Weld, NoughtIsEqualPositionsOnly) {
  const TriMesh ball = make_ball(6);
  const TriMesh soup = make_noisy_soup(ball, 1e-6, 1);
  EXPECT_EQ(weld_vertices(soup, 0), match_positions(soup));
  const TriMesh exact = make_noisy_soup(ball, 0, 1);
  EXPECT_EQ(weld_vertices(exact, 0), match_positions(exact));
  EXPECT_EQ(weld_vertices(exact, default_weld_tolerance(exact)), match_positions(exact));
}

// A tenth of the tolerance between vertices is no crack where the surface is whole, nor on a border
// whose edges are as short.
TEST(Weld, FineDetailIsLeftAlone) {
  TriMesh closed = join_meshes(make_ball(8, {0, 0, 0}, 1e-6), make_ball(4, {10, 0, 0}, 1));
  closed = join_meshes(closed, make_ball(8, {1.1e-6, 0, 0}, 1e-6));
  EXPECT_EQ(weld_vertices(closed, default_weld_tolerance(closed)), match_positions(closed));
  TriMesh open = make_grid(40);
  for (glm::vec3& p : open.positions) p *= 1e-4f;
  open = join_meshes(open, make_ball(4, {10, 0, 0}, 1));
  EXPECT_LT(1e-4 / 40, default_weld_tolerance(open));
  EXPECT_EQ(weld_vertices(open, default_weld_tolerance(open)), none_welded(open));
}

//   2-----3 5-----6      two squares, 1e-6 apart at the middle line, a border of each
//   |     | |     |
//   0-----1 4-----7
TEST(Weld, CracksAreClosed) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0},         {1, 0, 0},         {0, 1, 0}, {1, 1, 0},
                    {1.000001f, 0, 0}, {1.000001f, 1, 0}, {2, 1, 0}, {2, 0, 0}};
  mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 7, 6}, {4, 6, 5}};
  EXPECT_EQ(weld_vertices(mesh, default_weld_tolerance(mesh)),
            (std::vector<std::uint32_t>{0, 1, 2, 3, 1, 3, 6, 7}));
  std::vector<std::uint32_t> of = match_positions(mesh);
  const BorderWeld done = weld_borders(mesh.positions, mesh.triangles, {.tolerance = 2e-6}, of);
  EXPECT_EQ(done.n_welded, 2u);
  EXPECT_EQ(done.gap, double(1.000001f) - 1);
  of = match_positions(mesh);
  EXPECT_EQ(weld_borders(mesh.positions, mesh.triangles, {.tolerance = 5e-7}, of).n_welded, 0u);
}

// A quarter of the shortest edge is the most, unless it is lifted: then a triangle may be lost.
TEST(Weld, NoTriangleLosesACorner) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {0.01f, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(weld_vertices(mesh, 0.1), none_welded(mesh));
  EXPECT_EQ(weld_vertices(mesh, {0.1, std::numeric_limits<double>::infinity()}),
            (std::vector<std::uint32_t>{0, 0, 2}));
}

TEST(Weld, SizeAndOrderOfTrianglesDoNotMatter) {
  const TriMesh soup = make_noisy_soup(make_ball(8), 1e-6, 3);
  const auto of = weld_vertices(soup, default_weld_tolerance(soup));
  TriMesh other = soup;
  std::reverse(other.triangles.begin(), other.triangles.end());
  EXPECT_EQ(weld_vertices(other, default_weld_tolerance(other)), of);
  for (const float scale : {0x1p100f, 0x1p-100f}) {
    other = soup;
    for (glm::vec3& p : other.positions) p *= scale;
    EXPECT_EQ(weld_vertices(other, default_weld_tolerance(other)), of);
  }
  EXPECT_TRUE(weld_vertices(TriMesh{}, 1).empty());
}

}  // namespace
}  // namespace viewcell

#include "mesh/half_edge_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "base/error.h"
#include "base/random.h"
#include "mesh/surfaces.h"
#include "mesh/topology.h"

namespace viewcell {
namespace {

using Loops = std::vector<std::vector<std::uint32_t>>;

//   2---3
//   | / |     triangles 7 and 4; vertex 4 stands alone
//   0---1
TEST(HalfEdgeMesh, TwoTrianglesByHand) {
  HalfEdgeMesh mesh(5);
  EXPECT_TRUE(mesh.boundary_loops().empty());
  EXPECT_TRUE(mesh.add(7, {0, 1, 3}));
  EXPECT_EQ(mesh.side(0, 3), EdgeSide::open);
  EXPECT_EQ(mesh.side(3, 0), EdgeSide::taken);
  EXPECT_EQ(mesh.side(0, 2), EdgeSide::absent);
  EXPECT_FALSE(mesh.has_vertex(2));
  EXPECT_EQ(mesh.boundary_loops(), (Loops{{0, 1, 3}}));
  EXPECT_TRUE(mesh.add(4, {0, 3, 2}));
  EXPECT_EQ(mesh.side(0, 3), EdgeSide::taken);
  EXPECT_EQ(mesh.across(7, 2), 4u);
  EXPECT_EQ(mesh.across(4, 0), 7u);
  for (const auto& [triangle, k] : {std::pair{7u, 0u}, {7u, 1u}, {4u, 1u}, {4u, 2u}})
    EXPECT_EQ(mesh.across(triangle, k), HalfEdgeMesh::kNone);
  EXPECT_TRUE(mesh.has_vertex(2));
  EXPECT_FALSE(mesh.has_vertex(4));
  EXPECT_FALSE(mesh.is_boundary(4));
  EXPECT_EQ(mesh.boundary_loops(), (Loops{{0, 1, 3, 2}}));
  EXPECT_EQ(mesh.taken(), (std::vector<std::uint32_t>{7, 4}));
  EXPECT_THROW(mesh.add(4, {1, 4, 3}), BugError);
}

// What it refuses leaves it as it was, in silence.
TEST(HalfEdgeMesh, RefusesWhatIsNoManifold) {
  testing::internal::CaptureStderr();
  TriMesh wings;
  wings.positions.resize(6);
  wings.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 1, 5}, {1, 2, 4}};
  const HalfEdgeMesh mesh(wings);  // a third wing; an index twice; a second that runs from 1 to 2
  EXPECT_EQ(mesh.taken(), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(mesh.refused(), (std::vector<std::uint32_t>{2, 3, 4}));
  EXPECT_FALSE(mesh.has_vertex(4));
  EXPECT_EQ(mesh.boundary_loops(), (Loops{{0, 3, 1, 2}}));

  // A closed fan around 0, and a triangle that only touches it there: the later one is refused.
  TriMesh touched;
  touched.positions.resize(6);
  touched.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}};
  for (int turn = 0; turn < 4; ++turn) {
    const HalfEdgeMesh fan(touched);
    EXPECT_EQ(fan.refused(), (std::vector<std::uint32_t>{3}));
    EXPECT_EQ(fan.has_vertex(4), turn > 0);
    std::rotate(touched.triangles.begin(), touched.triangles.end() - 1, touched.triangles.end());
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(HalfEdgeMesh, BoundaryLoops) {
  EXPECT_TRUE(HalfEdgeMesh(make_ball(5)).boundary_loops().empty());
  TriMesh ring = make_grid(3);
  ring.triangles.erase(ring.triangles.begin() + 8, ring.triangles.begin() + 10);  // its middle
  EXPECT_EQ(HalfEdgeMesh(ring).boundary_loops(),
            (Loops{{0, 1, 2, 3, 7, 11, 15, 14, 13, 12, 8, 4}, {5, 9, 10, 6}}));
  TriMesh bow_tie;
  bow_tie.positions.resize(5);
  bow_tie.triangles = {{0, 1, 2}, {0, 3, 4}};
  const HalfEdgeMesh mesh(bow_tie);
  EXPECT_TRUE(mesh.refused().empty());
  std::size_t n = 0;
  for (const std::vector<std::uint32_t>& loop : mesh.boundary_loops()) n += loop.size();
  EXPECT_EQ(n, 6u);
}

// By comparing every pair: edges of one triangle a side; at each vertex one ring or no ring.
bool is_manifold(const TriMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> n_along;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (++n_along[{t[k], t[(k + 1) % 3]}] > 1) return false;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    std::map<std::uint32_t, std::uint32_t> next;  // around v
    for (const Triangle& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k)
        if (t[k] == v) next[t[(k + 1) % 3]] = t[(k + 2) % 3];
    for (const auto& [first, second] : next) {
      std::uint32_t at = second;
      std::size_t n = 1;
      for (; next.count(at) && at != first; ++n) at = next[at];
      if (at == first && n < next.size()) return false;
    }
  }
  return true;
}

// Random soups: takes in what it can and nothing else, and knows it then.
TEST(HalfEdgeMesh, AgreesWithComparingEveryPair) {
  std::size_t n_taken = 0, n_refused = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    HalfEdgeMesh mesh(7);
    TriMesh taken;
    taken.positions.resize(7);
    for (std::uint32_t i = 0; i < 24; ++i) {
      const Triangle t = {random.below(7), random.below(7), random.below(7)};
      const bool is_triangle = t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
      taken.triangles.push_back(t);
      const bool is_taken = mesh.add(i, t);
      EXPECT_EQ(is_taken, is_triangle && is_manifold(taken)) << i;
      if (!is_taken) taken.triangles.pop_back();
    }
    ASSERT_EQ(mesh.taken().size(), taken.triangles.size());
    n_taken += mesh.taken().size(), n_refused += mesh.refused().size();

    const auto owner = [&](std::uint32_t from, std::uint32_t to) {
      for (std::size_t i = 0; i < taken.triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
          if (taken.triangles[i][k] == from && taken.triangles[i][(k + 1) % 3] == to)
            return mesh.taken()[i];
      return HalfEdgeMesh::kNone;
    };
    for (std::size_t i = 0; i < taken.triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(mesh.across(mesh.taken()[i], k),
                  owner(taken.triangles[i][(k + 1) % 3], taken.triangles[i][k]));
    std::size_t n_boundary = 0;
    for (const std::vector<std::uint32_t>& loop : mesh.boundary_loops()) {
      EXPECT_EQ(loop[0], *std::min_element(loop.begin(), loop.end()));
      n_boundary += loop.size();
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::uint32_t from = loop[i], to = loop[(i + 1) % loop.size()];
        EXPECT_TRUE(mesh.is_boundary(from));
        EXPECT_EQ(mesh.side(from, to), EdgeSide::taken);
        EXPECT_EQ(mesh.side(to, from), EdgeSide::open);
      }
    }
    EXPECT_EQ(n_boundary, measure_topology(taken).n_boundary_edges);
  }
  EXPECT_GT(n_taken, 1000u);
  EXPECT_GT(n_refused, 1000u);
}

}  // namespace
}  // namespace viewcell

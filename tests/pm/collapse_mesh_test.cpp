#include "pm/collapse_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "base/random.h"
#include "pm/shapes.h"

namespace viewcell {
namespace {

constexpr float kAnyTurn = -1;  // no limit on how far a normal may turn

std::set<std::uint32_t> ring_of(CollapseMesh& mesh, std::uint32_t v) {
  std::vector<std::uint32_t> ring;
  mesh.ring(v, ring);
  const std::set<std::uint32_t> out(ring.begin(), ring.end());
  EXPECT_EQ(out.size(), ring.size()) << "a neighbour twice";
  return out;
}

TEST(CollapseMesh, RingIsTheNeighbours) {
  const TriMesh grid = make_flat_grid(2);
  CollapseMesh mesh(grid.positions, grid.triangles);
  EXPECT_EQ(ring_of(mesh, 4), (std::set<std::uint32_t>{0, 1, 3, 5, 7, 8}));
  EXPECT_EQ(ring_of(mesh, 0), (std::set<std::uint32_t>{1, 3, 4}));
  EXPECT_EQ(ring_of(mesh, 2), (std::set<std::uint32_t>{1, 5}));
}

TEST(CollapseMesh, TrianglesAreTheInputsUntilACollapse) {
  const TriMesh sphere = make_noisy_sphere(3, 0.1, 1);
  const CollapseMesh mesh(sphere.positions, sphere.triangles);
  EXPECT_EQ(mesh.triangles(), sphere.triangles);
  EXPECT_EQ(mesh.n_triangles(), sphere.triangles.size());
}

TEST(CollapseMesh, DropsTrianglesWithARepeatedIndex) {
  const std::vector<glm::vec3> positions(4, glm::vec3(0));
  const std::vector<Triangle> triangles{{0, 0, 1}, {0, 1, 2}, {1, 2, 1}, {3, 3, 3}, {2, 3, 3}};
  const CollapseMesh mesh(positions, triangles);
  EXPECT_EQ(mesh.triangles(), (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_FALSE(mesh.has_triangles(3));
}

//      1            collapsing 0 into 1 would fold face 0 2 3 onto face 1 2 3
//     /|\           .
//    2-+-3
//     \|/
//      0
TEST(CollapseMesh, TetrahedronCannotCollapse) {
  const TriMesh tetrahedron = make_tetrahedron();
  CollapseMesh mesh(tetrahedron.positions, tetrahedron.triangles);
  for (std::uint32_t u = 0; u < 4; ++u)
    for (std::uint32_t v = 0; v < 4; ++v)
      EXPECT_TRUE(u == v || mesh.check(u, v, kAnyTurn) == Refusal::link) << u << " " << v;
}

//       1           the three neighbours of 0 are joined with each other, but not by a face: 0 may
//      /|\          go into any, in an open mesh and in a closed one
//     / 0 \         .
//    2-----3
TEST(CollapseMesh, VertexOfThreeTrianglesMayGo) {
  const std::vector<glm::vec3> positions{{0, 0, 0}, {0, 2, 0}, {-2, -1, 0}, {2, -1, 0}, {0, 0, -3}};
  std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
  for (const bool closed : {false, true}) {
    SCOPED_TRACE(closed);
    if (closed) triangles.insert(triangles.end(), {{4, 2, 1}, {4, 3, 2}, {4, 1, 3}});
    for (std::uint32_t v = 1; v <= 3; ++v) {
      CollapseMesh mesh(positions, triangles);
      ASSERT_EQ(mesh.check(0, v, 0.2f), Refusal::none);
      mesh.collapse(0, v);
      EXPECT_EQ(normalised(mesh.triangles())[0], (Triangle{1, 2, 3}));
    }
  }
}

//        4
//      / | \        0 into 4 takes two faces; what is left has five vertices. 1 and 3, joined to
//     1--0--3       both, are the third corners of the two faces at the edge.
//      \ | /
//        5
TEST(CollapseMesh, OctahedronCollapsesOnceToABipyramid) {
  const TriMesh octahedron = make_octahedron();
  CollapseMesh mesh(octahedron.positions, octahedron.triangles);
  ASSERT_EQ(mesh.check(0, 4, 0.5f), Refusal::none);  // normals turn by acos(1 / sqrt 3)
  EXPECT_EQ(mesh.check(0, 4, 0.6f), Refusal::flip);
  EXPECT_EQ(mesh.check(0, 2, kAnyTurn), Refusal::link);  // opposite corners share no edge
  mesh.collapse(0, 4);
  EXPECT_EQ(
      normalised(mesh.triangles()),
      (std::vector<Triangle>{{1, 2, 4}, {1, 4, 5}, {1, 5, 2}, {2, 3, 4}, {2, 5, 3}, {3, 5, 4}}));
  EXPECT_FALSE(mesh.has_triangles(0));
  EXPECT_EQ(ring_of(mesh, 4), (std::set<std::uint32_t>{1, 2, 3, 5}));
}

//        2
//       / \         .
//      0---1        3 is joined to 0 and to 1, but there is no face 0 1 3: collapsing would pinch
//     / \ / \       the hole between them shut
//    4---3---5
TEST(CollapseMesh, NeighbourOfBothWithoutAFaceIsRefused) {
  const std::vector<glm::vec3> positions{{0, 0, 0},     {1, 0, 0},  {0.5f, 1, 0},
                                         {0.5f, -1, 0}, {0, -2, 0}, {1, -2, 0}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 4, 3}, {1, 3, 5}};
  CollapseMesh mesh(positions, triangles);
  EXPECT_EQ(mesh.check(0, 1, kAnyTurn), Refusal::link);
}

//   6---7---8
//   | / | / |      boundary vertices move along the boundary, not inward, nor across to another
//   3---4---5      boundary through the surface
//   | / | / |
//   0---1---2
TEST(CollapseMesh, BoundaryVerticesStayOnTheBoundary) {
  const TriMesh grid = make_flat_grid(2);
  CollapseMesh mesh(grid.positions, grid.triangles);
  EXPECT_EQ(mesh.check(1, 4, kAnyTurn), Refusal::boundary);
  EXPECT_EQ(mesh.check(1, 0, 0.2f), Refusal::none);
  EXPECT_EQ(mesh.check(1, 2, 0.2f), Refusal::none);
  EXPECT_EQ(mesh.check(4, 1, 0.2f), Refusal::none);  // inner ones may go to the boundary
  EXPECT_EQ(mesh.check(1, 5, kAnyTurn), Refusal::boundary);
  EXPECT_EQ(mesh.check(2, 1, kAnyTurn), Refusal::none);  // a corner: its one face dies
}

//    1   2
//    |\3/|          a dart whose notch is at 3, with 0 in it: seen from 1 the edge 2 3 turns its
//    back
//     \0/           .
//      4
TEST(CollapseMesh, NoFaceTurnsOver) {
  const std::vector<glm::vec3> positions{
      {0, 0.6f, 0}, {-1, 1, 0}, {1, 1, 0}, {0, 0.8f, 0}, {0, -1, 0}};
  const std::vector<Triangle> triangles{{0, 2, 3}, {0, 3, 1}, {0, 1, 4}, {0, 4, 2}};
  CollapseMesh mesh(positions, triangles);
  EXPECT_EQ(mesh.check(0, 1, 0.2f), Refusal::flip);
  EXPECT_EQ(mesh.check(0, 4, 0.2f), Refusal::none);
}

// What the definitions say, from the list of triangles; those over the same vertices count once.
struct Plain {
  std::set<std::uint32_t> ring;
  bool is_on_boundary = false;
  Plain(const std::vector<Triangle>& triangles, std::uint32_t v) {
    std::map<std::uint32_t, int> n_times;
    std::set<std::set<std::uint32_t>> met;
    for (const Triangle& t : triangles) {
      if (std::find(t.begin(), t.end(), v) == t.end()) continue;
      if (!met.insert({t.begin(), t.end()}).second) continue;
      for (const std::uint32_t w : t)
        if (w != v) ++n_times[w];
    }
    for (const auto& [w, n] : n_times) {
      ring.insert(w);
      is_on_boundary = is_on_boundary || n % 2 == 1;
    }
  }
};

// Triangles at random, as many as 40 at a vertex, some of them twice or turned round.
TEST(CollapseMesh, RingsAndBoundariesOfAnySoup) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::uint32_t n = 5 + random.below(12);
    const std::vector<glm::vec3> positions(n, glm::vec3(0));
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < 6 + 4 * (seed % 9); ++i) {
      const Triangle t{random.below(n), random.below(n), random.below(n)};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      triangles.push_back(t);
      if (random.below(3) == 0) triangles.push_back({t[1], t[0], t[2]});
      if (random.below(6) == 0) triangles.push_back(t);
    }
    CollapseMesh mesh(positions, triangles);
    for (std::uint32_t v = 0; v < n; ++v) {
      const Plain plain(triangles, v);
      EXPECT_EQ(ring_of(mesh, v), plain.ring);
      EXPECT_EQ(mesh.is_on_boundary(v), plain.is_on_boundary);
    }
  }
}

// Down to a few faces, which moves the lists of corners together several times.
TEST(CollapseMesh, StarsAreThoseOfTheTrianglesAfterManyCollapses) {
  const TriMesh sphere = make_noisy_sphere(3, 0.1, 4);
  CollapseMesh mesh(sphere.positions, sphere.triangles);
  Random random(5);
  std::vector<std::uint32_t> ring;
  int n_collapses = 0;
  for (int attempt = 0; attempt < 20000 && mesh.n_triangles() > 8; ++attempt) {
    const std::uint32_t u = random.below(static_cast<std::uint32_t>(mesh.n_vertices()));
    if (!mesh.has_triangles(u)) continue;
    mesh.ring(u, ring);
    const std::uint32_t v = ring[random.below(static_cast<std::uint32_t>(ring.size()))];
    if (mesh.check(u, v, kAnyTurn) != Refusal::none) continue;
    mesh.collapse(u, v);
    if (++n_collapses % 16 != 0) continue;
    const std::vector<Triangle> triangles = mesh.triangles();
    for (std::uint32_t w = 0; w < mesh.n_vertices(); ++w) {
      std::size_t n_corners = 0;
      mesh.for_each_corner(w, [&](std::uint32_t c) {
        EXPECT_EQ(mesh.vertex_at(c), w);
        ++n_corners;
      });
      std::size_t n_expected = 0;
      for (const Triangle& t : triangles) n_expected += std::count(t.begin(), t.end(), w);
      ASSERT_EQ(n_corners, n_expected);
      ASSERT_EQ(ring_of(mesh, w), Plain(triangles, w).ring);
    }
  }
  EXPECT_GT(n_collapses, 150);
}

TEST(CollapseMesh, NoNeedleIsMade) {
  // 0 into 1 would leave 1 2 3, which lie on a line.
  const std::vector<glm::vec3> positions{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {0, 2, 0}, {-1, -1, 0}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  CollapseMesh mesh(positions, triangles);
  EXPECT_EQ(mesh.check(0, 1, kAnyTurn), Refusal::sliver);
}

// The live mesh kept naively: u renamed to v, triangles with a repeated index dropped.
std::vector<Triangle> collapse_naively(std::vector<Triangle> triangles, std::uint32_t u,
                                       std::uint32_t v) {
  for (Triangle& t : triangles) std::replace(t.begin(), t.end(), u, v);
  std::erase_if(triangles,
                [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return triangles;
}

// A random neighbour pair that the mesh lets collapse; the test's own metric-free loop.
std::optional<std::pair<std::uint32_t, std::uint32_t>> find_legal(CollapseMesh& mesh,
                                                                  Random& random) {
  std::vector<std::uint32_t> ring;
  for (int trial = 0; trial < 200; ++trial) {
    const std::uint32_t u = random.below(static_cast<std::uint32_t>(mesh.n_vertices()));
    mesh.ring(u, ring);
    if (ring.empty()) continue;
    const std::uint32_t v = ring[random.below(static_cast<std::uint32_t>(ring.size()))];
    if (mesh.check(u, v, kAnyTurn) == Refusal::none) return std::pair{u, v};
  }
  return {};
}

TEST(CollapseMesh, RandomCollapsesKeepAClosedManifold) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const TriMesh sphere = make_noisy_sphere(2, 0.3, seed);  // 128 triangles
    CollapseMesh mesh(sphere.positions, sphere.triangles);
    std::vector<Triangle> expected = sphere.triangles;
    while (const auto edge = find_legal(mesh, random)) {
      mesh.collapse(edge->first, edge->second);
      expected = collapse_naively(std::move(expected), edge->first, edge->second);
      ASSERT_EQ(mesh.triangles(), expected);
      ASSERT_EQ(mesh.n_triangles(), expected.size());
      ASSERT_TRUE(is_closed_manifold(expected));
      ASSERT_EQ(euler_characteristic(expected), 2);
    }
    EXPECT_LT(mesh.n_triangles(), 40u);
  }
}

// A torus may not lose its hole.
TEST(CollapseMesh, RandomCollapsesKeepTheGenus) {
  constexpr std::uint32_t n = 8;
  TriMesh torus;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const double a = 2 * 3.14159265 * i / n, b = 2 * 3.14159265 * j / n;
      const double r = 3 + std::cos(b);
      torus.positions.emplace_back(r * std::cos(a), r * std::sin(a), std::sin(b));
      const auto at = [](std::uint32_t p, std::uint32_t q) { return p % n * n + q % n; };
      torus.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      torus.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    CollapseMesh mesh(torus.positions, torus.triangles);
    while (const auto edge = find_legal(mesh, random)) mesh.collapse(edge->first, edge->second);
    EXPECT_TRUE(is_closed_manifold(mesh.triangles()));
    EXPECT_EQ(euler_characteristic(mesh.triangles()), 0);
    EXPECT_LT(mesh.n_triangles(), 100u);
  }
}

TEST(CollapseMesh, RandomCollapsesKeepADiscADisc) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriMesh grid = make_flat_grid(8);
    for (glm::vec3& p : grid.positions) p.z = static_cast<float>(random.uniform(0, 0.5));
    CollapseMesh mesh(grid.positions, grid.triangles);
    while (mesh.n_triangles() > 1) {
      const auto edge = find_legal(mesh, random);
      if (!edge) break;
      mesh.collapse(edge->first, edge->second);
      ASSERT_EQ(euler_characteristic(mesh.triangles()), 1);
    }
    EXPECT_LT(mesh.n_triangles(), 10u);
  }
}

// Random triangles: edges with one to many of them, duplicates, bow ties. Nothing is promised but
// that the books stay right.
TEST(CollapseMesh, SurvivesNonManifoldInput) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<glm::vec3> positions(30);
    for (glm::vec3& p : positions)
      p = {random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
    std::vector<Triangle> triangles(80);
    for (Triangle& t : triangles) t = {random.below(30), random.below(30), random.below(30)};
    CollapseMesh mesh(positions, triangles);
    std::vector<Triangle> expected = collapse_naively(triangles, 0, 0);
    ASSERT_EQ(mesh.triangles(), expected);
    while (const auto edge = find_legal(mesh, random)) {
      mesh.collapse(edge->first, edge->second);
      expected = collapse_naively(std::move(expected), edge->first, edge->second);
      ASSERT_EQ(mesh.triangles(), expected);
    }
  }
}

//   3---4---5      0 4 is inside, but joins two boundary vertices: collapsing it would pinch
//   | / | / |
//   0---1---2
TEST(CollapseMesh, FullEdgesDoNotPinch) {
  const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {2, 0, 0},
                                         {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  const std::vector<Triangle> triangles{{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  CollapseMesh mesh(positions, triangles);
  EXPECT_EQ(mesh.check(0, 4, {0.5f, 0.5f, 0}, kAnyTurn), Refusal::boundary);
  EXPECT_EQ(mesh.check(1, 2, {1.5f, 0, 0}, kAnyTurn), Refusal::none);
}

// The triangles of both ends are looked at: above the middle all stand upright enough; below the
// grid those of one end only turn over.
TEST(CollapseMesh, FullEdgesTurnNoTriangleOfEitherEnd) {
  const TriMesh grid = make_flat_grid(6);
  CollapseMesh mesh(grid.positions, grid.triangles);
  EXPECT_EQ(mesh.check(23, 24, {2.5f, 3, 0}, 0.2f), Refusal::none);
  EXPECT_EQ(mesh.check(23, 24, {0.5f, 3, 0}, 0.2f), Refusal::flip);  // left of 23's neighbours
  EXPECT_EQ(mesh.check(23, 24, {4.5f, 3, 0}, 0.2f), Refusal::flip);  // right of 24's
  EXPECT_EQ(mesh.check(24, 23, {0.5f, 3, 0}, 0.2f), Refusal::flip);
  EXPECT_EQ(mesh.check(24, 23, {4.5f, 3, 0}, 0.2f), Refusal::flip);
}

TEST(Refusal, EveryKindHasAName) {
  std::set<std::string> names;
  for (int i = 0; i < kRefusalKinds; ++i) names.insert(refusal_name(static_cast<Refusal>(i)));
  EXPECT_EQ(names, (std::set<std::string>{"none", "link", "boundary", "flip", "sliver", "chart",
                                          "fold", "overlap", "bound", "metric"}));
}

}  // namespace
}  // namespace viewcell

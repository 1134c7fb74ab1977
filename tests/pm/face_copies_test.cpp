// Faces that lie on one another: the two sides of a sheet, and faces that a file has twice.
#include "pm/face_copies.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "pm/build.h"
#include "pm/shapes.h"
#include "pm/simplify.h"
#include "pm/ways.h"

namespace viewcell {
namespace {

TEST(FaceCopies, AreOverTheSameThreeVertices) {
  const std::vector<Triangle> faces{{0, 1, 2}, {1, 2, 3}, {2, 1, 0},
                                    {1, 1, 2}, {3, 1, 2}, {2, 0, 1}};
  const FaceCopies copies = find_face_copies(faces, 4);
  EXPECT_EQ(copies.is_copy, (std::vector<bool>{false, false, true, false, true, true}));
  EXPECT_EQ(copies.next, (std::vector<std::uint32_t>{2, 4, 5, kNoCopy, kNoCopy, kNoCopy}));
  EXPECT_EQ(without_copies(faces, copies)[2], (Triangle{2, 2, 2}));
  EXPECT_TRUE(find_face_copies(make_octahedron().triangles, 6).empty());
}

TEST(FaceCopies, AreFoundAroundVerticesOfManyFaces) {
  std::vector<Triangle> fan;
  for (std::uint32_t i = 0; i < 100; ++i) fan.push_back({0, i + 1, i + 2});
  fan.push_back({58, 0, 57});
  const FaceCopies copies = find_face_copies(fan, 102);
  EXPECT_EQ(std::count(copies.is_copy.begin(), copies.is_copy.end(), true), 1);
  EXPECT_EQ(copies.next[56], 100u);
}

// The first `n_doubled` faces have a face of the opposite turn, with texture coordinates `shift`
// beside theirs.
TriMesh make_two_sided(TriMesh mesh, std::size_t n_doubled, float shift = 0) {
  for (std::size_t t = 0; t < n_doubled; ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    mesh.triangles.push_back({a, c, b});
    for (const std::size_t k : {0u, 2u, 1u})
      if (!mesh.texcoords.empty()) mesh.texcoords.push_back(mesh.texcoords[3 * t + k] + shift);
  }
  return mesh;
}

// Quads cut from their first corner on, from either side: the back's diagonals are the others.
TEST(FaceCopies, SheetsWhoseBacksAreCutTheOtherWay) {
  constexpr std::uint32_t n = 12;
  TriMesh sheet = make_flat_grid(n);
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 2, d = a + n + 1;
      sheet.triangles.insert(sheet.triangles.end(), {{d, c, b}, {d, b, a}});
    }
  for (const Way& way : kWays) {
    if (texture_needs(options_of(way)).coordinates) continue;
    SCOPED_TRACE(testing::Message() << metric_name(way.metric) << placement_name(way.placement));
    const BuildResult built = build_progressive_mesh(sheet, options_of(way));
    EXPECT_EQ(built.n_recut, 2 * n * n);
    ProgressiveMesh pm(built.record);
    pm.set_faces(40);
    ASSERT_LE(pm.n_faces(), 40u);
    double area = 0;
    const TriMesh left = pm.extract();
    for (const Triangle& t : left.triangles) area += 0.5 * glm::length(area_normal(left, t));
    EXPECT_NEAR(area, 2 * n * n, 1e-3);  // both sides, up to their border
  }
}

TriMesh without_texture(TriMesh mesh) {
  mesh.texcoords.clear();
  return mesh;
}

// What the collapses of a sheet are does not depend on how many faces it has on one another.
TEST(FaceCopies, SheetsCollapseAsWithOneSide) {
  for (const Way& way : kWays)
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(testing::Message()
                   << metric_name(way.metric) << placement_name(way.placement) << " seed " << seed);
      const TriMesh one = make_relief(seed), two = make_two_sided(one, one.triangles.size());
      const ProgressiveRecord a = build_progressive_mesh(one, options_of(way)).record;
      const ProgressiveRecord b = build_progressive_mesh(two, options_of(way)).record;
      EXPECT_EQ(check_record(b), "");
      ASSERT_EQ(a.splits.size(), b.splits.size());
      for (std::size_t i = 0; i < a.splits.size(); ++i) {
        EXPECT_EQ(a.splits[i].child, b.splits[i].child);
        EXPECT_EQ(a.splits[i].parent, b.splits[i].parent);
        EXPECT_EQ(2 * a.splits[i].n_born, b.splits[i].n_born);
      }
      ProgressiveMesh sheet(a), both(b);
      for (const std::size_t n : {98u, 60u, 30u, 10u, 1u}) {
        sheet.set_faces(n), both.set_faces(2 * n);
        const TriMesh left = both.extract();
        EXPECT_EQ(left.positions, sheet.extract().positions);
        EXPECT_EQ(left.triangles.size(), 2 * sheet.n_faces());
        EXPECT_GT(left.triangles.size(), 0u);
      }
      both.set_level(both.n_splits());
      EXPECT_EQ(both.extract().triangles, two.triangles);
      EXPECT_EQ(both.extract().texcoords, two.texcoords);
    }
}

// The back in another part of the texture: metrics that look at space alone do not care.
TEST(FaceCopies, BacksMayHaveTextureOfTheirOwn) {
  for (const Way& way : kWays) {
    SCOPED_TRACE(testing::Message() << metric_name(way.metric) << placement_name(way.placement));
    const TriMesh one = make_relief(4), two = make_two_sided(one, one.triangles.size(), 20);
    const ProgressiveRecord a = build_progressive_mesh(one, options_of(way)).record;
    const ProgressiveRecord b = build_progressive_mesh(two, options_of(way)).record;
    EXPECT_EQ(check_record(b), "");
    if (!texture_needs(options_of(way)).no_folds) {
      EXPECT_EQ(a.splits.size(), b.splits.size());
    }
    ProgressiveMesh pm(b);
    EXPECT_LT(pm.n_faces(), 30u);
    for (const glm::vec2& uv : pm.extract().texcoords) EXPECT_TRUE(uv.x < 12 || uv.x > 15);
    pm.set_level(pm.n_splits());
    EXPECT_EQ(pm.extract().texcoords, two.texcoords);
  }
}

// Where a part has two sides and the rest one, the border between them is no border.
TEST(FaceCopies, PartlyDoubledMeshes) {
  for (const Way& way : std::span(kWays).first(3)) {
    const TriMesh one = without_texture(make_relief(5));
    const BuildResult a = build_progressive_mesh(one, options_of(way));
    const BuildResult b = build_progressive_mesh(make_two_sided(one, 40), options_of(way));
    ASSERT_EQ(a.record.splits.size(), b.record.splits.size());
    for (std::size_t i = 0; i < a.record.splits.size(); ++i)
      EXPECT_EQ(a.record.splits[i].cost, b.record.splits[i].cost);
  }
}

TEST(FaceCopies, FacesTwiceInOneTurnCountOnce) {
  TriMesh sphere = make_noisy_sphere(3, 0.1, 6), twice = sphere;
  twice.triangles.insert(twice.triangles.end(), sphere.triangles.begin(), sphere.triangles.end());
  const SimplifyResult a = simplify(sphere, {.target_triangles = 100});
  const SimplifyResult b = simplify(twice, {.target_triangles = 200});
  EXPECT_EQ(b.mesh.triangles.size(), 200u);
  EXPECT_EQ(a.source_vertex, b.source_vertex);
  EXPECT_EQ(a.counts.n_collapses, b.counts.n_collapses);
}

TEST(FaceCopies, NoMeshIsSimplifiedToNothing) {
  TriMesh one;
  one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.triangles = {{0, 1, 2}};
  for (const TriMesh& mesh : {one, make_two_sided(one, 1)})
    for (const Way& way : std::span(kWays).first(3)) {
      const ProgressiveRecord record = build_progressive_mesh(mesh, options_of(way)).record;
      EXPECT_TRUE(record.splits.empty());
      EXPECT_EQ(record.faces.size(), mesh.triangles.size());
    }
  EXPECT_EQ(simplify(make_two_sided(one, 1), {.target_triangles = 1}).mesh.triangles.size(), 2u);
}

}  // namespace
}  // namespace viewcell

#include "pm/collapse_map.h"

#include <gtest/gtest.h>

#include "pm/deviation_boxes.h"
#include "pm/parts.h"

namespace viewcell {
namespace {

//   far---2      u collapses into v and its only triangle vanishes; the one across the edge that is
//   / \  /       left takes it, keeps what it had, and takes nothing else's
//  u---v
TEST(CollapseMap, ALoneTriangleHasAnHeir) {
  for (const bool is_first : {false, true}) {
    TriMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1.5f, 1, 0}, {0.5f, 1, 0}};  // u, v, 2, far
    const Triangle lone{0, 1, 3}, other{1, 2, 3};
    mesh.triangles = is_first ? std::vector{lone, other} : std::vector{other, lone};
    const std::uint32_t heir = is_first ? 1 : 0;
    Parts parts(mesh);
    CollapseMap map(parts.mesh, parts.table, parts.wedges.positions, {}, Matching::nearest);
    DeviationBoxes boxes(2);
    const VectorBox had{Float4{0, 0, -3, 0}, Float4{0, 0, 2, 0}};
    DeviationBoxes::Change change;
    change.faces = {{heir, had}};
    boxes.accept(change);
    change.clear();
    ASSERT_TRUE(map.build(0, 1));
    boxes.add(map, change);
    ASSERT_EQ(change.faces.size(), 1u);
    EXPECT_EQ(change.faces[0].face, heir);
    const VectorBox& box = change.faces[0].box;
    EXPECT_FLOAT_EQ(box.lo[2], -3);
    EXPECT_FLOAT_EQ(box.hi[2], 2);
    // u goes to the nearest point of the edge v-far, (0.8, 0.4)
    EXPECT_NEAR(box.lo[0], -0.8, 1e-5);
    EXPECT_NEAR(box.lo[1], -0.4, 1e-5);
    EXPECT_NEAR(box.hi[0], 0, 1e-5);
    boxes.accept(change);
    EXPECT_GE(boxes.bound(), 3);
    EXPECT_EQ(parts.mesh.check(0, 1, 0.2f), Refusal::none);
  }
}

// The cells of a moved vertex take up the whole star before, whichever way it moves.
TEST(CollapseMap, MovedCellsCoverTheStar) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriMesh fan = make_fan(3 + random.below(6), 0.1, 0, random);
    const bool is_open = seed % 3 == 0;
    if (is_open) fan.triangles.pop_back(), fan.texcoords.resize(3 * fan.triangles.size());
    Parts parts(fan);
    CollapseMap map(parts.mesh, parts.table, parts.wedges.positions, {}, Matching::nearest,
                    {.moments = true});
    const double angle = random.uniform(0, 6.28), radius = random.uniform(0, 0.35);
    const glm::dvec3 to =
        glm::dvec3(fan.positions[0]) + radius * glm::dvec3(std::cos(angle), std::sin(angle), 0);
    ASSERT_TRUE(map.build_move(0, to));
    std::vector<double> covered(fan.triangles.size(), 0);
    for (std::size_t i = 0; i < map.overlay().cells().size(); ++i)
      covered[map.faces()[map.overlay().cells()[i].old_face]] += map.overlay().moments()[i].area;
    for (std::size_t f = 0; f < fan.triangles.size(); ++f) {
      const double area = glm::length(area_normal(fan, fan.triangles[f])) / 2;
      EXPECT_GE(covered[f], area - 1e-5) << f;
      EXPECT_LE(covered[f], is_open ? 1e30 : area + 1e-5) << f;
    }
    if (is_open) continue;
    EXPECT_NEAR(map.overlay().largest_shift(), 0, 1e-7);
  }
}

// The parts of an old face that the cells take make up the face.
TEST(CollapseMap, CellsCoverTheStar) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const TriMesh fan = make_fan(4 + random.below(6), 0.1, 0, random);
    const std::uint32_t v = 1 + random.below(static_cast<std::uint32_t>(fan.positions.size() - 1));
    Parts parts(fan);
    CollapseMap map(parts.mesh, parts.table, parts.wedges.positions, parts.wedges.texcoords,
                    Matching::texture, {.moments = true});
    ASSERT_TRUE(map.build(0, v));
    if (parts.turns_over(0, v)) continue;
    std::vector<double> covered(fan.triangles.size(), 0);
    for (std::size_t i = 0; i < map.overlay().cells().size(); ++i)
      covered[map.faces()[map.overlay().cells()[i].old_face]] += map.overlay().moments()[i].area;
    for (std::size_t f = 0; f < fan.triangles.size(); ++f)
      EXPECT_NEAR(covered[f], glm::length(area_normal(fan, fan.triangles[f])) / 2, 1e-5) << f;
  }
}

}  // namespace
}  // namespace viewcell

#include "cells/odd_sizes.h"

#include <gtest/gtest.h>

#include "cells/small_scene.h"

namespace viewcell {
namespace {

// Boxes of side 2 in an area of 1000, each scaled so.
std::vector<std::string> hints_of(const std::vector<double>& scales, double x = 500) {
  Scene scene =
      make_box_scene({{0, 0}, {1000, 1000}}, std::vector<glm::dvec3>(scales.size(), {x, 500, 0}));
  scene.meshes[0].file = "box.ply";
  for (std::size_t i = 0; i < scales.size(); ++i) scene.objects[i].scale = scales[i];
  return find_odd_sizes(scene, 50);
}

TEST(OddSizes, StatuesAndHallsAreNone) {
  for (const double scale : {1.8, 5.0, 20.0, 100.0, 230.0})
    EXPECT_TRUE(hints_of({scale}).empty()) << scale;
}

TEST(OddSizes, OtherUnitsAreSaidOnceWithTheirFigures) {
  EXPECT_EQ(hints_of({20, 20000, 30000}),
            std::vector<std::string>{"object 1 ('box 1', of box.ply) is 40000 units large, 1000 "
                                     "times more than what suits cells of size 50, and so are 1 "
                                     "more: is its mesh's \"scale\" right?"});
  EXPECT_EQ(hints_of({0.02}),
            std::vector<std::string>{"object 0 ('box 0', of box.ply) is 0.04 units large, 1000 "
                                     "times less than what suits cells of size 50: is its mesh's "
                                     "\"scale\" right?"});
  EXPECT_EQ(hints_of({0.02, 20000}).size(), 2u);
  EXPECT_EQ(hints_of({1.0}).size(), 1u);  // 20 times too small, as a model of 2 units is
}

TEST(OddSizes, OutsideTheArea) {
  EXPECT_TRUE(hints_of({20}, 1015).empty());  // reaches in
  ASSERT_EQ(hints_of({20}, 1025).size(), 1u);
  EXPECT_TRUE(hints_of({20}, 1025)[0].starts_with("object 0 ('box 0', of box.ply) stands outside"));
}

}  // namespace
}  // namespace viewcell

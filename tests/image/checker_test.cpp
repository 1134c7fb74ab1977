#include "image/checker.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace viewcell {
namespace {

// Four by four squares of three pixels:   L D U D     v
//                                         D L D U     ^
//                                         L D R D     |
//                                         D L D R     +--> u, row 1 and 2 from below are the middle
TEST(Checker, SquaresAndMarks) {
  const ImageRgba8 image = make_checker(12, 4);
  ASSERT_EQ(image.width_px, 12);
  ASSERT_EQ(image.height_px, 12);
  const auto square = [&](int column, int row) { return image.at(3 * column + 1, 10 - 3 * row); };
  const Rgba8 dark = square(0, 0), light = square(0, 3);
  EXPECT_LT(dark[0], 80);
  EXPECT_GT(light[0], 200);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const Rgba8 color = square(column, row);
      EXPECT_EQ(color == dark, (row + column) % 2 == 0);
      EXPECT_EQ(color[3], 255);
      for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) EXPECT_EQ(image.at(3 * column + x, 11 - 3 * row - y), color);
    }
  const auto is_red = [](const Rgba8& c) { return c[0] > 2 * c[1]; };
  const auto is_green = [](const Rgba8& c) { return c[1] > 2 * c[0]; };
  EXPECT_TRUE(is_red(square(3, 2)));
  EXPECT_TRUE(is_red(square(2, 1)));
  EXPECT_TRUE(is_green(square(2, 3)));
  EXPECT_EQ(square(0, 1), light);
  EXPECT_EQ(square(3, 0), light);
}

TEST(Checker, AnySize) {
  for (int size = 2; size < 20; ++size)
    for (int n = 2; n <= size; ++n) {
      const ImageRgba8 image = make_checker(size, n);
      int n_changes = 0;
      for (int x = 1; x < size; ++x) n_changes += image.at(x, 0) != image.at(x - 1, 0);
      EXPECT_EQ(n_changes, n - 1);
    }
  EXPECT_THROW(make_checker(10, 11), BugError);
  EXPECT_THROW(make_checker(10, 1), BugError);
}

}  // namespace
}  // namespace viewcell

#include "uv/gutter.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace viewcell {
namespace {

// By comparing every pair.
std::uint32_t nearest_of_all(const Image<std::uint8_t>& is_owned, int x, int y, int reach) {
  auto best = static_cast<std::uint32_t>(is_owned.offset(x, y));
  long best_squared = static_cast<long>(reach) * reach + 1;
  for (int row = 0; row < is_owned.height_px; ++row)
    for (int column = 0; column < is_owned.width_px; ++column) {
      const long dx = column - x, dy = row - y, squared = dx * dx + dy * dy;
      if (!is_owned.at(column, row) || squared >= best_squared) continue;
      best = static_cast<std::uint32_t>(is_owned.offset(column, row)), best_squared = squared;
    }
  return best;
}

TEST(Gutter, AgreesWithComparingEveryPair) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Image<std::uint8_t> is_owned(1 + static_cast<int>(random.below(20)),
                                 1 + static_cast<int>(random.below(20)));
    const std::uint32_t share = 2 + random.below(40);
    for (std::uint8_t& owned : is_owned.pixels) owned = random.below(share) == 0;
    const int reach = seed % 2 ? 100 : 1 + static_cast<int>(random.below(6));
    const Image<std::uint32_t> found = nearest_owned_texels(is_owned, reach, 1);
    for (int y = 0; y < is_owned.height_px; ++y)
      for (int x = 0; x < is_owned.width_px; ++x)
        ASSERT_EQ(found.at(x, y), nearest_of_all(is_owned, x, y, reach)) << x << " " << y;
    EXPECT_EQ(nearest_owned_texels(is_owned, reach, 4).pixels, found.pixels);
  }
}

//  . . . .      b b d d
//  . b . d  ->  b b d d      reach 1: the corners stay
//  . . . .      b b d d
TEST(Gutter, CopiesPixels) {
  Image<std::uint8_t> is_owned(4, 3);
  Image<char> image(4, 3, '.');
  is_owned.at(1, 1) = is_owned.at(3, 1) = 1;
  image.at(1, 1) = 'b', image.at(3, 1) = 'd';
  Image<char> near = image;
  copy_into_gutter(near, nearest_owned_texels(is_owned, 1));
  EXPECT_EQ(std::string(near.pixels.begin(), near.pixels.end()), ".b.dbbbd.b.d");
  copy_into_gutter(image, nearest_owned_texels(is_owned));
  EXPECT_EQ(std::string(image.pixels.begin(), image.pixels.end()), "bbbdbbbdbbbd");
}

TEST(Gutter, WithoutOwnersStays) {
  const Image<std::uint32_t> found = nearest_owned_texels(Image<std::uint8_t>(3, 2));
  for (std::uint32_t i = 0; i < 6; ++i) EXPECT_EQ(found.pixels[i], i);
}

}  // namespace
}  // namespace viewcell

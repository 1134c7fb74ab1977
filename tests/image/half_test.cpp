#include "image/half.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"

namespace viewcell {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Half, KnownValues) {
  EXPECT_EQ(half_from_float(0.f), 0x0000);
  EXPECT_EQ(half_from_float(-0.f), 0x8000);
  EXPECT_EQ(half_from_float(1.f), 0x3c00);
  EXPECT_EQ(half_from_float(-2.f), 0xc000);
  EXPECT_EQ(half_from_float(65504.f), 0x7bff);
  EXPECT_EQ(half_from_float(0x1p-14f), 0x0400);  // least normal
  EXPECT_EQ(half_from_float(0x1p-24f), 0x0001);  // least subnormal
  EXPECT_EQ(half_from_float(0x1p-25f), 0x0000);  // a tie goes to even
  EXPECT_EQ(half_from_float(0x1.8p-24f), 0x0002);
  EXPECT_EQ(half_from_float(0x1.ffcp-15f), 0x0400);  // a tie, up into the normal numbers
  EXPECT_EQ(half_from_float(1.f + 0x1p-11f), 0x3c00);
  EXPECT_EQ(half_from_float(1.f + 0x1.8p-10f), 0x3c02);
}

TEST(Half, NothingBecomesInfiniteOrNan) {
  EXPECT_EQ(half_from_float(65519.f), 0x7bff);
  EXPECT_EQ(half_from_float(65520.f), 0x7bff);
  EXPECT_EQ(half_from_float(1e30f), 0x7bff);
  EXPECT_EQ(half_from_float(kInfinity), 0x7bff);
  EXPECT_EQ(half_from_float(-kInfinity), 0xfbff);
  EXPECT_EQ(half_from_float(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(Half, EveryFiniteHalfComesBackAndOthersAreTold) {
  for (std::uint32_t h = 0; h < 65536; ++h) {
    const auto half = static_cast<std::uint16_t>(h);
    ASSERT_EQ(is_finite_half(half), std::isfinite(float_from_half(half))) << h;
    if (is_finite_half(half)) {
      ASSERT_EQ(half_from_float(float_from_half(half)), half) << h;
    }
  }
}

// The law of rounding: no neighbour is nearer, and of two as near the even one is taken.
TEST(Half, RoundsToTheNearest) {
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    Random random(seed);
    const auto x =
        static_cast<float>(std::ldexp(random.uniform(-1, 1), -26 + int(random.below(42))));
    const std::uint16_t half = half_from_float(x);
    const double error = std::abs(double{float_from_half(half)} - x);
    for (const int step : {-1, 1}) {
      const auto neighbour = static_cast<std::uint16_t>(half + step);
      if ((neighbour & 0x8000) != (half & 0x8000) || !is_finite_half(neighbour)) continue;
      const double other = std::abs(double{float_from_half(neighbour)} - x);
      EXPECT_TRUE(error < other || (error == other && half % 2 == 0)) << "seed " << seed;
    }
  }
}

TEST(Half, ImagesRoundTrip) {
  ImageRgbaFloat image(3, 2);
  for (std::size_t p = 0; p < 6; ++p)
    for (std::size_t c = 0; c < 4; ++c) image.pixels[p][c] = 0.25f * static_cast<float>(4 * p + c);
  EXPECT_EQ(rgba_from_half(half_from_rgba(image), 3, 2).pixels, image.pixels);
}

}  // namespace
}  // namespace viewcell

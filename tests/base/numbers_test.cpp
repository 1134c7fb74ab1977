// Curves and random numbers.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "base/srgb.h"

namespace viewcell {
namespace {

TEST(Srgb, All256CodesComeBack) {
  for (int code = 0; code < 256; ++code) {
    const float linear = srgb_decode(static_cast<float>(code) / 255);
    EXPECT_EQ(srgb8_from_linear(linear), code);
    EXPECT_NEAR(srgb_encode(linear) * 255, code, 1e-4);
  }
}

TEST(Srgb, KnownValues) {
  EXPECT_FLOAT_EQ(srgb_decode(0.5f), 0.21404114f);
  EXPECT_FLOAT_EQ(srgb_encode(0.5f), 0.73535698f);
  EXPECT_FLOAT_EQ(srgb_encode(0.001f), 0.01292f);  // on the line
  EXPECT_EQ(srgb8_from_linear(0.5f), 188);
  EXPECT_EQ(srgb_encode(1), 1.0f);
  EXPECT_EQ(srgb_decode(1), 1.0f);
}

TEST(Srgb, ClampsAndMapsNanToZero) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto curve : {srgb_encode, srgb_decode}) {
    EXPECT_EQ(curve(-1), 0.0f);
    EXPECT_EQ(curve(2), 1.0f);
    EXPECT_EQ(curve(inf), 1.0f);
    EXPECT_EQ(curve(-inf), 0.0f);
    EXPECT_EQ(curve(nan), 0.0f);
  }
  EXPECT_EQ(srgb8_from_linear(nan), 0);
  EXPECT_EQ(srgb8_from_linear(inf), 255);
}

TEST(Srgb, Rises) {
  for (int i = 0; i < 4096; ++i) {
    const float a = static_cast<float>(i) / 4096, b = static_cast<float>(i + 1) / 4096;
    EXPECT_LT(srgb_encode(a), srgb_encode(b));
    EXPECT_LT(srgb_decode(a), srgb_decode(b));
    EXPECT_LE(srgb8_from_linear(a), srgb8_from_linear(b));
  }
}

// The reference implementation's first outputs for seed 1234567.
TEST(Random, IsSplitMix64) {
  Random random(1234567);
  for (const std::uint64_t expected :
       {6457827717110365317u, 3203168211198807973u, 9817491932198370423u})
    EXPECT_EQ(random.next(), expected);
}

TEST(Random, UniformStaysInRange) {
  Random random(1);
  double sum = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = random.uniform();
    ASSERT_GE(x, 0);
    ASSERT_LT(x, 1);
    sum += x;
    const double y = random.uniform(-3, 5);
    ASSERT_GE(y, -3);
    ASSERT_LE(y, 5);
  }
  EXPECT_NEAR(sum / 20000, 0.5, 0.01);
}

TEST(Random, BelowIsEven) {
  Random random(2);
  std::array<int, 7> counts{};
  for (int i = 0; i < 70000; ++i) ++counts.at(random.below(7));
  for (const int count : counts) EXPECT_NEAR(count, 10000, 500);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(random.below(1), 0u);
}

}  // namespace
}  // namespace viewcell

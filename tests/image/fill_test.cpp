#include "image/fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "base/random.h"

namespace viewcell {
namespace {

struct Case {
  int width_px, height_px, n_channels;
  std::vector<float> samples;
  std::vector<std::uint8_t> mask;
};

Case random_case(std::uint64_t seed) {
  Random random(seed);
  Case c{1 + static_cast<int>(random.below(40)),
         1 + static_cast<int>(random.below(40)),
         1 + static_cast<int>(random.below(5)),
         {},
         {}};
  const auto n = static_cast<std::size_t>(c.width_px * c.height_px);
  const std::uint32_t sparsity = 1 + random.below(60);
  for (std::size_t p = 0; p < n; ++p) c.mask.push_back(random.below(sparsity) == 0 ? 255 : 0);
  c.mask[random.below(static_cast<std::uint32_t>(n))] = 1;
  for (std::size_t i = 0; i < n * static_cast<std::size_t>(c.n_channels); ++i)
    c.samples.push_back(static_cast<float>(random.uniform(-3, 5)));
  return c;
}

void fill(Case& c) {
  push_pull_fill(c.samples, c.width_px, c.height_px, c.n_channels, c.mask);
}

// By hand:   2 . . 6    pulls to   2 6  , full, so the gaps are pushed from it:
//            x = 1 is 3/4 of 2 and 1/4 of 6, x = 2 the other way round.
TEST(PushPull, OneRowByHand) {
  std::vector<float> row = {2, -9, -9, 6};
  push_pull_fill(row, 4, 1, 1, std::vector<std::uint8_t>{1, 0, 0, 1});
  EXPECT_EQ(row, (std::vector<float>{2, 3, 5, 6}));
}

TEST(PushPull, OneMaskedPixelFillsAll) {
  std::vector<float> samples(7 * 5 * 2, 0.f);
  std::vector<std::uint8_t> mask(7 * 5, 0);
  mask[17] = 1;
  samples[34] = 0.3f, samples[35] = -8.f;
  push_pull_fill(samples, 7, 5, 2, mask);
  for (std::size_t p = 0; p < mask.size(); ++p) {
    EXPECT_FLOAT_EQ(samples[2 * p], 0.3f);
    EXPECT_FLOAT_EQ(samples[2 * p + 1], -8.f);
  }
}

TEST(PushPull, NothingMaskedLeavesZerosAndAllMaskedLeavesAll) {
  std::vector<float> samples(60, 0.f);
  push_pull_fill(samples, 5, 4, 3, std::vector<std::uint8_t>(20, 0));
  EXPECT_EQ(samples, std::vector<float>(60, 0.f));
  Case c = random_case(1);
  std::fill(c.mask.begin(), c.mask.end(), 1);
  const std::vector<float> before = c.samples;
  fill(c);
  EXPECT_EQ(c.samples, before);
}

TEST(PushPull, MaskedPixelsKeepTheirBitsAndOthersLieBetween) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Case c = random_case(seed);
    const std::vector<float> before = c.samples;
    const auto stride = static_cast<std::size_t>(c.n_channels);
    std::vector<float> least(stride, 1e30f), most(stride, -1e30f);
    for (std::size_t i = 0; i < before.size(); ++i)
      if (c.mask[i / stride]) {
        least[i % stride] = std::min(least[i % stride], before[i]);
        most[i % stride] = std::max(most[i % stride], before[i]);
      }
    fill(c);
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (c.mask[i / stride]) {
        ASSERT_EQ(std::memcmp(&c.samples[i], &before[i], sizeof(float)), 0);
      } else {
        ASSERT_GE(c.samples[i], least[i % stride] - 2e-6f);
        ASSERT_LE(c.samples[i], most[i % stride] + 2e-6f);
      }
    }
  }
}

TEST(PushPull, WhatLiesUnderTheGapsDoesNotMatter) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Case a = random_case(seed), b = a;
    for (std::size_t i = 0; i < b.samples.size(); ++i)
      if (!b.mask[i / static_cast<std::size_t>(b.n_channels)]) b.samples[i] = NAN;
    fill(a);
    fill(b);
    EXPECT_EQ(a.samples, b.samples);
  }
}

// Near a straight edge of the mask the fill continues what is beside it, not the far average.
TEST(PushPull, FillsFromTheNearSide) {
  constexpr int n = 64;
  std::vector<float> samples(n * n, 0.f);
  std::vector<std::uint8_t> mask(n * n, 0);
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < 8; ++x) mask[static_cast<std::size_t>(y * n + x)] = 1;
    for (int x = n - 8; x < n; ++x) {
      mask[static_cast<std::size_t>(y * n + x)] = 1;
      samples[static_cast<std::size_t>(y * n + x)] = 1;
    }
  }
  push_pull_fill(samples, n, n, 1, mask);
  for (int y = 0; y < n; ++y) {
    const float* row = &samples[static_cast<std::size_t>(y * n)];
    EXPECT_LT(row[9], 0.1f);
    EXPECT_GT(row[n - 10], 0.9f);
    for (int x = 1; x < n; ++x) EXPECT_GE(row[x] - row[x - 1], -1e-6f);
  }
}

TEST(PushPull, ColourAndDepthTogether) {
  ImageRgbaFloat color(6, 3, {0, 0, 0, 0});
  Image<float> depth(6, 3, 0.f);
  color.at(2, 1) = {0.5f, 0.25f, 0.125f, 1};
  depth.at(2, 1) = 0.01f;
  push_pull_fill(color, depth);
  EXPECT_EQ(color.at(5, 2), (RgbaFloat{0.5f, 0.25f, 0.125f, 0}));
  EXPECT_EQ(color.at(2, 1), (RgbaFloat{0.5f, 0.25f, 0.125f, 1}));
  EXPECT_FLOAT_EQ(depth.at(0, 0), 0.01f);
}

}  // namespace
}  // namespace viewcell

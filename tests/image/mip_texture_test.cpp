#include "image/mip_texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "base/srgb.h"
#include "image/random_image.h"

namespace viewcell {
namespace {

// A row of four texels: 0, 1/3, 2/3 and 1 in code.
MipTexture make_ramp(Wrap wrap) {
  static const std::vector<ImageRgba8> levels = [] {
    ImageRgba8 image(4, 1);
    for (int x = 0; x < 4; ++x) {
      const auto code = static_cast<std::uint8_t>(85 * x);
      image.at(x, 0) = {code, code, code, 255};
    }
    return make_mips(image);
  }();
  return {&levels, wrap, Wrap::clamp};
}

float red(const MipTexture& texture, float u, float lod = 0) {
  return sample(texture, {u, 0.5f}, lod).x;
}

double share_there(const ImageRgba8& image, double cutoff) {
  double n = 0;
  for (const Rgba8& p : image.pixels) n += p[3] >= 255 * cutoff;
  return n / static_cast<double>(image.pixels.size());
}

TEST(MipTexture, LevelsHalveDownToOneTexel) {
  const auto levels = make_mips(ImageRgba8(5, 20, {10, 20, 30, 255}));
  ASSERT_EQ(levels.size(), 5u);
  const int widths[] = {5, 2, 1, 1, 1}, heights[] = {20, 10, 5, 2, 1};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    EXPECT_EQ(levels[i].width_px, widths[i]);
    EXPECT_EQ(levels[i].height_px, heights[i]);
    for (const Rgba8& p : levels[i].pixels) EXPECT_EQ(p, (Rgba8{10, 20, 30, 255}));
  }
}

// Texels are what they are at their middles, and light mixes linearly in between.
TEST(MipTexture, IsBilinearInLight) {
  const MipTexture ramp = make_ramp(Wrap::clamp);
  for (int x = 0; x < 4; ++x)
    EXPECT_FLOAT_EQ(red(ramp, (static_cast<float>(x) + 0.5f) / 4),
                    srgb_decode(static_cast<float>(85 * x) / 255));
  EXPECT_NEAR(red(ramp, 0.75f), 0.5f * (srgb_decode(170 / 255.0f) + 1), 1e-6);
}

TEST(MipTexture, WrapsAsItsSamplerSays) {
  const float a = srgb_decode(0), d = 1, b = srgb_decode(85 / 255.0f);
  EXPECT_NEAR(red(make_ramp(Wrap::clamp), -0.5f), a, 1e-6);
  EXPECT_NEAR(red(make_ramp(Wrap::clamp), 7), d, 1e-6);
  EXPECT_NEAR(red(make_ramp(Wrap::repeat), 3.375f), b, 1e-6);
  EXPECT_NEAR(red(make_ramp(Wrap::repeat), 1), 0.5f * (a + d), 1e-6);
  EXPECT_NEAR(red(make_ramp(Wrap::repeat), -0.125f), d, 1e-6);
  EXPECT_NEAR(red(make_ramp(Wrap::mirror), 1.125f), d, 1e-6);
  EXPECT_NEAR(red(make_ramp(Wrap::mirror), -0.375f), b, 1e-6);
  EXPECT_NEAR(red(make_ramp(Wrap::mirror), 1), d, 1e-6);
  for (const Wrap wrap : {Wrap::clamp, Wrap::repeat, Wrap::mirror})
    for (const float u : {INFINITY, -INFINITY, NAN, 3e38f, -3e38f})
      EXPECT_TRUE(std::isfinite(red(make_ramp(wrap), u)));
}

// v = 0 is the lowest row.
TEST(MipTexture, VGrowsUpwards) {
  ImageRgba8 image(1, 2);
  image.pixels = {{255, 0, 0, 255}, {0, 0, 255, 255}};
  const auto levels = make_mips(image);
  const MipTexture texture{&levels, Wrap::clamp, Wrap::clamp};
  EXPECT_FLOAT_EQ(sample(texture, {0.5f, 0.9f}, 0).x, 1);
  EXPECT_FLOAT_EQ(sample(texture, {0.5f, 0.1f}, 0).z, 1);
}

TEST(MipTexture, LevelsMixBetweenWholeOnes) {
  Random random(3);
  const auto levels = make_mips(random_image(32, 32, random));
  const MipTexture texture{&levels};
  const glm::vec2 uv(0.3f, 0.6f);
  const glm::vec4 fine = sample(texture, uv, 1), coarse = sample(texture, uv, 2);
  const glm::vec4 between = sample(texture, uv, 1.25f), wanted = glm::mix(fine, coarse, 0.25f);
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(between[c], wanted[c], 1e-6);
}

// A step of n texels is level log2 n; nearer than a texel is the picture itself, far is its mean.
TEST(MipTexture, LodIsOfTheLongerStep) {
  const auto levels = make_mips(ImageRgba8(64, 32, {1, 2, 3, 255}));
  const MipTexture texture{&levels};
  EXPECT_FLOAT_EQ(mip_lod(texture, {{0, 0}, {0, 0}}), 0);
  EXPECT_FLOAT_EQ(mip_lod(texture, {{0.25f / 64, 0}, {0, 0.5f / 32}}), 0);
  EXPECT_FLOAT_EQ(mip_lod(texture, {{4.0f / 64, 0}, {0, 2.0f / 32}}), 2);
  EXPECT_FLOAT_EQ(mip_lod(texture, {{0, 0}, {0, 8.0f / 32}}), 3);
  EXPECT_FLOAT_EQ(mip_lod(texture, {{900, 0}, {0, 900}}), 6);
}

// Black under alpha 0 does not darken what is there.
TEST(MipTexture, WhatIsNotThereHasNoColour) {
  ImageRgba8 image(2, 1);
  image.pixels = {{200, 100, 50, 255}, {0, 0, 0, 0}};
  const auto levels = make_mips(image);
  EXPECT_EQ(levels[1].pixels[0], (Rgba8{200, 100, 50, 128}));
}

// Leaves: without it, of 8 % of a picture that is there nothing is left at level 4.
TEST(MipTexture, MasksKeepTheirCoverage) {
  Random random(5);
  ImageRgba8 image(256, 256, {40, 120, 30, 0});
  for (int leaf = 0; leaf < 60; ++leaf) {
    const int x0 = static_cast<int>(random.below(246)), y0 = static_cast<int>(random.below(246));
    for (int y = y0; y < y0 + 10; ++y)
      for (int x = x0; x < x0 + 10; ++x) image.at(x, y)[3] = 255;
  }
  for (const float cutoff : {0.3f, 0.5f, 0.9f}) {
    const auto levels = make_mips(image, cutoff);
    const double wanted = share_there(image, cutoff);
    ASSERT_GT(wanted, 0.05);
    for (std::size_t i = 1; i <= 5; ++i)
      EXPECT_NEAR(share_there(levels[i], cutoff), wanted, 0.02) << i << ' ' << cutoff;
    EXPECT_EQ(levels[4].pixels, make_mips(image, cutoff, 1)[4].pixels);
  }
  EXPECT_LT(share_there(make_mips(image)[5], 0.9), 0.02);
}

}  // namespace
}  // namespace viewcell

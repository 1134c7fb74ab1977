#include "adapt/resolve_index_map.h"

#include <gtest/gtest.h>

#include "adapt/hand_log.h"

namespace viewcell {
namespace {

constexpr int kMapSize = 32;
constexpr Rgba8 kGround{255, 0, 255, 255}, kSkin{10, 200, 30, 255}, kHair{90, 60, 20, 255},
    kRim{40, 40, 200, 255};

// Of one chart from x or, turned, from y = 0 to `end` texels.
LevelCharts make_strip(int end, bool is_turned) {
  HandLog hand(kMapSize, kMapSize, 1);
  hand.add_chart(is_turned ? glm::dvec4(-0.5, -0.5, kMapSize - 0.5, end - 0.5)
                           : glm::dvec4(-0.5, -0.5, end - 0.5, kMapSize - 0.5),
                 0);
  return hand.charts;
}

// Skin, hair from 8 on, a rim from 12 on, ground from 16 on; by columns or rows.
ImageRgba8 make_texture(bool is_turned) {
  ImageRgba8 out(kMapSize, kMapSize);
  for (int y = 0; y < kMapSize; ++y)
    for (int x = 0; x < kMapSize; ++x) {
      const int at = is_turned ? y : x;
      out.at(x, y) = at < 8 ? kSkin : at < 12 ? kHair : at < 16 ? kRim : kGround;
    }
  return out;
}

// The map that shows at each texel of a line the texel (at) says; lines are all alike.
template <typename At>
IndexMap make_map(bool is_turned, const At& at) {
  IndexMap out(kMapSize, kMapSize);
  for (int y = 0; y < kMapSize; ++y)
    for (int x = 0; x < kMapSize; ++x) {
      const double place = at(is_turned ? y : x);
      out.at(x, y) = own_texcoords(x, y, kMapSize, kMapSize);
      if (is_turned)
        out.at(x, y).y = static_cast<float>(1 - (place + 0.5) / kMapSize);
      else
        out.at(x, y).x = static_cast<float>((place + 0.5) / kMapSize);
    }
  return out;
}

Rgba8 at_line(const ImageRgba8& image, bool is_turned, int at) {
  return is_turned ? image.at(5, at) : image.at(at, 5);
}

// Where nothing has moved every texel keeps its bits, those at the rim of a chart, too.
TEST(BakeTexture, TheIdentityIsTheTexture) {
  const LevelCharts charts = make_strip(16, false);
  const ImageRgba8 texture = make_texture(false);
  IndexMap map(kMapSize, kMapSize);
  for (int y = 0; y < kMapSize; ++y)
    for (int x = 0; x < kMapSize; ++x) map.at(x, y) = own_texcoords(x, y, kMapSize, kMapSize);
  EXPECT_EQ(resolve_index_map(map, texture, charts, charts).pixels, texture.pixels);
}

// Fetches up to 3 texels beyond the chart find its rim's colour, not the ground's.
TEST(BakeTexture, ContinuesChartsForFetches) {
  for (const bool is_turned : {false, true}) {
    const LevelCharts charts = make_strip(16, is_turned);
    const IndexMap map = make_map(is_turned, [](int at) { return at < 16 ? 14.9 + at / 4.0 : at; });
    const ImageRgba8 out = resolve_index_map(map, make_texture(is_turned), charts, charts);
    for (int at = 0; at < 16; ++at) EXPECT_EQ(at_line(out, is_turned, at), kRim) << at;
    EXPECT_EQ(at_line(out, is_turned, 16), kGround);
  }
}

// A chart that has shrunk from 16 texels to 8. Its gutter is 2 texels wide and shows hair; that is
// what the texels that it has left take.
TEST(BakeTexture, WhatChartsLeaveTakesTheGutter) {
  for (const bool is_turned : {false, true}) {
    const IndexMap map = make_map(is_turned, [](int at) {
      return at < 8 ? at : at < 10 ? 9 : at < 16 ? 3 : at;
    });
    const ImageRgba8 out = resolve_index_map(map, make_texture(is_turned),
                                             make_strip(16, is_turned), make_strip(8, is_turned));
    for (int at = 0; at < kMapSize; ++at)
      EXPECT_EQ(at_line(out, is_turned, at), at < 8 ? kSkin : at < 16 ? kHair : kGround) << at;
  }
}

// One that has grown from 16 texels to 20, and its gutter, show what the map says; ground stays.
TEST(BakeTexture, GrownChartsCoverTheGround) {
  for (const bool is_turned : {false, true}) {
    const IndexMap map = make_map(is_turned, [](int at) {
      return at < 16 ? at : at < 22 ? 9 : at;
    });
    const ImageRgba8 out = resolve_index_map(map, make_texture(is_turned),
                                             make_strip(16, is_turned), make_strip(20, is_turned));
    for (int at = 12; at < kMapSize; ++at)
      EXPECT_EQ(at_line(out, is_turned, at), at < 16 ? kRim : at < 22 ? kHair : kGround) << at;
  }
}

// A map of another size: values between two texels are rounded, and there is no ground to keep.
TEST(BakeTexture, OfAnotherSize) {
  HandLog hand(8, 2, 1);
  hand.add_chart({-0.5, -0.5, 7.5, 1.5}, 0);
  ImageRgba8 texture(8, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 8; ++x)
      texture.at(x, y) = {static_cast<std::uint8_t>(20 * x), static_cast<std::uint8_t>(9 * y), 0,
                          255};
  IndexMap map(3, 1);
  const auto uv = [](double x, double y) { return glm::vec2((x + 0.5) / 8, 1 - (y + 0.5) / 2); };
  map.pixels = {uv(2.49, 0.74), uv(6.98, 0.25), uv(40, -3)};
  const ImageRgba8 out = resolve_index_map(map, texture, hand.charts, hand.charts);
  EXPECT_EQ(out.pixels[0], (Rgba8{50, 7, 0, 255}));   // 49.8, 6.66
  EXPECT_EQ(out.pixels[1], (Rgba8{140, 2, 0, 255}));  // 139.6, 2.25
  EXPECT_EQ(out.pixels[2], (Rgba8{140, 0, 0, 255}));
}

}  // namespace
}  // namespace viewcell

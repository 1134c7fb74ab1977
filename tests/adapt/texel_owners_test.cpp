#include "adapt/texel_owners.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "adapt/hand_log.h"
#include "base/random.h"
#include "image/chart_reach.h"

namespace viewcell {
namespace {

TEST(TexelOwners, NamesAreNeverNobody) {
  EXPECT_EQ(owner_name(0), 1);
  EXPECT_EQ(owner_name(6), 7);
  for (std::uint32_t chart = 0; chart < 70000; ++chart) {
    const std::uint16_t name = owner_name(chart);
    ASSERT_TRUE(name >= 1 && name <= 0x7ffe) << chart;  // 0x7fff: of several
    ASSERT_NE(name, owner_name(chart + 1));
  }
}

// Where charts overlap the first one has the inside; a gutter is the nearer chart's, of two as near
// that of the greater name.
TEST(TexelOwners, OfChartsThatMeet) {
  HandLog hand(24, 16, 2);
  hand.add_chart({5.5, 5.5, 10.5, 9.5}, 4);
  hand.add_chart({8.5, 5.5, 14.5, 9.5}, 2);
  hand.add_chart({19.5, 0.5, 30, 2.5}, 3);
  const Image<std::uint16_t> owners = make_texel_owners(hand.charts, 24, 16);
  struct FixedTexels {
    int name, x0, y0, x1, y1;
  };
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 24; ++x) {
      int wanted = 0, nearest = static_cast<int>(kGutter) + 1;
      for (const FixedTexels& t : {FixedTexels{5, 6, 6, 10, 9}, FixedTexels{4, 20, 1, 23, 2},
                                   FixedTexels{3, 9, 6, 14, 9}}) {
        const int away = std::max({t.x0 - x, x - t.x1, t.y0 - y, y - t.y1, 0});
        if (away < nearest) nearest = away, wanted = t.name | (away == 0 ? kInsideChart : 0);
      }
      ASSERT_EQ(owners.at(x, y), wanted) << x << ' ' << y;
    }
}

TEST(ChartMask, IsWhereCentresLie) {
  HandLog hand(9, 7, 1);
  hand.add_chart({2.5, 1.6, 5.4, 3.9}, 0);  // columns 3 to 5, rows 2 and 3
  for (int reach = 0; reach < 4; ++reach) {
    const Image<std::uint8_t> mask = make_chart_mask(hand.charts, 9, 7, reach);
    for (int y = 0; y < 7; ++y)
      for (int x = 0; x < 9; ++x) {
        const bool is_near = x >= 3 - reach && x <= 5 + reach && y >= 2 - reach && y <= 3 + reach;
        ASSERT_EQ(mask.at(x, y), is_near) << x << ' ' << y;
      }
  }
}

// Of random texels: never no where the answer is yes, and yes only where a tile that the box meets
// holds another's.
TEST(OwnerTiles, NeverMissAnother) {
  constexpr int kTile = 8;
  std::size_t n_yes = 0, n_no = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const int width = 17 + static_cast<int>(random.below(30));
    const int height = 17 + static_cast<int>(random.below(30));
    Image<std::uint16_t> owners(width, height);
    for (int i = 0; i < 6; ++i)
      owners.at(static_cast<int>(random.below(width)), static_cast<int>(random.below(height))) =
          static_cast<std::uint16_t>((1 + random.below(2)) | (random.below(2) ? kInsideChart : 0));
    OwnerTiles tiles(owners);
    for (int i = 0; i < 200; ++i) {
      const glm::vec2 lo(random.uniform(-9, width), random.uniform(-9, height));
      const glm::vec2 hi = lo + glm::vec2(random.uniform(0, 12), random.uniform(0, 12));
      const auto name = static_cast<std::uint16_t>(1 + random.below(2));
      bool has = false, may = false;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const int owner = owners.at(x, y) & ~kInsideChart;
          if (owner == 0 || owner == name) continue;
          has = has || (x >= lo.x && x <= hi.x && y >= lo.y && y <= hi.y);
          const auto tile = [](double at, int n) {
            return std::clamp(static_cast<int>(std::floor(at)), 0, n - 1) / kTile;
          };
          may = may || (x / kTile >= tile(lo.x, width) && x / kTile <= tile(hi.x, width) &&
                        y / kTile >= tile(lo.y, height) && y / kTile <= tile(hi.y, height));
        }
      const bool said = tiles.has_others(lo, hi, name);
      ASSERT_TRUE(said || !has);
      ASSERT_TRUE(may || !said);
      ++(said ? n_yes : n_no);
    }
  }
  EXPECT_GT(n_yes, 1000u);
  EXPECT_GT(n_no, 1000u);
}

}  // namespace
}  // namespace viewcell

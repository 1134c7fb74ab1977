#include "adapt/adapt_packs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adapt/hand_log.h"
#include "base/random.h"
#include "image/chart_reach.h"

namespace viewcell {
namespace {

constexpr int kPackWidth = 80, kPackHeight = 40;

// The pack of each step; 0 for those that are left out.
std::vector<std::size_t> packs_of(const HandLog& hand, std::size_t from, std::size_t to,
                                  bool pack = true) {
  const AdaptPacks packs = pack_adaptations(hand.log, from, to, kPackWidth, kPackHeight, pack);
  EXPECT_EQ(packs.first.front(), 0u);
  EXPECT_EQ(packs.first.back(), packs.order.size());
  std::vector<std::size_t> out(hand.log.n_steps(), 0);
  for (std::size_t p = 0; p < packs.size(); ++p) {
    EXPECT_LT(packs.first[p], packs.first[p + 1]);  // none is empty
    for (std::size_t i = packs.first[p]; i < packs.first[p + 1]; ++i) {
      EXPECT_EQ(out[packs.order[i]], 0u);
      out[packs.order[i]] = p + 1;
    }
  }
  return out;
}

using Packs = std::vector<std::size_t>;

HandLog make_boxes(const std::vector<glm::dvec4>& boxes, bool has_border = false) {
  HandLog hand(kPackWidth, kPackHeight, 1);
  for (const glm::dvec4& box : boxes) hand.add_box(box, box, 0, has_border);
  return hand;
}

//  A and B are far apart; C lies over B, D over A and C; E is alone.
TEST(AdaptPacks, TheFirstThatMayBe) {
  HandLog hand = make_boxes({{1, 1, 6, 6}, {40, 1, 46, 6}, {42, 2, 60, 6}, {2, 2, 43, 5}});
  hand.add_step({{1, 1}}, {{1, 1}}, {});  // adapts nothing
  hand.add_box({70, 30, 75, 35}, {70, 30, 75, 35}, 0, false);
  EXPECT_EQ(packs_of(hand, 0, 6), (Packs{1, 1, 2, 3, 0, 1}));
  EXPECT_EQ(packs_of(hand, 6, 0), (Packs{2, 3, 2, 1, 0, 1}));
  EXPECT_EQ(packs_of(hand, 1, 3), (Packs{0, 1, 2, 0, 0, 0}));
  EXPECT_EQ(packs_of(hand, 3, 1), (Packs{0, 2, 1, 0, 0, 0}));
  EXPECT_EQ(packs_of(hand, 2, 2), (Packs{0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(packs_of(hand, 0, 6, false), (Packs{1, 2, 3, 4, 0, 5}));
  EXPECT_EQ(packs_of(hand, 6, 0, false), (Packs{5, 4, 3, 2, 0, 1}));
}

// Where a step goes counts as well as where it was.
TEST(AdaptPacks, BothPlacesCount) {
  HandLog hand(kPackWidth, kPackHeight, 1);
  hand.add_box({1, 1, 6, 6}, {40, 1, 46, 6}, 0, false);
  hand.add_box({70, 30, 75, 35}, {41, 2, 44, 5}, 0, false);
  EXPECT_EQ(packs_of(hand, 0, 2), (Packs{1, 2}));
  EXPECT_EQ(packs_of(hand, 2, 0), (Packs{2, 1}));
}

// Any number of steps may read a texel side by side; who writes it waits for all of them, though
// the last reader may be of an early pack. Tiles are of 8 texels.
TEST(AdaptPacks, WritersWaitForAllReaders) {
  const glm::dvec4 over{1, 33, 6, 38};
  // A to C over one another; D touches C and reads tile 2; E, alone, reads tile 2 from its other
  // side; F writes tile 2 and meets none of them but there.
  HandLog hand =
      make_boxes({over, over, over, {3, 25, 15.5, 36}, {24.5, 25, 30, 30}, {17, 27, 22, 30}});
  EXPECT_EQ(packs_of(hand, 0, 6), (Packs{1, 2, 3, 4, 1, 5}));
  // Readers of one tile, whose texels they do not write.
  hand = make_boxes({{10, 10, 15.5, 14}, {24.5, 10, 30, 14}});
  EXPECT_EQ(packs_of(hand, 0, 2), (Packs{1, 1}));
}

// One texel is read beyond a cell, and a gutter written around a border.
TEST(AdaptPacks, NeighboursAreToldFromOthers) {
  const auto n_packs = [](const glm::dvec4& a, const glm::dvec4& b, bool has_border) {
    const HandLog hand = make_boxes({a, b}, has_border);
    const Packs packs = packs_of(hand, 0, 2);
    EXPECT_EQ(packs_of(hand, 2, 0)[0], packs[1]);
    return *std::max_element(packs.begin(), packs.end());
  };
  EXPECT_EQ(n_packs({2, 2, 7.5, 6}, {8.2, 2, 14, 6}, false), 2u);
  EXPECT_EQ(n_packs({2, 2, 6, 7.5}, {2, 8.2, 6, 14}, false), 2u);
  EXPECT_EQ(n_packs({2, 2, 6, 6}, {9.2, 2, 14, 6}, false), 1u);
  EXPECT_EQ(n_packs({2, 2, 6, 6}, {9.2, 2, 14, 6}, true), 2u);
  EXPECT_EQ(n_packs({2, 2, 6, 6}, {2, 12.5, 6, 14}, true), 2u);
  EXPECT_EQ(n_packs({2, 2, 6, 6}, {25, 2, 30, 6}, true), 1u);
}

// What a step may write, and what it may read, texel by texel.
struct Touched {
  glm::dvec2 lo{1e9}, hi{-1e9};
  double write = 0;

  Touched(const HandLog& hand, std::size_t step) {
    const Adaptation adaptation = hand.log.of(step);
    for (const AdaptationPoint& p : adaptation.points)
      for (const glm::vec2& uv : {p.before, p.after}) {
        const glm::dvec2 at(uv.x * kPackWidth - 0.5, (1 - uv.y) * kPackHeight - 0.5);
        lo = glm::min(lo, at), hi = glm::max(hi, at);
      }
    for (const AdaptationTriangle& t : adaptation.triangles)
      if (t.has_border()) write = kGutter;
  }
  static bool meet(const Touched& a, double a_margin, const Touched& b, double b_margin) {
    const auto first = [](double x) { return std::ceil(x - 1e-3); };
    const auto last = [](double x) { return std::floor(x + 1e-3); };
    for (int k = 0; k < 2; ++k)
      if (first(a.lo[k] - a_margin) > last(b.hi[k] + b_margin) ||
          first(b.lo[k] - b_margin) > last(a.hi[k] + a_margin))
        return false;
    return true;
  }
  static bool depend(const Touched& a, const Touched& b) {
    return meet(a, a.write, b, b.write + 1) || meet(a, a.write + 1, b, b.write);
  }
};

// Steps of a pack never meet, and each stands behind all that it depends on, both ways.
TEST(AdaptPacks, NoStepMeetsAnotherOfItsPack) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    HandLog hand(kPackWidth, kPackHeight, 1);
    const auto box = [&] {
      const double x = random.uniform(-1, kPackWidth - 1), y = random.uniform(-1, kPackHeight - 1);
      return glm::dvec4(x, y, x + random.uniform(0, 9), y + random.uniform(0, 9));
    };
    for (int i = 0; i < 60; ++i) {
      const glm::dvec4 before = box();
      hand.add_box(before, random.below(2) ? before : before + random.uniform(-3, 3), 0,
                   random.below(4) == 0);
    }
    std::vector<Touched> touched;
    for (std::size_t i = 0; i < 60; ++i) touched.emplace_back(hand, i);
    const Packs there = packs_of(hand, 0, 60), back = packs_of(hand, 60, 0);
    for (std::size_t i = 0; i < 60; ++i)
      for (std::size_t j = i + 1; j < 60; ++j) {
        if (!Touched::depend(touched[i], touched[j])) continue;
        ASSERT_LT(there[i], there[j]) << i << ' ' << j;
        ASSERT_GT(back[i], back[j]) << i << ' ' << j;
      }
    EXPECT_LT(*std::max_element(there.begin(), there.end()), 40u);
  }
}

}  // namespace
}  // namespace viewcell

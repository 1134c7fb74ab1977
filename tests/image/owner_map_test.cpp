#include "image/owner_map.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace viewcell {
namespace {

using Owners = Image<std::uint32_t>;

// A right triangle over the texels x + y < size of a corner.
TexelTriangle corner_triangle(float size) {
  return {glm::vec2(-0.5f), glm::vec2(size - 0.4f, -0.5f), glm::vec2(-0.5f, size - 0.4f)};
}

//  7 7 5    7 is drawn first, over x + y < 2; then 5, over x + y < 3
//  7 5 .
//  5 . .
TEST(ClaimTexels, FirstDrawnOrLowest) {
  for (const Claim claim : {Claim::first_drawn, Claim::lowest_owner}) {
    Owners owners(3, 3);
    claim_texels(corner_triangle(2), 7u, owners, claim);
    claim_texels(corner_triangle(3), 5u, owners, claim);
    const std::uint32_t both = claim == Claim::first_drawn ? 7 : 5;
    EXPECT_EQ(owners.pixels, (std::vector<std::uint32_t>{both, both, 5, both, 5, 0, 5, 0, 0}));
    claim_texels(corner_triangle(3), 6u, owners, claim);  // comes later, and is higher than 5
    EXPECT_EQ(owners.at(1, 1), 5u);
    release_texels(corner_triangle(2), 5u, owners);
    EXPECT_EQ(owners.at(0, 0), claim == Claim::first_drawn ? 7u : 0u);
    EXPECT_EQ(owners.at(2, 0), 5u);
  }
}

// Each against a search of all texels: the owner of a free texel is the greatest among those fewest
// steps away, without the bit of insides.
TEST(WidenOwners, TakesTheNearest) {
  constexpr std::uint16_t kBit = 0x100;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Image<std::uint16_t> start(9, 7);
    for (std::uint16_t& owner : start.pixels)
      if (random.below(12) == 0) owner = static_cast<std::uint16_t>(kBit | (1 + random.below(4)));
    for (int reach = 0; reach < 4; ++reach) {
      Image<std::uint16_t> owners = start;
      widen_owners(owners, reach, kBit);
      for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 9; ++x) {
          int nearest = reach + 1, wanted = 0;
          for (int j = 0; j < 7; ++j)
            for (int i = 0; i < 9; ++i) {
              const int away = std::max(std::abs(i - x), std::abs(j - y));
              const int name = start.at(i, j) & ~kBit;
              if (name == 0 || away > nearest) continue;
              wanted = away < nearest ? name : std::max(wanted, name);
              nearest = away;
            }
          if (nearest > reach) wanted = 0;
          if (start.at(x, y) != 0) wanted = start.at(x, y);
          ASSERT_EQ(owners.at(x, y), wanted) << x << ' ' << y << ' ' << reach;
        }
      const Image<std::uint8_t> owned = mark_owned(owners);
      for (std::size_t i = 0; i < owned.pixels.size(); ++i)
        ASSERT_EQ(owned.pixels[i], owners.pixels[i] != 0);
    }
  }
}

TEST(IsNearOthers, CountsInBothDirections) {
  Owners owners(6, 4);
  owners.at(0, 0) = 3, owners.at(4, 2) = 8;
  EXPECT_FALSE(is_near_others(owners, 2, 2, 3u, 1));
  EXPECT_TRUE(is_near_others(owners, 2, 2, 3u, 2));
  EXPECT_FALSE(is_near_others(owners, 3, 3, 8u, 2));
  EXPECT_TRUE(is_near_others(owners, 3, 3, 8u, 3));
  EXPECT_FALSE(is_near_others(owners, 4, 2, 8u, 2));
}

}  // namespace
}  // namespace viewcell

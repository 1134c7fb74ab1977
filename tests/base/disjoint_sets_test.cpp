#include "base/disjoint_sets.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace viewcell {
namespace {

TEST(DisjointSets, ByHand) {
  DisjointSets sets(6);
  EXPECT_TRUE(sets.join(5, 3));
  EXPECT_TRUE(sets.join(1, 4));
  EXPECT_EQ(sets.find(5), 3u);
  EXPECT_EQ(sets.find(4), 1u);
  EXPECT_TRUE(sets.join(5, 4));
  EXPECT_FALSE(sets.join(3, 1));
  for (const std::uint32_t i : {1u, 3u, 4u, 5u}) EXPECT_EQ(sets.find(i), 1u);
  EXPECT_EQ(sets.find(0), 0u);
  EXPECT_EQ(sets.find(2), 2u);
}

// Against lists of lowest members that every join goes through.
TEST(DisjointSets, LowestMemberOfRandomSets) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    DisjointSets sets(50);
    std::vector<std::uint32_t> lowest(50);
    std::iota(lowest.begin(), lowest.end(), 0u);
    for (int k = 0; k < 40; ++k) {
      const auto a = static_cast<std::uint32_t>(random.below(50));
      const auto b = static_cast<std::uint32_t>(random.below(50));
      const std::uint32_t x = lowest[a], y = lowest[b];
      EXPECT_EQ(sets.join(a, b), x != y);
      for (std::uint32_t& of : lowest)
        if (of == x || of == y) of = std::min(x, y);
      for (std::uint32_t i = 0; i < 50; ++i) ASSERT_EQ(sets.find(i), lowest[i]);
    }
  }
}

}  // namespace
}  // namespace viewcell

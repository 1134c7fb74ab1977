#include "base/buckets.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace viewcell {
namespace {

TEST(Buckets, HoldEachKeysItemsInTheirOrder) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::uint32_t n_keys = 1 + random.below(20);
    std::vector<std::uint32_t> keys(random.below(50));
    for (std::uint32_t& key : keys) key = random.below(n_keys);
    std::vector<std::vector<int>> wanted(n_keys);
    for (std::size_t i = 0; i < keys.size(); ++i) wanted[keys[i]].push_back(static_cast<int>(i));
    const Buckets<int> buckets = fill_buckets<int>(n_keys, [&](const auto& emit) {
      for (std::size_t i = 0; i < keys.size(); ++i) emit(keys[i], static_cast<int>(i));
    });
    ASSERT_EQ(buckets.size(), n_keys);
    for (std::uint32_t key = 0; key < n_keys; ++key)
      ASSERT_EQ(std::vector<int>(buckets.of(key).begin(), buckets.of(key).end()), wanted[key]);
  }
}

TEST(Buckets, OfNothing) {
  const Buckets<int> buckets = fill_buckets<int>(0, [](const auto&) {});
  EXPECT_EQ(buckets.size(), 0u);
  EXPECT_TRUE(buckets.items.empty());
}

}  // namespace
}  // namespace viewcell

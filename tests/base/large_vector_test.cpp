#include "base/large_vector.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <utility>

namespace viewcell {
namespace {

// Around the size from which memory comes in pages of its own, and grown across it.
TEST(LargeVector, KeepsItsValuesAtAnySize) {
  const std::size_t n_least = LargeAllocator<std::uint32_t>::kLeastBytes / sizeof(std::uint32_t);
  for (const std::size_t n : {std::size_t{3}, n_least - 1, n_least, n_least + 1, 3 * n_least}) {
    LargeVector<std::uint32_t> values(n, 7u);
    values.push_back(9u);
    std::iota(values.begin(), values.end() - 1, 1u);
    const LargeVector<std::uint32_t> copy = values;
    const LargeVector<std::uint32_t> moved = std::move(values);
    EXPECT_EQ(copy, moved);
    EXPECT_EQ(copy.front(), 1u);
    EXPECT_EQ(copy[n - 1], static_cast<std::uint32_t>(n));
    EXPECT_EQ(copy.back(), 9u);
  }
}

TEST(LargeVector, MemoryIsZeroAndInWholeHugePages) {
  const std::size_t n_bytes = LargeAllocator<char>::kLeastBytes + 1;
  auto* bytes = static_cast<char*>(allocate_pages(n_bytes));
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(bytes) % (2u << 20), 0u);
  EXPECT_EQ(std::accumulate(bytes, bytes + n_bytes, 0), 0);
  bytes[0] = bytes[n_bytes - 1] = 1;
  free_pages(bytes, n_bytes);
}

TEST(LargeVector, TooMuchIsBadAlloc) {
  EXPECT_THROW(allocate_pages(SIZE_MAX), std::bad_alloc);
  EXPECT_THROW(allocate_pages(SIZE_MAX / 4), std::bad_alloc);
}

}  // namespace
}  // namespace viewcell

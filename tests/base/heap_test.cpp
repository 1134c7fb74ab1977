#include "base/heap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "base/random.h"

namespace viewcell {
namespace {

TEST(IndexedHeap, PopsInOrderOfKeyThenId) {
  IndexedHeap heap(5);
  heap.set(3, 1.0f), heap.set(1, 2.0f), heap.set(4, 1.0f), heap.set(0, 3.0f);
  heap.set(0, 0.5f);  // moved up
  heap.set(3, 2.0f);  // moved down, ties with 1
  std::vector<std::uint32_t> order;
  for (; !heap.empty(); heap.pop()) order.push_back(heap.top());
  EXPECT_EQ(order, (std::vector<std::uint32_t>{0, 4, 1, 3}));
}

TEST(IndexedHeap, AgreesWithSortingUnderRandomChanges) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    constexpr std::uint32_t n = 200;
    IndexedHeap heap(n);
    std::vector<float> keys(n, -1);
    for (int step = 0; step < 2000; ++step) {
      const std::uint32_t id = random.below(n);
      if (random.below(4) == 0) {
        heap.erase(id);
        keys[id] = -1;
      } else {
        keys[id] = static_cast<float>(random.below(50));
        heap.set(id, keys[id]);
      }
    }
    std::vector<std::pair<float, std::uint32_t>> expected, popped;
    for (std::uint32_t id = 0; id < n; ++id)
      if (keys[id] >= 0) expected.emplace_back(keys[id], id);
    std::sort(expected.begin(), expected.end());
    for (; !heap.empty(); heap.pop()) popped.emplace_back(heap.key(heap.top()), heap.top());
    EXPECT_EQ(popped, expected);
  }
}

TEST(IndexedHeap, KeysMayBeNegativeOrInfinite) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::vector<float> keys{3, -0.0f, -7, kInfinity, 0.0f, -kInfinity, 1e-30f, -1e-30f};
  IndexedHeap heap(8);
  for (std::uint32_t id = 8; id-- > 0;) heap.set(id, keys[id]);
  for (std::uint32_t id = 0; id < 8; ++id) EXPECT_EQ(heap.key(id), keys[id]);
  std::vector<std::uint32_t> order;
  for (; !heap.empty(); heap.pop()) order.push_back(heap.top());
  EXPECT_EQ(order, (std::vector<std::uint32_t>{5, 2, 7, 1, 4, 6, 0, 3}));  // -0 is 0: by id
}

TEST(IndexedHeap, NextIsWhatComesAfterTheTop) {
  Random random(1);
  IndexedHeap heap(300);
  for (std::uint32_t id = 0; id < 300; ++id) heap.set(id, static_cast<float>(random.uniform(0, 1)));
  while (heap.size() > 1) {
    const auto next = heap.next();
    heap.pop();
    EXPECT_EQ(heap.top(), next[0]);
    for (std::size_t i = 1; i < next.size() && next[i] != IndexedHeap::kNone; ++i)
      EXPECT_GE(heap.key(next[i]), heap.key(next[i - 1]));
  }
  EXPECT_EQ(heap.next()[0], IndexedHeap::kNone);
}

}  // namespace
}  // namespace viewcell

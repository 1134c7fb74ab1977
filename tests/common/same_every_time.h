// The same result every time, by any number of threads.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "base/parallel.h"

namespace viewcell {

inline constexpr int kThreadCounts[] = {1, 2, 7};

/// For what takes a number of threads: make(n_threads) gives the same for 1, 2 and 7, three times
/// each. Returns it.
template <typename Make>
auto same_for_any_threads(const Make& make) {
  const auto first = make(1);
  for (const int n_threads : kThreadCounts)
    for (int run = 0; run < 3; ++run)
      EXPECT_TRUE(make(n_threads) == first) << n_threads << " threads, run " << run;
  return first;
}

/// For what has no threads of its own: make(i), i = 0, 1, ..., gives the same whether called one
/// after another or by 2 and 7 threads at once. Returns it.
template <typename Make>
auto same_every_time(const Make& make) {
  const auto first = make(0);
  std::size_t n = 1;
  for (const int n_threads : kThreadCounts) {
    std::vector<decltype(make(0))> results(2 * static_cast<std::size_t>(n_threads));
    parallel_for(results.size(), n_threads, [&](std::size_t i) { results[i] = make(n + i); });
    n += results.size();
    for (const auto& result : results) EXPECT_TRUE(result == first) << n_threads << " at once";
  }
  return first;
}

}  // namespace viewcell

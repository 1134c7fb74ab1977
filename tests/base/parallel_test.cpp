#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

namespace viewcell {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnce) {
  for (const int threads : {0, 1, 2, 8})
    for (const std::size_t n : {0u, 1u, 2u, 7u, 1000u}) {
      std::vector<std::atomic<int>> visits(n);
      parallel_for(n, threads, [&](std::size_t i) { ++visits[i]; });
      for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(visits[i], 1) << i << " of " << n;
    }
}

TEST(ParallelFor, ResultDoesNotDependOnThreads) {
  const auto compute = [](int threads) {
    std::vector<double> out(5000);
    parallel_for(out.size(), threads, [&](std::size_t i) {
      for (int k = 1; k < 20; ++k) out[i] += std::sin(static_cast<double>(i) / k);
    });
    return out;
  };
  EXPECT_EQ(compute(1), compute(8));
}

// Indices are handed out in order, so the lowest that throws is always among those tried.
TEST(ParallelFor, RethrowsTheLowestFailure) {
  for (const int threads : {1, 2, 8})
    for (int trial = 0; trial < 30; ++trial) {
      try {
        const std::size_t late = trial % 2 ? 10 : 11;  // the lowest may fail first or last
        parallel_for(100, threads, [late](std::size_t i) {
          if (i == late) std::this_thread::sleep_for(std::chrono::microseconds(200));
          if (i >= 10) throw std::runtime_error(std::to_string(i));
        });
        FAIL() << "nothing thrown";
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "10") << threads << " threads";
      }
    }
}

// Also when the other failure comes last: 1 waits until 0 has thrown, and is given time to be
// noted.
TEST(ParallelFor, LaterFailuresOfHigherIndicesDoNotCount) {
  std::atomic<bool> both_run = false, first_threw = false;
  try {
    parallel_for(2, 2, [&](std::size_t i) {
      if (i == 0) {
        while (!both_run) std::this_thread::yield();
        first_threw = true;
        throw std::runtime_error("0");
      }
      both_run = true;
      while (!first_threw) std::this_thread::yield();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      throw std::runtime_error("1");
    });
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "0");
  }
}

TEST(ParallelFor, StopsAfterAFailure) {
  std::atomic<std::size_t> n_started{0};
  EXPECT_THROW(parallel_for(1000000, 2,
                            [&](std::size_t) {
                              ++n_started;
                              throw std::runtime_error("x");
                            }),
               std::runtime_error);
  EXPECT_LE(n_started, 2u);
}

TEST(ParallelFor, ProgressCountsUpOneAtATime) {
  std::vector<std::size_t> told;  // no lock: progress is never called from two threads at a time
  parallel_for(
      500, 8, [](std::size_t) {},
      [&](std::size_t done, std::size_t total) {
        EXPECT_EQ(total, 500u);
        told.push_back(done);
      });
  ASSERT_EQ(told.size(), 500u);
  for (std::size_t i = 0; i < told.size(); ++i) EXPECT_EQ(told[i], i + 1);
}

TEST(ParallelFor, ProgressMayThrow) {
  EXPECT_THROW(parallel_for(
                   50, 4, [](std::size_t) {},
                   [](std::size_t, std::size_t) { throw std::runtime_error("full"); }),
               std::runtime_error);
}

TEST(HardwareThreads, AtLeastOne) {
  EXPECT_GE(hardware_threads(), 1);
}

}  // namespace
}  // namespace viewcell

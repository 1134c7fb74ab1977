#include "base/child.h"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/parallel.h"

namespace viewcell {
namespace {

TEST(Child, HandsOverWhatItMakes) {
  const SharedBytes shared(1000000);
  EXPECT_EQ(run_in_child({}, [&] { std::memset(shared.bytes().data(), 7, 1000000); }), "");
  for (const std::byte b : shared.bytes()) ASSERT_EQ(b, std::byte{7});
}

TEST(Child, WhatGoesWrongStaysInIt) {
  EXPECT_EQ(run_in_child({}, [] { throw std::runtime_error("no such thing"); }), "no such thing");
  EXPECT_EQ(run_in_child({}, [] { throw std::runtime_error(std::string(9999, 'x')); }),
            std::string(479, 'x'));
  EXPECT_EQ(run_in_child({}, [] { throw 3; }), "it fails");
  EXPECT_EQ(run_in_child({}, [] { std::raise(SIGSEGV); }), "it crashes");
  EXPECT_EQ(run_in_child({}, [] { std::abort(); }), "it crashes");
}

// A sanitizer's allocator does not throw: it ends the process.
#ifdef __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define VIEWCELL_TEST_ALLOCATOR_ENDS
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define VIEWCELL_TEST_ALLOCATOR_ENDS
#endif
#ifdef VIEWCELL_TEST_ALLOCATOR_ENDS
constexpr const char* kTooMuch = "it fails";
#else
constexpr const char* kTooMuch = "it asks for too much memory";
#endif

TEST(Child, MemoryAndTimeEnd) {
  EXPECT_EQ(run_in_child({.memory_bytes = 1 << 24},
                         [] {
                           std::vector<char> all(std::size_t{1} << 28, 'x');
                           if (all[99] == 'y') std::abort();
                         }),
            kTooMuch);
  EXPECT_EQ(run_in_child({.cpu_s = 1},
                         [] {
                           for (std::atomic<unsigned> i = 0;;) ++i;
                         }),
            "it takes too long");
  EXPECT_EQ(run_in_child({.wall_s = 1}, [] { std::this_thread::sleep_for(std::chrono::hours(1)); }),
            "it takes too long");
}

TEST(Child, ManyThreadsAtOnce) {
  constexpr std::size_t kN = 64;
  const SharedBytes shared(kN);
  parallel_for(kN, 4, [&](std::size_t i) {
    const std::string wrong = run_in_child({}, [&] {
      const std::vector<std::byte> made(1000, static_cast<std::byte>(i));
      shared.bytes()[i] = made[i];
      if (i % 5 == 0) throw std::runtime_error(std::to_string(i));
    });
    EXPECT_EQ(wrong, i % 5 == 0 ? std::to_string(i) : "");
  });
  for (std::size_t i = 0; i < kN; ++i) EXPECT_EQ(shared.bytes()[i], static_cast<std::byte>(i));
}

}  // namespace
}  // namespace viewcell

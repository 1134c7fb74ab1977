#include "base/parallel.h"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <barrier>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace viewcell {
namespace {

// What the threads of one parallel_for share.
struct Loop {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stopped{false};
  std::mutex mutex;  // guards all below
  std::size_t n_done = 0;
  std::size_t failed_at = static_cast<std::size_t>(-1);
  std::exception_ptr failure;
};

void work(Loop& loop, std::size_t n, const std::function<void(std::size_t)>& body,
          const Progress& progress) {
  for (;;) {
    if (loop.stopped) return;
    const std::size_t i = loop.next++;
    if (i >= n) return;
    try {
      body(i);
      const std::lock_guard lock(loop.mutex);
      ++loop.n_done;
      if (progress) progress(loop.n_done, n);
    } catch (...) {
      const std::lock_guard lock(loop.mutex);
      loop.stopped = true;
      if (i < loop.failed_at) {
        loop.failed_at = i;
        loop.failure = std::current_exception();
      }
    }
  }
}

// What the threads of one parallel_rounds share.
struct Rounds {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stopped{false};
  std::mutex mutex;
  std::exception_ptr failure;
};

// Iterations of a round are taken one by one: they are few and differ in size.
void work(Rounds& rounds, std::span<const std::size_t> first, std::barrier<>& barrier, int thread,
          const std::function<void(std::size_t, int)>& body) {
  for (std::size_t r = 0; r + 1 < first.size(); ++r) {
    // A thread that is ahead finds next at the round's end until all have come this far.
    for (;;) {
      std::size_t i = rounds.next;
      if (i >= first[r + 1] || rounds.stopped) break;
      if (!rounds.next.compare_exchange_weak(i, i + 1)) continue;
      try {
        body(i, thread);
      } catch (...) {
        const std::lock_guard lock(rounds.mutex);
        if (!rounds.failure) rounds.failure = std::current_exception();
        rounds.stopped = true;
      }
    }
    barrier.arrive_and_wait();
  }
}

}  // namespace

int hardware_threads() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
  return std::max(1u, std::thread::hardware_concurrency());
}

void parallel_for(std::size_t n, int n_threads, const std::function<void(std::size_t)>& body,
                  const Progress& progress) {
  if (n_threads <= 0) n_threads = hardware_threads();
  Loop loop;
  {
    std::vector<std::jthread> others;
    for (std::size_t t = 1; t < std::min(n, static_cast<std::size_t>(n_threads)); ++t)
      others.emplace_back([&] { work(loop, n, body, progress); });
    work(loop, n, body, progress);
  }
  if (loop.failure) std::rethrow_exception(loop.failure);
}

void parallel_rounds(std::span<const std::size_t> first, int n_threads,
                     const std::function<void(std::size_t, int)>& body) {
  if (first.size() < 2) return;
  if (n_threads <= 0) n_threads = hardware_threads();
  Rounds rounds;
  rounds.next = first[0];
  std::barrier<> barrier(n_threads);
  {
    std::vector<std::jthread> others;
    for (int t = 1; t < n_threads; ++t)
      others.emplace_back([&, t] { work(rounds, first, barrier, t, body); });
    work(rounds, first, barrier, 0, body);
  }
  if (rounds.failure) std::rethrow_exception(rounds.failure);
}

}  // namespace viewcell

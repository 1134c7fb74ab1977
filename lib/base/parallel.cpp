#include "base/parallel.h"

#include <sched.h>

#include <algorithm>
#include <atomic>
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

}  // namespace viewcell

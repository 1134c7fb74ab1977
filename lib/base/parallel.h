// Parallel loops whose results do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace viewcell {

/// Told (done, total) as work completes, from any thread but never from two at a time. May be
/// empty.
using Progress = std::function<void(std::size_t done, std::size_t total)>;

/// The number of hardware threads that this process may use; at least 1.
int hardware_threads();

/// Calls body(i) once for every i in [0, n), on `n_threads` threads (0: all). Iterations must be
/// independent and write only to memory of their own: then the result is the same for any number
/// of threads. When some throw, no further iteration starts and the exception of the lowest i that
/// threw is rethrown here.
void parallel_for(std::size_t n, int n_threads, const std::function<void(std::size_t)>& body,
                  const Progress& progress = {});

/// Rounds of such iterations: calls body(i, thread) once for every i in [first[r], first[r + 1]), r
/// after r; no round starts before the last one ended, and then sees all that it wrote. thread: in
/// [0, n_threads), for memory of its own. An exception ends the loop, and is rethrown here.
void parallel_rounds(std::span<const std::size_t> first, int n_threads,
                     const std::function<void(std::size_t, int)>& body);

}  // namespace viewcell

// Wall-clock time of a tool's stages.
#pragma once

#include <chrono>

namespace viewcell {

class Stopwatch {
 public:
  /// Seconds since the last call, or since it was made.
  double lap_s() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> lap = now - last_;
    last_ = now;
    return lap.count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace viewcell

// How far a tool is, with a rate and the time left: a line on a terminal that is written over.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace viewcell {

// "340", "12", "0.21".
inline std::string format_rate(double x) {
  char text[40];
  std::snprintf(text, sizeof text, x >= 10 ? "%.0f" : "%.2g", x);
  return text;
}

// "34 s", "12 min", "3.5 h".
inline std::string format_duration(double s) {
  char text[40];
  if (s < 100)
    std::snprintf(text, sizeof text, "%.0f s", s);
  else if (s < 100 * 60)
    std::snprintf(text, sizeof text, "%.0f min", s / 60);
  else
    std::snprintf(text, sizeof text, "%.1f h", s / 3600);
  return text;
}

// A line on a terminal that is written over and over.
class ProgressLine {
 public:
  explicit ProgressLine(const std::string& start) : start_(start), began_(Clock::now()) {}

  void show(std::size_t done, std::size_t total) {
    const Clock::time_point now = Clock::now();
    constexpr std::chrono::milliseconds kLeast{100};
    if (done < total && n_shown_ > 0 && now - shown_ < kLeast) return;
    shown_ = now, ++n_shown_;
    const double s = std::chrono::duration<double>(now - began_).count();
    std::string text = start_ + " " + std::to_string(done) + " of " + std::to_string(total);
    if (done > 0 && s > 0.5) {
      const double rate = static_cast<double>(done) / s;
      text += ", " + format_rate(rate) + "/s";
      if (done < total)
        text += ", " + format_duration(static_cast<double>(total - done) / rate) + " left";
      else
        text += ", " + format_duration(s);
    }
    const std::size_t width = text.size();
    if (width < width_) text.append(width_ - width, ' ');
    width_ = width;
    std::fprintf(stderr, "\r%s%s", text.c_str(), done == total ? "\n" : "");
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::string start_;
  Clock::time_point began_, shown_;
  std::size_t n_shown_ = 0, width_ = 0;
};

}  // namespace viewcell

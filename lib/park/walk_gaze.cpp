#include "park/walk_gaze.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viewcell {
namespace {

constexpr double kTurnWeight = 0.01;  // loss of interest for turning by one direction, square law

double wrap(double angle) {
  return std::remainder(angle, 2 * std::numbers::pi);
}

// For each direction, its interest less what it loses for being off the heading.
std::vector<double> value_of(const Prospect& prospect, double ahead_weight) {
  std::vector<double> value = prospect.interest;
  const double step = 2 * std::numbers::pi / static_cast<double>(value.size());
  for (std::size_t d = 0; d < value.size(); ++d) {
    const double off =
        wrap(static_cast<double>(d) * step - prospect.heading_rad) / (std::numbers::pi / 3);
    value[d] -= ahead_weight * off * off;
  }
  return value;
}

// The best sequence of directions: best[d] = value of the best one that ends in d.
std::vector<int> best_sequence(std::span<const Prospect> prospects, const GazeOptions& options) {
  const int n = static_cast<int>(prospects[0].interest.size());
  const int most =
      std::max(1, static_cast<int>(options.max_turn_deg_s * options.step_s / (360.0 / n)));
  std::vector<std::vector<int>> from;
  std::vector<double> best = value_of(prospects[0], options.ahead_weight);
  for (std::size_t t = 1; t < prospects.size(); ++t) {
    const std::vector<double> value = value_of(prospects[t], options.ahead_weight);
    std::vector<double> next(best.size(), -1e300);
    from.emplace_back(best.size());
    for (int d = 0; d < n; ++d)
      for (int turn = -most; turn <= most; ++turn) {
        const int before = ((d - turn) % n + n) % n;
        const double sum = best[static_cast<std::size_t>(before)] - kTurnWeight * turn * turn;
        if (sum <= next[static_cast<std::size_t>(d)]) continue;
        next[static_cast<std::size_t>(d)] = sum;
        from.back()[static_cast<std::size_t>(d)] = before;
      }
    for (std::size_t d = 0; d < best.size(); ++d) best[d] = next[d] + value[d];
  }
  std::vector<int> sequence{
      static_cast<int>(std::max_element(best.begin(), best.end()) - best.begin())};
  for (std::size_t t = from.size(); t-- > 0;)
    sequence.push_back(from[t][static_cast<std::size_t>(sequence.back())]);
  std::reverse(sequence.begin(), sequence.end());
  return sequence;
}

}  // namespace

std::vector<double> choose_gaze(std::span<const Prospect> prospects, const GazeOptions& options) {
  const double step = 2 * std::numbers::pi / static_cast<double>(prospects[0].interest.size());
  std::vector<double> yaw;
  for (const int d : best_sequence(prospects, options)) {
    const double angle = d * step;
    yaw.push_back(yaw.empty() ? angle : yaw.back() + wrap(angle - yaw.back()));
  }
  for (int round = 0; round < 4; ++round) {
    std::vector<double> smooth = yaw;
    for (std::size_t i = 1; i + 1 < yaw.size(); ++i)
      smooth[i] = 0.25 * yaw[i - 1] + 0.5 * yaw[i] + 0.25 * yaw[i + 1];
    yaw = std::move(smooth);
  }
  return yaw;
}

}  // namespace viewcell

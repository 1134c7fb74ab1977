// The direction in which a walker looks.
#pragma once

#include <span>
#include <vector>

namespace viewcell {

/// What there is to see at one moment.
struct Prospect {
  double heading_rad = 0;        ///< the way the walker goes
  std::vector<double> interest;  ///< per direction, 2 pi / size() apart from the +x axis
};

struct GazeOptions {
  double step_s = 0.5;  ///< between prospects
  double max_turn_deg_s = 35;
  double ahead_weight = 0.8;  ///< loss of interest at 60 degrees off the heading; square law
};

/// The yaw at each moment: of all sequences of directions that turn slowly enough, the one with the
/// greatest sum of interest (dynamic programming), smoothed. Unwrapped: neighbours differ by turns.
std::vector<double> choose_gaze(std::span<const Prospect> prospects,
                                const GazeOptions& options = {});

}  // namespace viewcell

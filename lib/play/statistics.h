// A run's timeline in a few numbers: the report of `play --stats`.
#pragma once

#include <span>

#include "base/json.h"
#include "play/timeline.h"

namespace viewcell {

struct Summary {
  double mean = 0, median = 0, min = 0, max = 0;
  double p5 = 0, p95 = 0, p99 = 0;
};

/// Percentiles interpolate linearly between the values around (n - 1) p. Of no values: all NaN.
Summary summarize(std::span<const double> values);

/// The contract of `play --stats` (docs/formats.md). PSNR keys carry beside mean, min and p5 the dB
/// of the mean squared error, "of_mse"; frames in which nothing is covered do not count for covered
/// dB. speedup: X_over_Y is the mean time of Y over that of X, for X = hybrid and every other mode,
/// where hybrid was played. floor_ms: of FloorQuad.
Json make_statistics(const Timeline& timeline);

/// The table of modes for people: one line a mode, times, triangles, dB over the yardstick.
std::string format_mode_table(const Timeline& timeline);
/// The same as a Markdown table, with what it was measured on, speedups and rays a second.
std::string format_markdown(const Timeline& timeline);

}  // namespace viewcell

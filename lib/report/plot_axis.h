// The axes of a plot: which stretch they show, where values come to lie, where ticks stand.
#pragma once

#include <string>
#include <vector>

namespace viewcell {

/// The smallest and largest of what an axis shows.
struct ValueRange {
  double lo = 1e300, hi = -1e300;
  bool is_empty() const { return lo > hi; }
  void add(double value);
};

struct AxisOptions {
  bool log = false;       ///< equal factors are equal steps; the range must be above 0
  double at_lo = 0;       ///< px of the lower end
  double at_hi = 1;       ///< px of the upper end; may be the smaller number
  double tick_px = 40;    ///< the least distance of ticks
  bool round_out = true;  ///< widen to 1, 2 or 5 times a power of ten, and to 0 when that is near
};

struct PlotAxis {
  double lo = 0, hi = 1;  ///< of what is plotted: the logarithm, for a log axis
  double at_lo = 0, at_hi = 1;
  bool log = false;
  std::vector<double> ticks;  ///< increasing; 1, 2 or 5 times a power of ten, or multiples of that
  std::vector<std::string> labels;  ///< of the ticks: "0.5", "20k", "1.2M"

  /// px; values outside come to the nearer end.
  double at(double value) const;
};

/// An empty range shows [0, 1], or [1, 10] for a log axis; a single value some room about it.
PlotAxis make_axis(ValueRange range, const AxisOptions& options);

}  // namespace viewcell

#include "report/plot_axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"

namespace viewcell {
namespace {

constexpr double kSlack = 1e-9;    // of a span: what rounding may move a tick beyond an end
constexpr double kNearZero = 0.3;  // an axis from below this share of its upper end starts at 0

// 1, 2 or 5 times a power of ten: the step that cuts `span` into at most `n_most` parts.
double nice_step(double span, double n_most) {
  const double rough = span / n_most;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * (1 - kSlack)) return factor * power;
  return 10 * power;
}

std::vector<double> multiples(double step, double lo, double hi) {
  std::vector<double> ticks;
  const double slack = kSlack * (hi - lo);
  for (double k = std::ceil((lo - slack) / step); k * step <= hi + slack; ++k)
    ticks.push_back(k * step + 0.0);  // -0 to 0
  return ticks;
}

// Factors times 10^(n_decades k), within [lo, hi], which are logarithms.
std::vector<double> log_multiples(const std::vector<double>& factors, double n_decades, double lo,
                                  double hi) {
  std::vector<double> ticks;
  for (double e = n_decades * std::floor(lo / n_decades); e <= hi + kSlack; e += n_decades)
    for (const double factor : factors) {
      const double value = factor * std::pow(10, e);
      const double v = std::log10(value);
      if (v >= lo - kSlack && v <= hi + kSlack) ticks.push_back(value);
    }
  return ticks;
}

// As many as find room: 1, 2, 5, 10, ...; powers of ten; every second power, ...
std::vector<double> choose_log_ticks(const PlotAxis& axis, double tick_px) {
  const double decade_px = std::abs(axis.at_hi - axis.at_lo) / (axis.hi - axis.lo);
  if (decade_px * std::log10(2) >= tick_px) return log_multiples({1, 2, 5}, 1, axis.lo, axis.hi);
  return log_multiples({1}, std::ceil(tick_px / decade_px), axis.lo, axis.hi);
}

// "1.2M" for 1200000; so many digits.
std::string format_tick(double x, int n_digits) {
  const double size = std::abs(x);
  const double unit = size >= 1e6 * (1 - kSlack) ? 1e6 : size >= 1e3 * (1 - kSlack) ? 1e3 : 1;
  char text[400];
  std::snprintf(text, sizeof text, "%.*g%s", n_digits, x / unit,
                unit == 1e6   ? "M"
                : unit == 1e3 ? "k"
                              : "");
  return text;
}

// So many digits that neighbours differ.
int count_digits(const std::vector<double>& ticks) {
  if (ticks.size() < 2) return 6;
  const double step = ticks[1] - ticks[0];
  const double most = std::max(std::abs(ticks.front()), std::abs(ticks.back()));
  return std::clamp(static_cast<int>(std::ceil(std::log10(most / step))) + 2, 6, 14);
}

// Room about a single value; what is as good as one, too.
ValueRange widen(ValueRange range, bool log) {
  if (log) {
    if (range.is_empty()) return {1, 10};
    if (range.hi < range.lo * (1 + 1e-6)) return {range.lo / 1.5, range.hi * 1.5};
    return range;
  }
  if (range.is_empty()) return {0, 1};
  const double size = std::max(std::abs(range.lo), std::abs(range.hi));
  if (range.hi - range.lo > 1e-9 * size) return range;
  const double room = size > 0 ? 0.1 * size : 0.5;
  return {range.lo - room, range.hi + room};
}

void round_out_linear(double n_most, PlotAxis& axis) {
  if (axis.lo > 0 && axis.lo < kNearZero * axis.hi) axis.lo = 0;
  const double step = nice_step(axis.hi - axis.lo, n_most);
  axis.lo = step * std::floor(axis.lo / step + kSlack);
  axis.hi = step * std::ceil(axis.hi / step - kSlack);
}

// Outward to 1, 2 or 5 times a power of ten.
void round_out_log(PlotAxis& axis) {
  const double lo = axis.lo, hi = axis.hi;
  for (const double value : log_multiples({1, 2, 5}, 1, lo - 1, lo)) axis.lo = std::log10(value);
  axis.hi = std::log10(log_multiples({1, 2, 5}, 1, hi, hi + 1).front());
}

}  // namespace

void ValueRange::add(double value) {
  lo = std::min(lo, value);
  hi = std::max(hi, value);
}

double PlotAxis::at(double value) const {
  const double v = log ? std::log10(value) : value;
  return at_lo + (std::clamp(v, lo, hi) - lo) / (hi - lo) * (at_hi - at_lo);
}

PlotAxis make_axis(ValueRange range, const AxisOptions& options) {
  range = widen(range, options.log);
  VIEWCELL_CHECK(!options.log || range.lo > 0, range.lo, range.hi);
  PlotAxis axis{range.lo, range.hi, options.at_lo, options.at_hi, options.log, {}, {}};
  const double n_most = std::max(1.0, std::abs(axis.at_hi - axis.at_lo) / options.tick_px);
  if (options.log) {
    axis.lo = std::log10(axis.lo), axis.hi = std::log10(axis.hi);
    if (options.round_out) round_out_log(axis);
    axis.ticks = choose_log_ticks(axis, options.tick_px);
    const double lo = std::pow(10, axis.lo), hi = std::pow(10, axis.hi);
    // Within a decade 1, 2, 5 may be too few to read values from.
    if (axis.ticks.size() < 2) axis.ticks = multiples(nice_step(hi - lo, n_most / 2), lo, hi);
  } else {
    if (options.round_out) round_out_linear(n_most, axis);
    axis.ticks = multiples(nice_step(axis.hi - axis.lo, n_most), axis.lo, axis.hi);
  }
  for (const double tick : axis.ticks)
    axis.labels.push_back(format_tick(tick, options.log ? 6 : count_digits(axis.ticks)));
  return axis;
}

}  // namespace viewcell

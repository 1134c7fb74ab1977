// Line plots as SVG: one panel or a few side by side, one legend.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace viewcell {

struct PlotLine {
  std::string name;   ///< lines of one name, in several panels, stand in the legend once
  std::string color;  ///< as SVG has it, "#0072b2"; empty: the next of eight, and then dashed
  bool dashed = false;
  std::vector<double> x, y;  ///< as many of both; one that is not finite breaks the line
};

enum class PlotStyle {
  lines,   ///< a point between two breaks shows as a dot
  points,  ///< lines with a mark at every point, of another shape for each line
  steps    ///< y holds from its x to the next; at the last, as far as at the one before
};

struct PlotPanel {
  std::string title;
  std::string x_label, y_label;
  std::vector<PlotLine> lines;
  std::vector<double> marks;  ///< thin vertical lines, at x
  /// Values that are not positive break the line, but for those below a y_least above 0.
  bool log_x = false, log_y = false;
  double y_least = -1e300;  ///< values below are drawn at the lower edge
  double y_most = 1e300;    ///< values above are drawn at the upper edge
};

struct Plot {
  std::string title;
  std::vector<PlotPanel> panels;  ///< 1 to kMostPanels
  std::string mark_label;         ///< what PlotPanel::marks are, for the legend
  PlotStyle style = PlotStyle::lines;
};

inline constexpr std::size_t kMostPanels = 4;

/// Points of all lines that do not break them.
std::size_t count_points(const PlotPanel& panel);
/// Points of all lines whose coordinates are numbers.
std::size_t count_numbers(const PlotPanel& panel);

/// 960 px wide, no scripts, no external fonts. Values beyond 1e100 break a line as well. The same
/// plot gives the same bytes.
std::string format_svg(const Plot& plot);

}  // namespace viewcell

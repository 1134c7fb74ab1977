// Line plots along the camera path, as SVG.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "play/timeline.h"

namespace viewcell {

struct PlotLine {
  std::string name;
  std::string color;  ///< as SVG has it: "#0072b2"
  bool dashed = false;
  std::vector<double> y;  ///< one a place of LinePlot::x; NaN breaks the line
};

struct LinePlot {
  std::string title, x_label, y_label;
  std::vector<double> x;  ///< increasing
  std::vector<PlotLine> lines;
  std::vector<double> marks;  ///< thin vertical lines
  std::string mark_label;     ///< what the marks are, for the caption
  bool log_y = false;         ///< values that are not positive are left out
  double y_most = 1e300;      ///< values above are drawn at the upper edge and do not stretch it
};

/// 960 x 420, no scripts, no external fonts. The same plot gives the same bytes.
std::string format_svg(const LinePlot& plot);

/// frame_ms.svg, triangles.svg, psnr.svg, psnr_covered.svg into the folder, which is made: every
/// mode in each, the reference left out of the PSNR, the yardstick dashed. Marks: changes of cell.
void write_plots(const std::filesystem::path& folder, const Timeline& timeline);

}  // namespace viewcell

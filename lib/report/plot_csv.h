// Plots out of tables in long form: a row holds one point of a line.
#pragma once

#include <string>
#include <vector>

#include "report/csv.h"
#include "report/plot.h"

namespace viewcell {

struct CsvPlotOptions {
  std::string x;               ///< column
  std::vector<std::string> y;  ///< columns, a panel each; at most kMostPanels
  std::string by;              ///< column whose values name the lines; empty: one line, named by y
  std::string title;
  std::string x_label;  ///< empty: the column's name
  std::string y_label;  ///< empty: the column's name where there is one panel, none where more
  bool log_x = false, log_y = false;
  double y_least = -1e300, y_most = 1e300;  ///< as in PlotPanel
  PlotStyle style = PlotStyle::lines;
};

/// Lines in the order in which their names first stand in the table, points in the order of rows.
/// Throws InputError where a column is missing, a field is no number, there are no rows or no point
/// can be drawn, or the x of steps do not grow along a line.
Plot make_csv_plot(const CsvTable& table, const CsvPlotOptions& options);

}  // namespace viewcell

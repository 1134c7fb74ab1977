#include "report/plot_csv.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace viewcell {
namespace {

// A line's name and its rows.
struct Group {
  std::string name;
  std::vector<std::size_t> rows;
};

std::vector<Group> group_rows(const CsvTable& table, const CsvPlotOptions& options,
                              const std::string& y) {
  std::vector<Group> groups;
  const bool is_split = !options.by.empty();
  const std::size_t by = is_split ? find_column(table, options.by) : 0;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string& name = is_split ? table.rows[r][by] : y;
    auto group =
        std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.name == name; });
    if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
    group->rows.push_back(r);
  }
  return groups;
}

void check_steps(const CsvTable& table, const std::vector<std::size_t>& rows,
                 const std::vector<double>& x) {
  for (std::size_t k = 1; k < rows.size(); ++k)
    if (!(x[rows[k]] > x[rows[k - 1]]))
      throw InputError(table.file.string(), "line " + std::to_string(table.lines[rows[k]]),
                       "x does not grow from the step before");
}

PlotPanel make_panel(const CsvTable& table, const CsvPlotOptions& options, const std::string& y) {
  PlotPanel panel;
  const bool is_alone = options.y.size() == 1;
  if (!is_alone) panel.title = y;
  panel.x_label = options.x_label.empty() ? options.x : options.x_label;
  panel.y_label = options.y_label.empty() && is_alone ? y : options.y_label;
  panel.log_x = options.log_x, panel.log_y = options.log_y;
  panel.y_least = options.y_least, panel.y_most = options.y_most;
  const std::vector<double> xs = read_numbers(table, find_column(table, options.x));
  const std::vector<double> ys = read_numbers(table, find_column(table, y));
  for (const Group& group : group_rows(table, options, y)) {
    if (options.style == PlotStyle::steps) check_steps(table, group.rows, xs);
    PlotLine line;
    line.name = group.name;
    for (const std::size_t r : group.rows) {
      line.x.push_back(xs[r]);
      line.y.push_back(ys[r]);
    }
    panel.lines.push_back(std::move(line));
  }
  return panel;
}

}  // namespace

Plot make_csv_plot(const CsvTable& table, const CsvPlotOptions& options) {
  if (table.rows.empty()) throw InputError(table.file.string(), "", "has no rows");
  Plot plot;
  plot.title = options.title;
  plot.style = options.style;
  for (const std::string& y : options.y) plot.panels.push_back(make_panel(table, options, y));
  for (std::size_t k = 0; k < plot.panels.size(); ++k)
    if (count_points(plot.panels[k]) == 0)
      throw InputError(table.file.string(), options.y[k],
                       std::string("has no point to draw") +
                           (options.log_x || options.log_y ? " on logarithmic axes" : ""));
  return plot;
}

}  // namespace viewcell

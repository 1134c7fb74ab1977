// plot: lines out of a table, as SVG.
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "common/tool.h"
#include "report/plot_csv.h"

namespace viewcell {
namespace {

struct Arguments {
  std::string table;
  bool points = false, steps = false;
  CsvPlotOptions options;
};

void declare(Tool& tool, Arguments& arguments) {
  CsvPlotOptions& o = arguments.options;
  tool.add_option("CSV", &arguments.table,
                  "comma-separated values with a header, a row a point (-: standard input); empty "
                  "fields and nan break a line")
      .required()
      .reads("the table that is read");
  tool.add_option("--x", &o.x, "column of what runs to the right").required();
  tool.add_option("--y", &o.y, "column of what goes up; several: panels side by side")
      .required()
      .list(static_cast<int>(kMostPanels));
  tool.add_option("--by", &o.by, "column whose values name the lines (default: one line)");
  tool.add_flag("--log-x", &o.log_x, "equal factors are equal steps; for numbers above 0");
  tool.add_flag("--log-y", &o.log_y, "the same upward");
  tool.add_option("--y-least", &o.y_least, "draw smaller values at the lower edge")
      .check(within(-1e100, 1e100));
  tool.add_option("--y-most", &o.y_most, "draw larger values at the upper edge")
      .check(within(-1e100, 1e100));
  tool.add_flag("--points", &arguments.points, "a mark at every point");
  tool.add_flag("--steps", &arguments.steps,
                "y holds from its x to the next, as in a histogram; x is where a bin begins")
      .excludes("--points");
  tool.add_option("--title", &o.title, "above the plot");
  tool.add_option("--x-label", &o.x_label, "below the axis (default: the column's name)");
  tool.add_option("--y-label", &o.y_label, "beside the axis (default: the column's name)");
  tool.add_output("SVG to write; -: standard output");
}

// What the command line alone shows to be wrong.
void settle_options(const Tool& tool, Arguments& arguments) {
  CsvPlotOptions& o = arguments.options;
  o.style = arguments.points  ? PlotStyle::points
            : arguments.steps ? PlotStyle::steps
                              : PlotStyle::lines;
  if (o.y_least >= o.y_most) throw UsageError("--y-least is not below --y-most");
  if (o.log_y && !(o.y_most > 0)) throw UsageError("--y-most is not above 0, as --log-y needs");
  if (std::set<std::string>(o.y.begin(), o.y.end()).size() < o.y.size())
    throw UsageError("--y names a column twice");
  check_ending({"-o", tool.common().output}, {".svg"}, "an SVG");
}

Json format_panels(const Plot& plot, const CsvPlotOptions& options) {
  Json panels = Json::array();
  for (std::size_t k = 0; k < plot.panels.size(); ++k)
    panels.push_back({{"y", options.y[k]},
                      {"lines", plot.panels[k].lines.size()},
                      {"points", count_points(plot.panels[k])}});
  return panels;
}

int run(const Tool& tool, const Arguments& arguments) {
  const CsvTable table = parse_csv(read_file(arguments.table), arguments.table);
  const Plot plot = make_csv_plot(table, arguments.options);
  write_file(tool.common().output, format_svg(plot));
  const CsvPlotOptions& options = arguments.options;
  std::size_t n_off = 0;
  for (const PlotPanel& panel : plot.panels) n_off += count_numbers(panel) - count_points(panel);
  if (n_off > 0 && (options.log_x || options.log_y))
    tool.remark(arguments.table,
                {{"points that are not above 0, where a logarithmic axis has no place", n_off}});
  tool.report({{"rows", table.rows.size()}, {"panels", format_panels(plot, arguments.options)}});
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "plot",
      "Draws lines out of a table in long form (a row holds one point of a line) as SVG: one panel "
      "or several, one legend.",
      "plot curves.csv --x faces --y max,mean,rms --by metric --log-x --log-y --points "
      "--title \"Bunny head\" -o curves.svg\n"
      "  plot histogram.csv --x from --y percent --by metric --steps -o histogram.svg");
  viewcell::Arguments arguments;
  viewcell::declare(tool, arguments);
  return tool.main(
      argc, argv, [&] { viewcell::settle_options(tool, arguments); },
      [&] { return viewcell::run(tool, arguments); });
}

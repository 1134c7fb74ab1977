#include "report/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/error.h"
#include "report/plot_axis.h"
#include "report/svg.h"

namespace viewcell {
namespace {

constexpr double kWidth = 960, kMargin = 16;
constexpr double kFirstLeft = 72, kNextLeft = 52;  // at least, of axes, from what is left of them
constexpr double kTitleHeight = 40, kLegendLine = 20, kPanelTitle = 22, kBelow = 52;
constexpr double kMostDrawn = 1e100;  // sums and factors of such values are finite

// Okabe and Ito 2008: told apart by readers who confuse red and green. Its yellow is too pale.
constexpr std::array<const char*, 8> kColors{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                             "#e69f00", "#56b4e9", "#000000", "#888888"};
constexpr const char* kMarkColor = "#b8c4d6";

// --- lines, as they are drawn ---

struct LineStyle {
  std::string name, color, dashes;
  std::size_t place = 0;
};

LineStyle make_style(const PlotLine& line, std::size_t place) {
  const std::size_t round = place / kColors.size();
  LineStyle style{line.name, line.color, "", place};
  if (line.color.empty()) {
    style.color = kColors[place % kColors.size()];
    if (round % 3 > 0) style.dashes = round % 3 == 1 ? "6 4" : "2 3";
  }
  if (line.dashed) style.dashes = "5 4";
  return style;
}

// A style a name, in the order of the lines.
std::vector<LineStyle> collect_styles(const Plot& plot) {
  std::vector<LineStyle> styles;
  std::set<std::string> seen;
  for (const PlotPanel& panel : plot.panels)
    for (const PlotLine& line : panel.lines)
      if (seen.insert(line.name).second) styles.push_back(make_style(line, styles.size()));
  return styles;
}

const LineStyle& style_of(const PlotLine& line, const std::vector<LineStyle>& styles) {
  return *std::find_if(styles.begin(), styles.end(),
                       [&](const LineStyle& s) { return s.name == line.name; });
}

std::string stroke(const LineStyle& style, double width) {
  return "stroke=\"" + style.color + "\" stroke-width=\"" + svg_number(width) + "\"" +
         (style.dashes.empty() ? "" : " stroke-dasharray=\"" + style.dashes + "\"");
}

// --- marks at points ---

// Shapes of about the same area, all told apart when they are small.
const char* mark_path(std::size_t shape) {
  switch (shape % 6) {
    case 0:
      return "M3.3 0A3.3 3.3 0 1 1 -3.3 0A3.3 3.3 0 1 1 3.3 0Z";  // a disk
    case 1:
      return "M-2.8 -2.8H2.8V2.8H-2.8Z";
    case 2:
      return "M0 -3.8L3.5 2.5H-3.5Z";
    case 3:
      return "M0 -3.9L3.9 0L0 3.9L-3.9 0Z";
    case 4:
      return "M0 3.8L3.5 -2.5H-3.5Z";
    default:
      return "M-4 -1.4H-1.4V-4H1.4V-1.4H4V1.4H1.4V4H-1.4V1.4H-4Z";
  }
}

std::string mark_name(const LineStyle& style) {
  return "mark-" + std::to_string(style.place);
}

// What paths refer to: a mark a line.
std::string define_marks(const std::vector<LineStyle>& styles) {
  std::string out = "<defs>\n";
  for (const LineStyle& style : styles)
    out += "<marker id=\"" + mark_name(style) +
           "\" markerUnits=\"userSpaceOnUse\" overflow=\"visible\"><path d=\"" +
           mark_path(style.place) + "\" fill=\"" + style.color + "\"/></marker>\n";
  return out + "</defs>\n";
}

// --- a panel ---

struct PanelBox {
  double left = 0, right = 0, top = 0, bottom = 0;  // of the axes
  bool is_first = false;
};

bool is_drawable(double value, bool log) {
  return std::isfinite(value) && std::abs(value) <= kMostDrawn && (!log || value >= 1 / kMostDrawn);
}

bool is_drawn(const PlotPanel& panel, const PlotLine& line, std::size_t i) {
  const bool is_at_edge = panel.log_y && panel.y_least > 0 && line.y[i] < panel.y_least;
  return is_drawable(line.x[i], panel.log_x) && is_drawable(line.y[i], panel.log_y && !is_at_edge);
}

// Where the step of point i ends.
double step_end(const PlotPanel& panel, const PlotLine& line, std::size_t i) {
  const std::size_t n = line.x.size();
  if (i + 1 < n) return line.x[i + 1];
  if (n < 2) return line.x[i];
  const double before = line.x[n - 2], last = line.x[n - 1];
  return panel.log_x ? last * (last / before) : last + (last - before);
}

struct PanelAxes {
  PlotAxis x, y;
};

PlotAxis make_x_axis(const PlotPanel& panel, const PanelBox& box, PlotStyle style) {
  ValueRange range;
  for (const PlotLine& line : panel.lines)
    for (std::size_t i = 0; i < line.x.size(); ++i) {
      if (!is_drawn(panel, line, i)) continue;
      range.add(line.x[i]);
      const double end = step_end(panel, line, i);
      if (style == PlotStyle::steps && is_drawable(end, panel.log_x)) range.add(end);
    }
  return make_axis(range, {panel.log_x, box.left, box.right, panel.log_x ? 36.0 : 60.0, false});
}

PlotAxis make_y_axis(const PlotPanel& panel, double top, double bottom, PlotStyle style) {
  ValueRange range;
  for (const PlotLine& line : panel.lines)
    for (std::size_t i = 0; i < line.x.size(); ++i)
      if (is_drawn(panel, line, i)) range.add(std::clamp(line.y[i], panel.y_least, panel.y_most));
  if (panel.log_y && !(range.lo > 0)) range = {};  // y_most is not above 0
  if (style == PlotStyle::steps && !panel.log_y) range.add(0);
  return make_axis(range, {panel.log_y, bottom, top, panel.log_y ? 20.0 : 36.0, true});
}

std::string draw_axes(const PlotPanel& panel, const PanelBox& box, const PanelAxes& axes) {
  std::string out;
  for (std::size_t k = 0; k < axes.y.ticks.size(); ++k) {
    const double y = axes.y.at(axes.y.ticks[k]);
    out += svg_line(box.left, y, box.right, y, "stroke=\"#e4e4e4\"");
    out += svg_text(box.left - 8, y + 4, "end", axes.y.labels[k]);
  }
  for (std::size_t k = 0; k < axes.x.ticks.size(); ++k) {
    const double x = axes.x.at(axes.x.ticks[k]);
    out += svg_line(x, box.bottom, x, box.bottom + 5, "stroke=\"#888\"");
    out += svg_text(x, box.bottom + 19, "middle", axes.x.labels[k]);
  }
  for (const double mark : panel.marks)
    out += svg_line(axes.x.at(mark), box.top, axes.x.at(mark), box.bottom,
                    std::string("stroke=\"") + kMarkColor + "\"");
  out += svg_line(box.left, box.bottom, box.right, box.bottom, "stroke=\"#888\"");
  out += svg_line(box.left, box.top, box.left, box.bottom, "stroke=\"#888\"");
  return out;
}

std::string draw_words(const PlotPanel& panel, const PanelBox& box) {
  const double middle = 0.5 * (box.left + box.right);
  std::string out = svg_text(middle, box.bottom + 40, "middle", panel.x_label);
  if (!panel.title.empty())
    out += svg_text(middle, box.top - 8, "middle", panel.title, "font-weight=\"bold\"");
  if (!panel.y_label.empty() && box.is_first)
    out += "<text transform=\"translate(18 " + svg_number(0.5 * (box.top + box.bottom)) +
           ") rotate(-90)\" text-anchor=\"middle\">" + svg_escape(panel.y_label) + "</text>\n";
  return out;
}

// What PlotAxis::at does not clamp: a logarithm needs a number above 0.
double clamp_y(const PlotPanel& panel, double y) {
  return std::clamp(y, panel.y_least, panel.y_most);
}

std::string trace_line(const PlotPanel& panel, const PlotLine& line, const PanelAxes& axes,
                       PlotStyle kind) {
  std::string path;
  const auto add = [&](char verb, double x, double y) {
    path += (path.empty() ? "" : " ") + std::string(1, verb) + svg_number(axes.x.at(x)) + " " +
            svg_number(axes.y.at(y));
  };
  bool is_broken = true;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (is_drawn(panel, line, i)) {
      add(is_broken ? 'M' : 'L', line.x[i], clamp_y(panel, line.y[i]));
      const double end = step_end(panel, line, i);
      if (kind == PlotStyle::steps && is_drawable(end, panel.log_x))
        add('L', end, clamp_y(panel, line.y[i]));
    }
    is_broken = !is_drawn(panel, line, i);
  }
  return path;
}

std::string draw_line(const std::string& path, const LineStyle& style, PlotStyle kind) {
  if (path.empty()) return "";
  const std::string mark = "=\"url(#" + mark_name(style) + ")\"";
  return "<path d=\"" + path + "\" fill=\"none\" " + stroke(style, 1.6) +
         " stroke-linejoin=\"round\" stroke-linecap=\"round\"" +
         (kind == PlotStyle::points
              ? " marker-start" + mark + " marker-mid" + mark + " marker-end" + mark
              : "") +
         "/>\n";
}

// Points with breaks, or ends, on both sides: a path shows nothing of them.
std::string draw_dots(const PlotPanel& panel, const PlotLine& line, const PanelAxes& axes,
                      const LineStyle& style) {
  std::string out;
  const std::size_t n = line.x.size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool joins =
        (i > 0 && is_drawn(panel, line, i - 1)) || (i + 1 < n && is_drawn(panel, line, i + 1));
    if (joins || !is_drawn(panel, line, i)) continue;
    out += "<circle cx=\"" + svg_number(axes.x.at(line.x[i])) + "\" cy=\"" +
           svg_number(axes.y.at(clamp_y(panel, line.y[i]))) + "\" r=\"2.5\" fill=\"" + style.color +
           "\"/>\n";
  }
  return out;
}

std::string draw_panel(const Plot& plot, const PlotPanel& panel, const PanelBox& box,
                       const PlotAxis& y, const std::vector<LineStyle>& styles) {
  const PanelAxes axes{make_x_axis(panel, box, plot.style), y};
  std::string out = draw_axes(panel, box, axes) + draw_words(panel, box);
  for (const PlotLine& line : panel.lines) {
    const LineStyle& style = style_of(line, styles);
    out += draw_line(trace_line(panel, line, axes, plot.style), style, plot.style);
    if (plot.style == PlotStyle::lines) out += draw_dots(panel, line, axes, style);
  }
  if (count_points(panel) == 0)
    out += svg_text(0.5 * (box.left + box.right), 0.5 * (box.top + box.bottom), "middle",
                    "nothing was measured");
  return out;
}

double widest_label(const PlotAxis& axis) {
  double widest = 0;
  for (const std::string& label : axis.labels) widest = std::max(widest, svg_text_width(label));
  return widest;
}

// Side by side, of one width, with room for the labels of the y axes.
std::vector<PanelBox> place_panels(const std::vector<PlotAxis>& ys, double top, double bottom) {
  double first = kFirstLeft, next = kNextLeft;
  for (std::size_t k = 0; k < ys.size(); ++k) {
    double& gap = k == 0 ? first : next;
    gap = std::max(gap, widest_label(ys[k]) + (k == 0 ? 36 : 20));
  }
  const auto n = static_cast<double>(ys.size());
  const double width = (kWidth - kMargin - first - (n - 1) * next) / n;
  std::vector<PanelBox> boxes;
  for (double left = first; boxes.size() < ys.size(); left += width + next)
    boxes.push_back({left, left + width, top, bottom, boxes.empty()});
  return boxes;
}

// --- what stands above the panels ---

struct Legend {
  std::string svg;
  double bottom = 0;
};

Legend draw_legend(const Plot& plot, const std::vector<LineStyle>& styles, double left) {
  Legend legend;
  double x = left, y = kTitleHeight + 8;
  const auto place = [&](const std::string& name, const std::string& attributes) {
    const double width = 30 + svg_text_width(name) + 20;
    if (x > left && x + width > kWidth) x = left, y += kLegendLine;
    // Three corners: a mark at the middle one.
    legend.svg += "<polyline points=\"" + svg_number(x) + "," + svg_number(y) + " " +
                  svg_number(x + 12) + "," + svg_number(y) + " " + svg_number(x + 24) + "," +
                  svg_number(y) + "\" fill=\"none\" " + attributes + "/>\n" +
                  svg_text(x + 30, y + 4, "start", name);
    x += width;
  };
  for (const LineStyle& style : styles)
    place(style.name, stroke(style, 2.4) + (plot.style == PlotStyle::points
                                                ? " marker-mid=\"url(#" + mark_name(style) + ")\""
                                                : ""));
  const bool has_marks = std::any_of(plot.panels.begin(), plot.panels.end(),
                                     [](const PlotPanel& panel) { return !panel.marks.empty(); });
  if (has_marks) place(plot.mark_label, std::string("stroke=\"") + kMarkColor + "\"");
  legend.bottom = y + kLegendLine;
  return legend;
}

std::string draw_title(const std::string& title, double left) {
  const double room = (kWidth - kMargin - left) / std::max(1.0, svg_text_width(title, 1.1));
  return svg_text(left, 28, "start", title,
                  "font-size=\"" + svg_number(std::min(16.0, room)) + "\" font-weight=\"bold\"");
}

void check(const Plot& plot) {
  VIEWCELL_CHECK(!plot.panels.empty() && plot.panels.size() <= kMostPanels, plot.panels.size());
  for (const PlotPanel& panel : plot.panels)
    for (const PlotLine& line : panel.lines)
      VIEWCELL_CHECK(line.x.size() == line.y.size(), line.name, line.x.size(), line.y.size());
}

}  // namespace

std::size_t count_points(const PlotPanel& panel) {
  std::size_t n = 0;
  for (const PlotLine& line : panel.lines)
    for (std::size_t i = 0; i < line.x.size(); ++i) n += is_drawn(panel, line, i);
  return n;
}

std::size_t count_numbers(const PlotPanel& panel) {
  std::size_t n = 0;
  for (const PlotLine& line : panel.lines)
    for (std::size_t i = 0; i < line.x.size(); ++i)
      n += is_drawable(line.x[i], false) && is_drawable(line.y[i], false);
  return n;
}

std::string format_svg(const Plot& plot) {
  check(plot);
  const std::vector<LineStyle> styles = collect_styles(plot);
  const Legend legend = draw_legend(plot, styles, kFirstLeft);
  const bool has_titles = std::any_of(plot.panels.begin(), plot.panels.end(),
                                      [](const PlotPanel& panel) { return !panel.title.empty(); });
  const double top = legend.bottom + (has_titles ? kPanelTitle : 0);
  const double bottom = top + (plot.panels.size() > 1 ? 270 : 310);
  std::vector<PlotAxis> ys;
  for (const PlotPanel& panel : plot.panels)
    ys.push_back(make_y_axis(panel, top, bottom, plot.style));
  const std::vector<PanelBox> boxes = place_panels(ys, top, bottom);
  std::string content = plot.style == PlotStyle::points ? define_marks(styles) : "";
  content += draw_title(plot.title, kFirstLeft) + legend.svg;
  for (std::size_t k = 0; k < boxes.size(); ++k)
    content += draw_panel(plot, plot.panels[k], boxes[k], ys[k], styles);
  return svg_document(kWidth, bottom + kBelow, plot.title, content);
}

}  // namespace viewcell

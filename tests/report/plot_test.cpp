#include "report/plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/random.h"
#include "report/plot_axis.h"
#include "report/svg.h"

namespace viewcell {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Plot make_plot() {
  PlotPanel panel;
  panel.x_label = "x", panel.y_label = "y";
  panel.lines = {{"one", "#123456", false, {0, 1, 2, 3}, {1, 10, 100, 1000}},
                 {"two", "#654321", true, {0, 1, 2, 3}, {5, kNaN, 5, 5}}};
  panel.marks = {1.5};
  return {"a < b & c", {panel}, "mark", PlotStyle::lines};
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

struct Point {
  double x, y;
};

// The corners of the k-th path of a stroke.
std::vector<Point> path_points(const std::string& svg, int k = 0) {
  std::size_t at = svg.find("<path d=\"");
  for (; k > 0; --k) at = svg.find("<path d=\"", at + 1);
  std::vector<Point> points;
  const char* text = svg.c_str() + at + 9;
  Point p;
  int n = 0;
  while (std::sscanf(text, " %*[ML]%lf %lf%n", &p.x, &p.y, &n) == 2) points.push_back(p), text += n;
  return points;
}

// A value between two that are missing, a lone one, a constant, zeros on a logarithmic axis.
TEST(Plot, LonePointsAreDots) {
  Plot plot = make_plot();
  plot.panels[0].lines = {{"a", "#111111", false, {0, 1, 2, 3, 4}, {1, kNaN, 2, kNaN, 3}},
                          {"b", "#222222", false, {2}, {5}},
                          {"c", "#333333", false, {0, 4}, {5, 5}}};
  const std::string svg = format_svg(plot);
  EXPECT_EQ(count(svg, "<circle "), 4u);
  EXPECT_EQ(count(svg, "r=\"2.5\" fill=\"#111111\""), 3u);
  plot.style = PlotStyle::points;
  EXPECT_EQ(count(format_svg(plot), "<circle "), 0u);  // marks show them
}

TEST(Plot, ZerosOfALogarithmicAxisAreAtTheLeastShown) {
  Plot plot = make_plot();
  plot.panels[0].log_y = true;
  plot.panels[0].lines = {{"a", "#111111", false, {0, 1, 2}, {100, 0, 1000}}};
  EXPECT_EQ(path_points(format_svg(plot)).size(), 2u);  // the zero is left out
  plot.panels[0].y_least = 10;
  const std::vector<Point> points = path_points(format_svg(plot));
  ASSERT_EQ(points.size(), 3u);
  EXPECT_NEAR(points[1].y - points[0].y, points[0].y - points[2].y, 0.2);  // a decade each
}

TEST(Plot, APanelWithoutPointsSaysSo) {
  Plot plot = make_plot();
  plot.panels[0].lines = {{"a", "#111111", false, {0, 1}, {kNaN, kNaN}}};
  EXPECT_EQ(count(format_svg(plot), "nothing was measured"), 1u);
  EXPECT_EQ(count(format_svg(make_plot()), "nothing was measured"), 0u);
}

TEST(Plot, LinesLegendAndMarksAreThere) {
  const std::string svg = format_svg(make_plot());
  EXPECT_EQ(count(svg, "<path "), 2u);
  EXPECT_EQ(count(svg, "stroke=\"#123456\""), 2u);  // line and legend
  EXPECT_NE(svg.find("a &lt; b &amp; c"), std::string::npos);
  EXPECT_EQ(count(svg, "#b8c4d6"), 2u);
  EXPECT_EQ(count(svg, ">mark<"), 1u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.rfind("</svg>\n"), svg.size() - 7);
  EXPECT_EQ(svg, format_svg(make_plot()));
}

TEST(Plot, LinearAxesAreLinear) {
  Plot plot = make_plot();
  plot.panels[0].lines = {{"line", "", false, {0, 1, 4, 10}, {0, 2, 8, 20}}};
  const auto p = path_points(format_svg(plot));
  ASSERT_EQ(p.size(), 4u);
  const double dx = (p[3].x - p[0].x) / 10, dy = (p[3].y - p[0].y) / 20;
  EXPECT_GT(dx, 50);
  EXPECT_LT(dy, -10);  // upward
  for (const int i : {1, 2}) {
    EXPECT_NEAR(p[i].x, p[0].x + dx * (i == 1 ? 1 : 4), 0.11);
    EXPECT_NEAR(p[i].y, p[0].y + dy * (i == 1 ? 2 : 8), 0.11);
  }
}

// Equal factors are equal steps: a power of x is a straight line.
TEST(Plot, LogAxesAreLogarithmic) {
  Plot plot = make_plot();
  PlotPanel& panel = plot.panels[0];
  panel.log_x = panel.log_y = true;
  panel.lines = {{"power", "", false, {2, 20, 200, 2000}, {3, 0.3, 0.03, 0.003}}};
  const auto p = path_points(format_svg(plot));
  ASSERT_EQ(p.size(), 4u);
  for (std::size_t i = 0; i + 2 < 4; ++i) {
    EXPECT_NEAR(p[i + 1].x - p[i].x, p[i + 2].x - p[i + 1].x, 0.21);
    EXPECT_NEAR(p[i + 1].y - p[i].y, p[i + 2].y - p[i + 1].y, 0.21);
  }
  EXPECT_GT(p[3].x, p[0].x + 500);
  EXPECT_GT(p[3].y, p[0].y + 100);  // downward
}

TEST(Plot, WhatIsNoNumberOrNoLogarithmBreaksALine) {
  Plot plot = make_plot();
  const auto n_parts = [&](std::vector<double> x, std::vector<double> y) {
    plot.panels[0].lines = {{"line", "", false, std::move(x), std::move(y)}};
    const std::string svg = format_svg(plot);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    const std::size_t at = svg.find("<path d=\"");
    if (at == std::string::npos) return std::size_t{0};
    return count(svg.substr(at, svg.find("/>", at) - at), "M");
  };
  EXPECT_EQ(n_parts({1, 2, 3, 4}, {5, 5, 5, 5}), 1u);
  EXPECT_EQ(n_parts({1, 2, 3, 4}, {5, kNaN, 5, 5}), 2u);
  EXPECT_EQ(n_parts({1, INFINITY, 3, 4}, {5, 5, 5, 5}), 2u);
  EXPECT_EQ(n_parts({1, 2, 3, 4}, {5, -1e200, 5, 5}), 2u);
  EXPECT_EQ(n_parts({1, 2, 3, 4}, {5, 0, -5, 5}), 1u);
  EXPECT_EQ(n_parts({1, 2, 3, 4}, {kNaN, kNaN, kNaN, kNaN}), 0u);
  plot.panels[0].log_y = true;
  EXPECT_EQ(n_parts({1, 2, 3, 4}, {5, 0, -5, 5}), 2u);
  plot.panels[0].log_x = true;
  EXPECT_EQ(n_parts({-1, 0, 3, 4}, {5, 5, 5, 5}), 1u);
}

TEST(Plot, DegenerateDataStillMakesAPlot) {
  for (const bool log : {false, true}) {
    Plot plot = make_plot();
    PlotPanel& panel = plot.panels[0];
    panel.log_x = panel.log_y = log;
    for (const std::vector<double>& y : std::vector<std::vector<double>>{
             {3}, {0}, {-3}, {kNaN}, {1e100}, {1e-300}, {-1e100, 1e100}, {1e16, 1e16 + 2}, {}}) {
      panel.lines = {{"line", "", false, std::vector<double>(y.size(), 2), y}};
      const std::string svg = format_svg(plot);
      EXPECT_EQ(svg.find("nan"), std::string::npos);
      EXPECT_EQ(svg.find("inf"), std::string::npos);
      EXPECT_LT(svg.size(), 20'000u);
    }
    panel.lines.clear();
    EXPECT_EQ(format_svg(plot).find("nan"), std::string::npos);
  }
}

TEST(Plot, ValuesOverTheMostDoNotStretchTheAxis) {
  Plot plot = make_plot();
  plot.panels[0].lines = {{"db", "", false, {0, 1, 2, 3}, {30, 40, 100, 35}}};
  plot.panels[0].y_most = 50;
  const std::string svg = format_svg(plot);
  EXPECT_EQ(svg.find(">100<"), std::string::npos);
  EXPECT_NE(svg.find(">50<"), std::string::npos);
  plot.panels[0].lines = {{"tiny", "", false, {0, 1, 2, 3}, {1, 2, 1e-9, 3}}};
  plot.panels[0].log_y = true;
  plot.panels[0].y_least = 0.5;
  const auto p = path_points(format_svg(plot));
  ASSERT_EQ(p.size(), 4u);
  EXPECT_GT(p[2].y, p[0].y);
  EXPECT_LT(p[2].y - p[0].y, p[0].y - p[1].y + 1);  // 0.5 is as far below 1 as 2 is above it
}

// y = 1, 4, 2 from x = 0, 1, 3: horizontal to 1, 3 and 5, and down to zero the axis reaches.
TEST(Plot, StepsHoldToTheNextPoint) {
  Plot plot = make_plot();
  plot.style = PlotStyle::steps;
  plot.panels[0].marks.clear();
  plot.panels[0].lines = {{"steps", "", false, {0, 1, 3}, {1, 4, 2}}};
  const std::string svg = format_svg(plot);
  const auto p = path_points(svg);
  ASSERT_EQ(p.size(), 6u);
  const double unit = p[1].x - p[0].x;
  EXPECT_NEAR(p[3].x - p[2].x, 2 * unit, 0.11);
  EXPECT_NEAR(p[5].x - p[4].x, 2 * unit, 0.11);
  for (const std::size_t k : {0, 2, 4}) {
    EXPECT_EQ(p[k].y, p[k + 1].y);
    EXPECT_TRUE(k == 0 || p[k].x == p[k - 1].x);
  }
  EXPECT_NE(svg.find(">0</text>"), std::string::npos);
}

TEST(Plot, PanelsShareALegend) {
  Plot plot = make_plot();
  plot.panels = {plot.panels[0], plot.panels[0], plot.panels[0]};
  for (std::size_t k = 0; k < 3; ++k) {
    plot.panels[k].title = "panel " + std::to_string(k);
    for (PlotLine& line : plot.panels[k].lines) line.color.clear();
  }
  plot.style = PlotStyle::points;
  const std::string svg = format_svg(plot);
  EXPECT_EQ(count(svg, ">one<"), 1u);
  EXPECT_EQ(count(svg, ">mark<"), 1u);
  EXPECT_EQ(count(svg, "<marker "), 2u);
  EXPECT_EQ(count(svg, "marker-start=\"url(#mark-1)\""), 3u);
  EXPECT_EQ(count(svg, ">panel 2<"), 1u);
  // After the paths of two marks, two a panel; each panel right of the last.
  double right = 0;
  for (int k = 0; k < 3; ++k) {
    const auto p = path_points(svg, 2 + 2 * k);
    ASSERT_EQ(p.size(), 4u);
    EXPECT_GT(p[0].x, right + 40);
    right = p[3].x;
    EXPECT_EQ(p[0].y, path_points(svg, 2)[0].y);
  }
  EXPECT_LT(right, 960);
  plot.panels.resize(5);
  EXPECT_THROW(format_svg(plot), BugError);
}

// A legend of many long names wraps, and the axes begin below it.
TEST(Plot, TheLegendDoesNotCoverLines) {
  Plot plot = make_plot();
  plot.panels[0].marks.clear();
  for (int k = 0; k < 30; ++k)
    plot.panels[0].lines.push_back(
        {"a metric of a long name " + std::to_string(k), "", false, {0, 3}, {1, 1000}});
  const std::string svg = format_svg(plot);
  double lowest = 0, right = 0;
  for (std::size_t at = svg.find("long name"); at != std::string::npos;
       at = svg.find("long name", at + 1)) {
    double x = 0, y = 0;
    const std::size_t text = svg.rfind("<text", at);
    ASSERT_EQ(std::sscanf(svg.c_str() + text, "<text x=\"%lf\" y=\"%lf\"", &x, &y), 2);
    lowest = std::max(lowest, y), right = std::max(right, x + 140);
  }
  EXPECT_GT(lowest, 100);
  EXPECT_LT(right, 960);
  for (const Point& p : path_points(svg)) EXPECT_GT(p.y, lowest);
  // Lines beyond the eighth are told apart by dashes.
  EXPECT_GT(count(svg, "stroke-dasharray"), 20u);
}

// Long tick labels move the axes to the right.
TEST(Plot, TickLabelsFindRoom) {
  Plot plot = make_plot();
  plot.panels[0].marks.clear();
  plot.panels = {plot.panels[0], plot.panels[0]};
  const auto gap = [&](double y0, double y1) {
    for (PlotPanel& panel : plot.panels) panel.lines = {{"l", "", false, {0, 1}, {y0, y1}}};
    const std::string svg = format_svg(plot);
    return path_points(svg, 1)[0].x - path_points(svg, 0)[1].x;
  };
  EXPECT_NEAR(gap(1, 9), 52, 0.2);
  EXPECT_GT(gap(1.00001e6, 1.00002e6), gap(1, 9) + 20);
}

TEST(PlotAxis, TicksAreRoundAndInside) {
  const PlotAxis axis = make_axis({0.13, 9.7}, {false, 0, 300, 60, true});
  EXPECT_EQ(axis.lo, 0);  // near enough
  EXPECT_EQ(axis.hi, 10);
  EXPECT_EQ(axis.labels, (std::vector<std::string>{"0", "2", "4", "6", "8", "10"}));
  const PlotAxis log = make_axis({480, 17000}, {true, 0, 250, 36, false});
  EXPECT_EQ(log.labels, (std::vector<std::string>{"500", "1k", "2k", "5k", "10k"}));
  EXPECT_EQ(make_axis({480, 17000}, {true, 0, 250, 36, true}).labels.front(), "200");
  EXPECT_EQ(make_axis({1e-3, 2e6}, {true, 0, 250, 36, false}).labels,
            (std::vector<std::string>{"0.01", "1", "100", "10k", "1M"}));
  EXPECT_EQ(make_axis({1000001, 1000004}, {false, 0, 250, 60, true}).labels[1], "1.000002M");
}

TEST(PlotAxis, LawsOverRandomRanges) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const bool log = random.below(2) == 0, round_out = random.below(2) == 0;
    double lo = std::pow(10, random.uniform(-9, 9)), hi = std::pow(10, random.uniform(-9, 9));
    if (lo > hi) std::swap(lo, hi);
    if (!log && random.below(2) == 0) lo = -lo;
    const AxisOptions options{log, 700, 100, random.uniform(15, 80), round_out};
    const PlotAxis axis = make_axis({lo, hi}, options);
    const double slack = 1e-8 * (axis.hi - axis.lo);
    EXPECT_LE(axis.lo, (log ? std::log10(lo) : lo) + slack);
    EXPECT_GE(axis.hi, (log ? std::log10(hi) : hi) - slack);
    EXPECT_GE(axis.ticks.size(), 2u);
    EXPECT_EQ(axis.labels.size(), axis.ticks.size());
    for (std::size_t k = 0; k < axis.ticks.size(); ++k) {
      const double at = axis.at(axis.ticks[k]);
      EXPECT_LE(at, 700 + 1e-6);
      EXPECT_GE(at, 100 - 1e-6);
      if (k == 0) continue;
      EXPECT_LT(at, axis.at(axis.ticks[k - 1]));
      EXPECT_NE(axis.labels[k], axis.labels[k - 1]);
      if (!log && hi - lo > 1e-8 * std::max(std::abs(lo), hi)) {
        EXPECT_GE(axis.at(axis.ticks[k - 1]) - at, options.tick_px * (1 - 1e-9));
      }
    }
  }
}

TEST(Svg, EscapesWhatXmlForbids) {
  EXPECT_EQ(svg_escape("a<b>&\"c\""), "a&lt;b&gt;&amp;&quot;c&quot;");
  EXPECT_EQ(svg_escape("tab\tbell\a"), "tab bell ");
  EXPECT_EQ(svg_escape("gr\xc3\xbc\xc3\x9f"), "gr\xc3\xbc\xc3\x9f");
  EXPECT_EQ(svg_escape("\xe2\x82\xac"), "\xe2\x82\xac");
  EXPECT_EQ(svg_escape("cut \xc3"), "cut ?");
  EXPECT_EQ(svg_escape("\xff\xc0\x80z"), "???z");
  EXPECT_DOUBLE_EQ(svg_text_width("\xc3\xbc\xc3\xbc"), svg_text_width("uu"));
  EXPECT_EQ(svg_number(-0.04), "0.0");
}

}  // namespace
}  // namespace viewcell

#include "play/plots.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/file.h"

namespace viewcell {
namespace {

constexpr double kWidth = 960, kHeight = 420;
constexpr double kLeft = 76, kRight = 812, kTop = 46, kBottom = 362;  // of the axes
constexpr double kMostDbShown = 60;  // above it, nobody sees a difference

// Okabe and Ito 2008: told apart by readers who confuse red and green.
std::string color_of(const std::string& mode) {
  if (mode == "geometry") return "#d55e00";
  if (mode == "frustum") return "#e69f00";
  if (mode == "lod") return "#009e73";
  if (mode == "hybrid") return "#0072b2";
  if (mode == "raycast") return "#cc79a7";
  return "#000000";
}

std::string number(double x, const char* format = "%.1f") {
  char text[40];
  std::snprintf(text, sizeof text, format, x);
  return text;
}

// 1200000 -> "1.2M"
std::string tick_label(double x) {
  const double size = std::abs(x);
  if (size >= 1e6) return number(x / 1e6, "%g") + "M";
  if (size >= 1e3) return number(x / 1e3, "%g") + "k";
  return number(x, "%g");
}

std::string escape(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

struct Axis {
  double lo = 0, hi = 1;  // in what is plotted: the logarithm, for a log axis
  double at_lo = 0, at_hi = 1;
  bool log = false;
  double at(double value) const {
    const double v = log ? std::log10(value) : value;
    return at_lo + (std::clamp(v, lo, hi) - lo) / (hi - lo) * (at_hi - at_lo);
  }
};

// 1, 2 or 5 times a power of ten: the step that cuts `span` into at most `n_most` parts.
double nice_step(double span, int n_most) {
  const double rough = span / n_most;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

std::vector<double> linear_ticks(const Axis& axis, int n_most) {
  const double step = nice_step(axis.hi - axis.lo, n_most);
  std::vector<double> ticks;
  const double slack = 1e-9 * (axis.hi - axis.lo);
  for (double k = std::ceil((axis.lo - slack) / step); k * step <= axis.hi + slack; ++k)
    ticks.push_back(k * step + 0.0);  // -0 to 0
  return ticks;
}

// 1, 2, 5, 10, ... within; powers of ten alone where there are more than three decades.
std::vector<double> log_ticks(const Axis& axis) {
  std::vector<double> ticks;
  for (double e = std::floor(axis.lo); e <= axis.hi; ++e)
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (factor > 1 && axis.hi - axis.lo > 3) continue;
      const double value = factor * std::pow(10, e);
      if (std::log10(value) >= axis.lo - 1e-9 && std::log10(value) <= axis.hi + 1e-9)
        ticks.push_back(value);
    }
  return ticks;
}

bool is_drawable(const LinePlot& plot, double y) {
  return std::isfinite(y) && (!plot.log_y || y > 0);
}

// Wide enough for every value up to y_most, with some air.
Axis make_y_axis(const LinePlot& plot) {
  double lo = 1e300, hi = -1e300;
  for (const PlotLine& line : plot.lines)
    for (const double y : line.y) {
      if (!is_drawable(plot, y)) continue;
      const double v = plot.log_y ? std::log10(std::min(y, plot.y_most)) : std::min(y, plot.y_most);
      lo = std::min(lo, v), hi = std::max(hi, v);
    }
  if (lo > hi) lo = 0, hi = 1;
  if (hi - lo < 1e-9) lo -= 0.5, hi += 0.5;
  const double air = 0.05 * (hi - lo);
  return {lo - air, hi + air, kBottom, kTop, plot.log_y};
}

Axis make_x_axis(const LinePlot& plot) {
  const double lo = plot.x.front(), hi = plot.x.back();
  return {lo, hi > lo ? hi : lo + 1, kLeft, kRight, false};
}

std::string line_element(double x0, double y0, double x1, double y1, const char* style) {
  return "<line x1=\"" + number(x0) + "\" y1=\"" + number(y0) + "\" x2=\"" + number(x1) +
         "\" y2=\"" + number(y1) + "\" " + style + "/>\n";
}

std::string text_element(double x, double y, const char* anchor, const std::string& text,
                         const char* style = "") {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\" " +
         style + ">" + escape(text) + "</text>\n";
}

std::string draw_axes(const LinePlot& plot, const Axis& x, const Axis& y) {
  std::string out;
  for (const double mark : plot.marks)
    out += line_element(x.at(mark), kTop, x.at(mark), kBottom,
                        "stroke=\"#b8c4d6\" stroke-width=\"1\"");
  for (const double tick : plot.log_y ? log_ticks(y) : linear_ticks(y, 8)) {
    out += line_element(kLeft, y.at(tick), kRight, y.at(tick),
                        "stroke=\"#e4e4e4\" stroke-width=\"1\"");
    out += text_element(kLeft - 8, y.at(tick) + 4, "end", tick_label(tick));
  }
  for (const double tick : linear_ticks(x, 10)) {
    out += line_element(x.at(tick), kBottom, x.at(tick), kBottom + 5, "stroke=\"#888\"");
    out += text_element(x.at(tick), kBottom + 19, "middle", tick_label(tick));
  }
  out += line_element(kLeft, kBottom, kRight, kBottom, "stroke=\"#888\"");
  out += line_element(kLeft, kTop, kLeft, kBottom, "stroke=\"#888\"");
  out += text_element(0.5 * (kLeft + kRight), kBottom + 42, "middle", plot.x_label);
  out += "<text transform=\"translate(20 " + number(0.5 * (kTop + kBottom)) +
         ") rotate(-90)\" text-anchor=\"middle\">" + escape(plot.y_label) + "</text>\n";
  return out;
}

std::string draw_line(const LinePlot& plot, const PlotLine& line, const Axis& x, const Axis& y) {
  std::string path;
  bool broken = true;
  for (std::size_t i = 0; i < line.y.size(); ++i) {
    if (!is_drawable(plot, line.y[i])) {
      broken = true;
      continue;
    }
    path += (broken ? "M" : "L") + number(x.at(plot.x[i])) + " " + number(y.at(line.y[i])) + " ";
    broken = false;
  }
  if (path.empty()) return "";
  path.pop_back();
  return "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + line.color +
         "\" stroke-width=\"1.6\" stroke-linejoin=\"round\" stroke-linecap=\"round\"" +
         (line.dashed ? " stroke-dasharray=\"5 4\"" : "") + "/>\n";
}

std::string draw_legend(const LinePlot& plot) {
  std::string out;
  double y = kTop + 10;
  const auto entry = [&](const std::string& name, const std::string& style) {
    out += line_element(kRight + 18, y, kRight + 42, y, style.c_str());
    out += text_element(kRight + 50, y + 4, "start", name);
    y += 22;
  };
  for (const PlotLine& line : plot.lines)
    entry(line.name, "stroke=\"" + line.color + "\" stroke-width=\"2.4\"" +
                         (line.dashed ? " stroke-dasharray=\"5 4\"" : ""));
  if (!plot.marks.empty()) entry(plot.mark_label, "stroke=\"#b8c4d6\" stroke-width=\"1\"");
  return out;
}

// --- the plots of a timeline ---

LinePlot make_plot(const Timeline& timeline, const std::string& title, const std::string& y_label) {
  LinePlot plot;
  plot.title = title;
  plot.x_label = "time along the path (s)";
  plot.y_label = y_label;
  plot.mark_label = "new cell";
  for (std::size_t i = 0; i < timeline.frames.size(); ++i) {
    plot.x.push_back(timeline.frames[i].time_s);
    if (i > 0 && timeline.frames[i].cell != timeline.frames[i - 1].cell)
      plot.marks.push_back(timeline.frames[i].time_s);
  }
  return plot;
}

template <typename Value>
void add_modes(const Timeline& timeline, bool with_reference, Value value, LinePlot& plot) {
  for (const ModeTimeline& mode : timeline.modes) {
    if (!with_reference && mode.mode == timeline.reference) continue;
    PlotLine line{mode.mode, color_of(mode.mode), false, {}};
    for (const FrameRecord& frame : mode.frames)
      line.y.push_back(static_cast<double>(value(frame)));
    plot.lines.push_back(std::move(line));
  }
}

LinePlot make_quality_plot(const Timeline& timeline, const std::string& title,
                           double PictureQuality::*field) {
  LinePlot plot = make_plot(timeline, title, "PSNR (dB)");
  plot.y_most = kMostDbShown;
  const auto value = [&](const PictureQuality& q) {
    return q.n_covered_px == 0 ? kNotMeasured : q.*field;  // an empty frame says nothing
  };
  add_modes(
      timeline, false, [&](const FrameRecord& f) { return value(f.quality); }, plot);
  PlotLine yardstick{"half a pixel off", "#777777", true, {}};
  for (const FrameInfo& frame : timeline.frames) yardstick.y.push_back(value(frame.yardstick));
  plot.lines.push_back(std::move(yardstick));
  return plot;
}

}  // namespace

std::string format_svg(const LinePlot& plot) {
  VIEWCELL_CHECK(!plot.x.empty(), plot.title);
  for (const PlotLine& line : plot.lines)
    VIEWCELL_CHECK(line.y.size() == plot.x.size(), plot.title, line.name, line.y.size());
  const Axis x = make_x_axis(plot), y = make_y_axis(plot);
  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " +
                    number(kWidth, "%g") + " " + number(kHeight, "%g") +
                    "\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#333\">\n"
                    "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  out +=
      text_element(kLeft, kTop - 18, "start", plot.title, "font-size=\"16\" font-weight=\"bold\"");
  out += draw_axes(plot, x, y);
  for (const PlotLine& line : plot.lines) out += draw_line(plot, line, x, y);
  return out + draw_legend(plot) + "</svg>\n";
}

void write_plots(const std::filesystem::path& folder, const Timeline& timeline) {
  make_folder(folder);
  LinePlot time = make_plot(timeline, "Frame time", "ms");
  time.log_y = true;
  add_modes(
      timeline, true, [](const FrameRecord& f) { return f.ms; }, time);
  LinePlot triangles = make_plot(timeline, "Triangles drawn", "triangles");
  triangles.log_y = true;
  add_modes(
      timeline, true, [](const FrameRecord& f) { return f.n_triangles; }, triangles);
  write_file(folder / "frame_ms.svg", format_svg(time));
  write_file(folder / "triangles.svg", format_svg(triangles));
  write_file(folder / "psnr.svg",
             format_svg(make_quality_plot(timeline, "PSNR against " + timeline.reference,
                                          &PictureQuality::psnr_db)));
  write_file(folder / "psnr_covered.svg",
             format_svg(make_quality_plot(timeline,
                                          "PSNR over covered pixels against " + timeline.reference,
                                          &PictureQuality::psnr_covered_db)));
}

}  // namespace viewcell

#include "play/plots.h"

#include <cmath>

#include "base/file.h"
#include "report/plot.h"

namespace viewcell {
namespace {

constexpr double kMostDbShown = 60;  // above it, nobody sees a difference

Plot make_plot(const Timeline& timeline, const std::string& title, const std::string& y_label) {
  PlotPanel panel;
  panel.x_label = "time along the path (s)";
  panel.y_label = y_label;
  for (std::size_t i = 1; i < timeline.frames.size(); ++i)
    if (timeline.frames[i].cell != timeline.frames[i - 1].cell)
      panel.marks.push_back(timeline.frames[i].time_s);
  return {title, {std::move(panel)}, "new cell", PlotStyle::lines};
}

// A frame that was not compared, or in which nothing shows, says nothing of quality: it is no point
// of a line, and its neighbours are joined.
void add_quality(double time_s, const PictureQuality& quality, double PictureQuality::*field,
                 PlotLine& line) {
  if (std::isnan(quality.mse) || quality.n_covered_px == 0) return;
  line.x.push_back(time_s);
  line.y.push_back(quality.*field);
}

PlotLine start_line(Mode mode) {
  const ModeRow& row = row_of(mode);
  return {row.name, row.color, row.is_dashed, {}, {}};
}

template <typename Value>
void add_modes(const Timeline& timeline, Value value, Plot& plot) {
  for (const ModeTimeline& mode : timeline.modes) {
    PlotLine line = start_line(mode.mode);
    for (std::size_t i = 0; i < mode.frames.size(); ++i) {
      line.x.push_back(timeline.frames[i].time_s);
      line.y.push_back(static_cast<double>(value(mode.frames[i])));
    }
    plot.panels[0].lines.push_back(std::move(line));
  }
}

Plot make_quality_plot(const Timeline& timeline, const std::string& title,
                       double PictureQuality::*field) {
  Plot plot = make_plot(timeline, title, "PSNR of luminance (dB; above 60 at the edge)");
  PlotPanel& panel = plot.panels[0];
  panel.y_most = kMostDbShown;
  for (const ModeTimeline& mode : timeline.modes) {
    if (mode.mode == timeline.reference) continue;
    panel.lines.push_back(start_line(mode.mode));
    for (std::size_t i = 0; i < mode.frames.size(); ++i)
      add_quality(timeline.frames[i].time_s, mode.frames[i].quality, field, panel.lines.back());
  }
  panel.lines.push_back({"half a pixel off", "#777777", true, {}, {}});
  for (const FrameInfo& frame : timeline.frames)
    add_quality(frame.time_s, frame.yardstick, field, panel.lines.back());
  return plot;
}

}  // namespace

void write_plots(const std::filesystem::path& folder, const Timeline& timeline) {
  make_folder(folder);
  Plot time = make_plot(timeline, "Frame time", "ms a frame");
  time.panels[0].log_y = true;
  add_modes(
      timeline, [](const FrameRecord& f) { return f.ms; }, time);
  Plot triangles = make_plot(timeline, "Triangles drawn", "triangles a frame");
  triangles.panels[0].log_y = true;
  triangles.panels[0].y_least = 1;  // frames that show nothing
  add_modes(
      timeline, [](const FrameRecord& f) { return f.n_triangles; }, triangles);
  write_file(folder / "frame_ms.svg", format_svg(time));
  write_file(folder / "triangles.svg", format_svg(triangles));
  const std::string reference = mode_name(timeline.reference);
  write_file(folder / "psnr.svg",
             format_svg(make_quality_plot(timeline, "PSNR against " + reference,
                                          &PictureQuality::psnr_db)));
  write_file(folder / "psnr_covered.svg",
             format_svg(make_quality_plot(timeline, "PSNR over covered pixels against " + reference,
                                          &PictureQuality::psnr_covered_db)));
}

}  // namespace viewcell

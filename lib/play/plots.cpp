#include "play/plots.h"

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

std::vector<double> times_of(const Timeline& timeline) {
  std::vector<double> times_s;
  for (const FrameInfo& frame : timeline.frames) times_s.push_back(frame.time_s);
  return times_s;
}

template <typename Value>
void add_modes(const Timeline& timeline, bool with_reference, Value value, Plot& plot) {
  for (const ModeTimeline& mode : timeline.modes) {
    if (!with_reference && mode.mode == timeline.reference) continue;
    const ModeRow& row = row_of(mode.mode);
    PlotLine line{row.name, row.color, row.is_dashed, times_of(timeline), {}};
    for (const FrameRecord& frame : mode.frames)
      line.y.push_back(static_cast<double>(value(frame)));
    plot.panels[0].lines.push_back(std::move(line));
  }
}

Plot make_quality_plot(const Timeline& timeline, const std::string& title,
                       double PictureQuality::*field) {
  Plot plot = make_plot(timeline, title, "PSNR (dB)");
  plot.panels[0].y_most = kMostDbShown;
  const auto value = [&](const PictureQuality& q) {
    return q.n_covered_px == 0 ? kNotMeasured : q.*field;  // an empty frame says nothing
  };
  add_modes(
      timeline, false, [&](const FrameRecord& f) { return value(f.quality); }, plot);
  PlotLine yardstick{"half a pixel off", "#777777", true, times_of(timeline), {}};
  for (const FrameInfo& frame : timeline.frames) yardstick.y.push_back(value(frame.yardstick));
  plot.panels[0].lines.push_back(std::move(yardstick));
  return plot;
}

}  // namespace

void write_plots(const std::filesystem::path& folder, const Timeline& timeline) {
  make_folder(folder);
  Plot time = make_plot(timeline, "Frame time", "ms");
  time.panels[0].log_y = true;
  add_modes(
      timeline, true, [](const FrameRecord& f) { return f.ms; }, time);
  Plot triangles = make_plot(timeline, "Triangles drawn", "triangles");
  triangles.panels[0].log_y = true;
  add_modes(
      timeline, true, [](const FrameRecord& f) { return f.n_triangles; }, triangles);
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

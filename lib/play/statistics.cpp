#include "play/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "base/error.h"
#include "image/metrics.h"
#include "report/table.h"

namespace viewcell {
namespace {

using Quality = std::function<const PictureQuality&(std::size_t frame)>;

double percentile(const std::vector<double>& sorted, double p) {
  const double at = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], at - static_cast<double>(below));
}

double mean_of(std::span<const double> values) {
  double sum = 0;
  for (const double x : values) sum += x;
  return values.empty() ? kNotMeasured : sum / static_cast<double>(values.size());
}

// The values of one field over a mode's frames.
template <typename Field>
std::vector<double> values_of(const ModeTimeline& mode, Field field) {
  std::vector<double> values;
  for (const FrameRecord& frame : mode.frames) values.push_back(static_cast<double>(frame.*field));
  return values;
}

// JSON has no NaN.
Json number_or_null(double x) {
  return std::isfinite(x) ? Json(x) : Json(nullptr);
}

struct Decibels {
  Summary summary;
  double of_mse = kNotMeasured;
};

// covered: over covered pixels, of frames that have any.
Decibels summarize_db(std::size_t n_frames, const Quality& quality, bool covered) {
  std::vector<double> db, mse;
  double n_px = 0, squares = 0;
  for (std::size_t i = 0; i < n_frames; ++i) {
    const PictureQuality& q = quality(i);
    if (std::isnan(q.psnr_db) || (covered && q.n_covered_px == 0)) continue;
    db.push_back(covered ? q.psnr_covered_db : q.psnr_db);
    const double weight = covered ? static_cast<double>(q.n_covered_px) : 1;
    n_px += weight;
    squares += weight * (covered ? q.mse_covered : q.mse);
  }
  return {summarize(db), n_px > 0 ? psnr_db_of(squares / n_px) : kNotMeasured};
}

Json to_json(const Decibels& d) {
  return {{"mean", number_or_null(d.summary.mean)},
          {"min", number_or_null(d.summary.min)},
          {"p5", number_or_null(d.summary.p5)},
          {"of_mse", number_or_null(d.of_mse)}};
}

Quality quality_of(const ModeTimeline& mode) {
  return [&mode](std::size_t i) -> const PictureQuality& { return mode.frames[i].quality; };
}

Quality yardstick_of(const Timeline& timeline) {
  return
      [&timeline](std::size_t i) -> const PictureQuality& { return timeline.frames[i].yardstick; };
}

std::vector<double> missing_px(const ModeTimeline& mode) {
  std::vector<double> values;
  for (const FrameRecord& frame : mode.frames)
    if (!std::isnan(frame.quality.mse))  // compared
      values.push_back(static_cast<double>(frame.quality.missing_px));
  return values;
}

double rays_per_s(const Timeline& timeline, double ms) {
  return timeline.width_px * timeline.height_px / (1e-3 * ms);
}

Json mode_to_json(const Timeline& timeline, const ModeTimeline& mode) {
  const std::size_t n = mode.frames.size();
  const Summary ms = summarize(values_of(mode, &FrameRecord::ms));
  Json json = {{"triangles_mean", mean_of(values_of(mode, &FrameRecord::n_triangles))},
               {"frame_ms",
                {{"mean", ms.mean},
                 {"median", ms.median},
                 {"p95", ms.p95},
                 {"p99", ms.p99},
                 {"max", ms.max},
                 {"min", ms.min}}},
               {"psnr_db", to_json(summarize_db(n, quality_of(mode), false))},
               {"psnr_covered_db", to_json(summarize_db(n, quality_of(mode), true))},
               {"texture_bytes_mean", mean_of(values_of(mode, &FrameRecord::texture_bytes))},
               {"draws_mean", mean_of(values_of(mode, &FrameRecord::n_draws))},
               {"missing_px_mean", number_or_null(mean_of(missing_px(mode)))}};
  if (row_of(mode.mode).engine == ModeEngine::rays)
    json["rays_per_s"] = rays_per_s(timeline, ms.mean);
  return json;
}

Json frame_to_json(const Timeline& timeline, std::size_t i) {
  const FrameInfo& info = timeline.frames[i];
  Json json = {{"frame", i},
               {"time_s", info.time_s},
               {"cell", info.cell},
               {"coverage", number_or_null(info.coverage)},
               {"yardstick_psnr_db", number_or_null(info.yardstick.psnr_db)},
               {"yardstick_psnr_covered_db", number_or_null(info.yardstick.psnr_covered_db)},
               {"modes", Json::object()}};
  for (const ModeTimeline& mode : timeline.modes) {
    const FrameRecord& frame = mode.frames[i];
    Json& record = json["modes"][mode_name(mode.mode)];
    record = {{"ms", frame.ms},
              {"triangles", frame.n_triangles},
              {"draws", frame.n_draws},
              {"texture_bytes", frame.texture_bytes},
              {"psnr_db", number_or_null(frame.quality.psnr_db)},
              {"psnr_covered_db", number_or_null(frame.quality.psnr_covered_db)},
              {"missing_px", frame.quality.missing_px}};
    if (frame.stand_in != StandIn::none) record["stand_in"] = stand_in_name(frame.stand_in);
  }
  return json;
}

std::size_t count_all_stand_ins(const Timeline& timeline) {
  std::size_t n = 0;
  for (const StandIn stand_in : stand_ins()) n += count_stand_ins(timeline, stand_in);
  return n;
}

Json stand_ins_to_json(const Timeline& timeline) {
  Json json = {{"frames", count_all_stand_ins(timeline)}};
  for (const StandIn stand_in : stand_ins())
    json[stand_in_name(stand_in)] = count_stand_ins(timeline, stand_in);
  json["faults"] = Json::array();
  for (const BundleFault& fault : timeline.faults) json["faults"].push_back(fault.what);
  return json;
}

Json speedups(const Timeline& timeline) {
  const auto mean_ms = [](const ModeTimeline& mode) {
    return mean_of(values_of(mode, &FrameRecord::ms));
  };
  Json json = Json::object();
  for (const ModeTimeline& fast : timeline.modes)
    for (const ModeTimeline& slow : timeline.modes)
      if (fast.mode == Mode::hybrid && slow.mode != Mode::hybrid)
        json[std::string(mode_name(fast.mode)) + "_over_" + mode_name(slow.mode)] =
            mean_ms(slow) / mean_ms(fast);
  return json;
}

// Of the frames for which it was measured.
double frame_mean(const Timeline& timeline, double FrameInfo::*field) {
  std::vector<double> measured;
  for (const FrameInfo& frame : timeline.frames)
    if (!std::isnan(frame.*field)) measured.push_back(frame.*field);
  return mean_of(measured);
}

Json floor_to_json(const Timeline& timeline) {
  const Summary ms = summarize(timeline.floor_ms);
  return {{"mean", number_or_null(ms.mean)}, {"median", number_or_null(ms.median)}};
}

void check_timeline(const Timeline& timeline) {
  VIEWCELL_CHECK(!timeline.frames.empty());
  for (const ModeTimeline& mode : timeline.modes)
    VIEWCELL_CHECK(mode.frames.size() == timeline.frames.size(), mode_name(mode.mode),
                   mode.frames.size(), timeline.frames.size());
}

std::string fixed(double x, int n_decimals, bool with_sign = false) {
  return format_fixed(x, n_decimals, "", with_sign);
}

std::vector<std::string> make_row(const Timeline& timeline, const ModeTimeline& mode) {
  const std::size_t n = mode.frames.size();
  const Summary ms = summarize(values_of(mode, &FrameRecord::ms));
  std::vector<std::string> row{mode_name(mode.mode),
                               fixed(ms.mean, 2),
                               fixed(ms.median, 2),
                               fixed(ms.p95, 2),
                               fixed(mean_of(values_of(mode, &FrameRecord::n_triangles)), 0),
                               fixed(mean_of(values_of(mode, &FrameRecord::n_draws)), 0)};
  for (const bool covered : {false, true}) {
    const double db = summarize_db(n, quality_of(mode), covered).summary.mean;
    const double over = db - summarize_db(n, yardstick_of(timeline), covered).summary.mean;
    const bool is_reference = mode.mode == timeline.reference;
    row.push_back(is_reference ? "" : fixed(db, 2));
    row.push_back(is_reference ? "" : fixed(over, 1, true));
  }
  return row;
}

// Header first.
TableRows make_rows(const Timeline& timeline) {
  check_timeline(timeline);
  TableRows rows{{"mode", "mean ms", "median", "p95", "triangles", "draws", "dB", "over",
                  "covered dB", "over"}};
  for (const ModeTimeline& mode : timeline.modes) rows.push_back(make_row(timeline, mode));
  if (timeline.floor_ms.empty()) return rows;
  const Summary ms = summarize(timeline.floor_ms);
  rows.push_back(
      {"floor", fixed(ms.mean, 2), fixed(ms.median, 2), fixed(ms.p95, 2), "", "", "", "", "", ""});
  return rows;
}

}  // namespace

Summary summarize(std::span<const double> values) {
  if (values.empty())
    return {kNotMeasured, kNotMeasured, kNotMeasured, kNotMeasured,
            kNotMeasured, kNotMeasured, kNotMeasured};
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return {mean_of(values),         percentile(sorted, 0.5),  sorted.front(),
          sorted.back(),           percentile(sorted, 0.05), percentile(sorted, 0.95),
          percentile(sorted, 0.99)};
}

Json make_statistics(const Timeline& timeline) {
  check_timeline(timeline);
  const std::size_t n = timeline.frames.size();
  Json modes = Json::object(), per_frame = Json::array();
  for (const ModeTimeline& mode : timeline.modes)
    modes[mode_name(mode.mode)] = mode_to_json(timeline, mode);
  for (std::size_t i = 0; i < n; ++i) per_frame.push_back(frame_to_json(timeline, i));
  return {{"frames", n},
          {"width_px", timeline.width_px},
          {"height_px", timeline.height_px},
          {"renderer", timeline.renderer},
          {"gl_threads", timeline.gl_threads},
          {"threads", timeline.n_threads},
          {"reference", mode_name(timeline.reference)},
          {"modes", modes},
          {"yardstick",
           {{"psnr_db", to_json(summarize_db(n, yardstick_of(timeline), false))},
            {"psnr_covered_db", to_json(summarize_db(n, yardstick_of(timeline), true))}}},
          {"coverage_mean", number_or_null(frame_mean(timeline, &FrameInfo::coverage))},
          {"luminance_deviation_mean",
           number_or_null(frame_mean(timeline, &FrameInfo::luminance_deviation))},
          {"stand_ins", stand_ins_to_json(timeline)},
          {"speedup", speedups(timeline)},
          {"floor_ms", floor_to_json(timeline)},
          {"per_frame", per_frame}};
}

std::string format_mode_table(const Timeline& timeline) {
  return format_table(make_rows(timeline)) +
         "over: the reference shifted by half a pixel; floor: a clear and a textured quad\n";
}

std::string format_markdown(const Timeline& timeline) {
  std::string out = std::to_string(timeline.frames.size()) + " frames of " +
                    std::to_string(timeline.width_px) + " x " + std::to_string(timeline.height_px) +
                    ", objects on " + fixed(100 * frame_mean(timeline, &FrameInfo::coverage), 1) +
                    " % of a frame, their luminance deviating by " +
                    fixed(frame_mean(timeline, &FrameInfo::luminance_deviation), 1) + " of 255; " +
                    timeline.renderer + ", " + std::to_string(timeline.gl_threads) +
                    " raster threads, raycast on " + std::to_string(timeline.n_threads) +
                    ". Reference: " + mode_name(timeline.reference) + ".\n\n";
  out += format_markdown_table(make_rows(timeline));
  if (const std::size_t n = count_all_stand_ins(timeline); n > 0)
    out += "\nhybrid: " + std::to_string(n) +
           " of these frames are not, or not wholly, of the bake.\n";
  std::string factors;
  const Json speedup = speedups(timeline);  // items() refers to it
  for (const auto& [name, factor] : speedup.items())
    factors += (factors.empty() ? "" : ", ") + name + " " + fixed(factor.get<double>(), 2);
  if (!factors.empty()) out += "\nSpeedup: " + factors + ".\n";
  for (const ModeTimeline& mode : timeline.modes)
    if (row_of(mode.mode).engine == ModeEngine::rays)
      out += std::string("\n") + mode_name(mode.mode) + ": " +
             fixed(rays_per_s(timeline, mean_of(values_of(mode, &FrameRecord::ms))) / 1e6, 1) +
             " million rays a second.\n";
  return out;
}

}  // namespace viewcell

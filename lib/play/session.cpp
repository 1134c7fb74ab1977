#include "play/session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <span>

#include "base/error.h"
#include "base/file.h"
#include "base/parallel.h"
#include "base/srgb.h"
#include "image/io.h"
#include "image/metrics.h"
#include "play/floor_quad.h"
#include "play/hybrid_renderer.h"

namespace viewcell {
namespace {

constexpr double kDifferenceGain = 8;

// A pass over the frames, reported to the progress as one of two.
class Pass {
 public:
  Pass(const Progress& progress, std::size_t n_frames, std::size_t first)
      : progress_(progress), total_(2 * n_frames), done_(first) {}
  void step() {
    if (progress_) progress_(++done_, total_);
  }

 private:
  const Progress& progress_;
  std::size_t total_, done_;
};

double time_floor(Player& player) {
  const auto start = std::chrono::steady_clock::now();
  player.draw_floor();
  const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
  return ms.count();
}

void time_frames(Player& player, const std::vector<Camera>& cameras, const SessionOptions& options,
                 Timeline& timeline, Pass pass) {
  for (const Mode mode : options.modes) player.draw(mode, cameras[0]);  // shaders are compiled here
  time_floor(player);
  for (std::size_t first = 0; first < cameras.size(); first += options.turn_frames) {
    const std::size_t n = std::min(options.turn_frames, cameras.size() - first);
    const std::span<const Camera> turn(cameras.data() + first, n);
    for (std::size_t m = 0; m < options.modes.size(); ++m)
      for (const Camera& camera : turn) {
        const DrawnFrame drawn = player.draw(options.modes[m], camera);
        timeline.modes[m].frames.push_back(
            {drawn.ms, drawn.n_triangles, drawn.n_draws, drawn.texture_bytes, {}, drawn.stand_in});
      }
    for (std::size_t i = 0; i < n; ++i) timeline.floor_ms.push_back(time_floor(player));
    for (std::size_t i = 0; i < n; ++i) pass.step();
  }
}

bool is_saved(const SessionOptions& options, std::size_t frame) {
  return !options.save.empty() && frame % options.save_every == 0;
}

bool is_compared(const SessionOptions& options, std::size_t frame) {
  return options.with_quality && frame % options.quality_every == 0;
}

void save_frame(const SessionOptions& options, Mode mode, std::size_t frame,
                const ImageRgba8& picture) {
  if (!is_saved(options, frame)) return;
  char name[32];
  std::snprintf(name, sizeof name, "frame-%05zu.png", frame);
  const std::filesystem::path folder = options.save / mode_name(mode);
  make_folder(folder);
  write_png(folder / name, picture, options.save_alpha ? PngAlpha::keep : PngAlpha::drop);
}

// The pictures of one frame: quality and saved files.
class Comparer {
 public:
  Comparer(Player& player, const SessionOptions& options, Timeline& timeline)
      : player_(player), options_(options), timeline_(timeline) {}

  void compare(std::size_t i, const Camera& camera) {
    const ImageRgba8 reference = draw(options_.reference, camera);
    FrameInfo& info = timeline_.frames[i];
    info.coverage = measure_coverage(reference);
    info.luminance_deviation = measure_luminance_deviation(reference);
    info.yardstick = measure_quality(reference, player_.draw_shifted(camera, {0.5, 0.5}));
    for (std::size_t m = 0; m < options_.modes.size(); ++m) {
      const Mode mode = options_.modes[m];
      const ImageRgba8 picture = mode == options_.reference ? reference : draw(mode, camera);
      timeline_.modes[m].frames[i].quality = measure_quality(reference, picture);
      save_frame(options_, mode, i, picture);
    }
  }

  // Of a frame that is not compared.
  void save(std::size_t i, const Camera& camera) {
    for (const Mode mode : options_.modes) save_frame(options_, mode, i, draw(mode, camera));
  }

  SheetRow make_row(std::size_t i, const Camera& camera) {
    char label[96];
    std::snprintf(label, sizeof label, "frame %zu, %.1f s, cell %d", i, timeline_.frames[i].time_s,
                  timeline_.frames[i].cell);
    const ImageRgba8 reference = draw(options_.reference, camera);
    const ImageRgba8 hybrid = draw(Mode::hybrid, camera);
    char note[64];
    const PictureQuality quality = measure_quality(reference, hybrid);
    std::snprintf(note, sizeof note, "%.1f dB, covered %.1f dB", quality.psnr_db,
                  quality.psnr_covered_db);
    return {label,
            {reference, hybrid, difference_image(reference, hybrid, kDifferenceGain),
             player_.draw_kinds(camera, HybridStyle::wireframe)},
            {"", note}};
  }

 private:
  ImageRgba8 draw(Mode mode, const Camera& camera) {
    player_.draw(mode, camera);
    return player_.read(mode);
  }

  Player& player_;
  const SessionOptions& options_;
  Timeline& timeline_;
};

// Of the last column. Surfaces there are lit: swatches are of a surface that faces the light.
std::vector<SheetKey> make_kinds_key() {
  const auto swatch = [](Representation kind) {
    const glm::vec3 c = kind_color(kind);
    return Rgba8{srgb8_from_linear(c.x), srgb8_from_linear(c.y), srgb8_from_linear(c.z), 255};
  };
  return {{swatch(Representation::multi_view), "MVMesh, textured from several views"},
          {swatch(Representation::single_view), "SVMesh, from one view"},
          {swatch(Representation::original),
           "original, inside the cell or better so; level that stands in"},
          {swatch(Representation::unseen), "said to be unseen from the cell"}};
}

// Of each equal part of the path the frame in which the hybrid is farthest from the reference: a
// sheet shows the worst.
std::vector<std::size_t> choose_sheet_frames(const ModeTimeline& hybrid, std::size_t n_rows) {
  const auto error = [](const FrameRecord& frame) {
    return std::isnan(frame.quality.mse) ? -1.0 : frame.quality.mse;
  };
  std::vector<std::size_t> chosen;
  const std::size_t n = hybrid.frames.size();
  for (std::size_t r = 0; r < std::min(n_rows, n); ++r) {
    const auto first = hybrid.frames.begin() + static_cast<std::ptrdiff_t>(r * n / n_rows);
    const auto last = hybrid.frames.begin() + static_cast<std::ptrdiff_t>((r + 1) * n / n_rows);
    const auto worst = std::max_element(
        first, last, [&](const auto& a, const auto& b) { return error(a) < error(b); });
    chosen.push_back(static_cast<std::size_t>(worst - hybrid.frames.begin()));
  }
  return chosen;
}

bool draws_hybrid(Mode mode) {
  return row_of(mode).engine == ModeEngine::hybrid || row_of(mode).asks_hybrid;
}

// A hybrid of no frame is a path that is not the bundle's.
void check_path_meets_bundle(const Bundle& bundle, const std::vector<Camera>& cameras,
                             const SessionOptions& options) {
  const auto& modes = options.modes;
  if (!draws_hybrid(options.reference) && std::none_of(modes.begin(), modes.end(), draws_hybrid))
    return;
  for (const Camera& camera : cameras)
    if (find_off_bake(bundle, camera) != StandIn::off_cells) return;
  const HexGrid& grid = bundle.cells().grid;
  const auto cell = cell_at(grid, coord_at(grid, glm::dvec2(cameras[0].eye)));
  throw InputError("path", "",
                   "no eye is in a cell that the bundle holds; the first " +
                       (cell ? "is in cell " + std::to_string(static_cast<int>(*cell))
                             : std::string("leaves the grid of cells")));
}

Timeline start_timeline(const Player& player, const Bundle& bundle, const CameraPath& path,
                        const std::vector<Camera>& cameras, const SessionOptions& options) {
  Timeline timeline;
  timeline.width_px = player.options().width_px;
  timeline.height_px = player.options().height_px;
  timeline.renderer = player.context().renderer();
  timeline.gl_threads = player.context().n_threads();
  timeline.n_threads =
      player.options().n_threads > 0 ? player.options().n_threads : hardware_threads();
  timeline.reference = options.reference;
  const double start = path.samples.front().time_s;
  const double span = path.samples.back().time_s - start;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    FrameInfo info;
    const std::size_t steps = std::max<std::size_t>(1, cameras.size() - 1);
    info.time_s = start + span * static_cast<double>(i) / static_cast<double>(steps);
    const HexGrid& grid = bundle.cells().grid;
    if (const auto cell = cell_at(grid, coord_at(grid, glm::dvec2(cameras[i].eye))))
      info.cell = static_cast<int>(*cell);
    timeline.frames.push_back(info);
  }
  for (const Mode mode : options.modes) timeline.modes.push_back({mode, {}});
  return timeline;
}

}  // namespace

Session run_session(Player& player, const Bundle& bundle, const CameraPath& path,
                    const SessionOptions& options, const Progress& progress) {
  const PlayerOptions& frame = player.options();
  std::vector<Camera> cameras = sample_path(path, options.n_frames);
  for (Camera& camera : cameras)
    camera = with_frame(camera, frame.fov_y_deg > 0 ? frame.fov_y_deg : path.fov_y_deg,
                        static_cast<double>(frame.width_px) / frame.height_px);
  check_path_meets_bundle(bundle, cameras, options);
  Session session;
  session.timeline = start_timeline(player, bundle, path, cameras, options);
  time_frames(player, cameras, options, session.timeline, Pass(progress, cameras.size(), 0));
  session.timeline.faults = player.residency().faults();

  Comparer comparer(player, options, session.timeline);
  Pass pass(progress, cameras.size(), cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (is_compared(options, i))
      comparer.compare(i, cameras[i]);
    else if (is_saved(options, i))
      comparer.save(i, cameras[i]);
    pass.step();
  }
  if (!options.with_quality) return session;
  const auto& modes = session.timeline.modes;
  const auto hybrid = std::find_if(modes.begin(), modes.end(), [](const ModeTimeline& mode) {
    return mode.mode == Mode::hybrid;
  });
  if (hybrid == modes.end()) return session;
  std::vector<SheetRow> rows;
  SheetOptions sheet;
  sheet.key = make_kinds_key();
  for (const std::size_t i : choose_sheet_frames(*hybrid, options.n_sheet_rows))
    rows.push_back(comparer.make_row(i, cameras[i]));
  session.contact_sheet = make_contact_sheet(
      {mode_name(options.reference), mode_name(Mode::hybrid), "difference x 8", "what was drawn"},
      rows, sheet);
  return session;
}

}  // namespace viewcell

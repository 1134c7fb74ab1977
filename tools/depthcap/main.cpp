// depthcap: captures colour and depth of every object from every cell's centre.
#include <atomic>

#include "base/error.h"
#include "base/file.h"
#include "capture/capture_centre.h"
#include "capture/captures.h"
#include "capture/raster_capture.h"

#include "capture/ray_capture.h"
#include "common/provenance.h"
#include "common/tool.h"
#include "gl/context.h"

namespace viewcell {
namespace {

struct Options {
  std::string scene_file, cells_file;
  std::string cell_list = "all", slice;
  CaptureDensity density;
  std::string engine = "embree", gl = "osmesa";
};

void declare(Tool& tool, Options& options) {
  CLI::App& app = tool.app();
  app.add_option("scene", options.scene_file, "scene.json")->required();
  app.add_option("cells", options.cells_file, "cells.json")->required();
  app.add_option("--cells", options.cell_list, "all | 3,7,10-19 | @FILE | path:path.json")
      ->capture_default_str();
  app.add_option("--slice", options.slice, "I/N: every N-th of those cells, from the I-th");
  app.add_option("--resolution", options.density.resolution_px, "pixels per width of a side face")
      ->capture_default_str()
      ->check(CLI::Range(16, 8192));
  app.add_option("--far-scale", options.density.far_scale, "times that density for far objects")
      ->capture_default_str()
      ->check(within(0.1, 16));
  app.add_option("--far-distance", options.density.far_distance, "from where an object is far")
      ->capture_default_str()
      ->check(within(0, 1e9));
  app.add_option("--most-pixels", options.density.most_px, "pixels of one object's crop at most")
      ->capture_default_str()
      ->check(CLI::Range(64, 1 << 28));
  app.add_option("--engine", options.engine, "embree | gl")
      ->capture_default_str()
      ->check(CLI::IsMember({"embree", "gl"}));
  app.add_option("--gl", options.gl, "of engine gl: osmesa | egl")->capture_default_str();
  tool.add_output("folder of captures to write");
}

// Sums over centres; captured from several threads.
struct Counts {
  std::atomic<std::size_t> n_kept{0}, n_tiles{0}, n_pixels{0}, n_left_out{0};
};

// Calls visit(engine, n_threads) with the engine asked for; GL draws on one thread only.
template <typename Visit>
void with_engine(const Options& options, const Scene& scene, int n_threads, const Visit& visit) {
  if (options.engine == "embree") {
    const RayCapture rays(scene, n_threads);
    visit([&](ObjectId o, const CaptureView& v, const Crop& c) { return rays.capture(o, v, c); },
          n_threads);
  } else {
    const GlContext context(parse_gl_engine(options.gl));
    RasterCapture raster(context.gl(), scene);
    visit([&](ObjectId o, const CaptureView& v, const Crop& c) { return raster.capture(o, v, c); },
          1);
  }
}

int run(const Tool& tool, const Options& options) {
  const int n_threads = tool.common().n_threads;
  const Scene scene = read_scene(options.scene_file, {.n_threads = n_threads});
  const CellSet cells = read_cells(options.cells_file);
  check_cells_of_scene(cells, scene, options.cells_file);
  const auto centres = centres_of(cells, select_cells(cells, options.cell_list, options.slice));
  const CaptureSettings settings{scene.hash, hash_file(options.cells_file), options.density,
                                 options.engine};
  const std::filesystem::path folder = tool.common().output;
  make_folder(folder);

  const auto points = place_points(scene);
  Counts counts;
  with_engine(options, scene, n_threads, [&](const CaptureEngine& engine, int n_workers) {
    const auto capture = [&](std::size_t i) {
      const std::filesystem::path file = capture_file_of(folder, centres[i]);
      if (is_captured(file, settings)) {
        ++counts.n_kept;
        return;
      }
      const CentreTiles captured =
          capture_centre(cells, centres[i], points, options.density, engine);
      write_captures(file, captured.tiles, settings);
      counts.n_left_out += captured.n_left_out;
      counts.n_tiles += captured.tiles.size();
      for (const CaptureTile& tile : captured.tiles) counts.n_pixels += tile.color.pixels.size();
    };
    parallel_for(centres.size(), n_workers, capture, tool.progress("centres"));
  });
  const Json made_by = make_provenance(tool,
                                       {{"resolution", options.density.resolution_px},
                                        {"far_scale", options.density.far_scale},
                                        {"far_distance", options.density.far_distance},
                                        {"most_pixels", options.density.most_px},
                                        {"engine", options.engine}},
                                       {{"scene", scene.hash}, {"cells", settings.cells_hash}});
  write_file(folder / kCapturesManifest, format_json(format_settings(settings, made_by)));
  tool.report({{"centres", centres.size()},
               {"kept", counts.n_kept.load()},
               {"captures", counts.n_tiles.load()},
               {"pixels", counts.n_pixels.load()},
               {"left_out", counts.n_left_out.load()}});
  tool.say(std::to_string(centres.size()) + " centres, " + std::to_string(counts.n_kept.load()) +
           " of them already there, " + std::to_string(counts.n_tiles.load()) + " captures");
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "depthcap", "Capture colour and depth of objects from the centres of cells.",
      "depthcap park/scene.json cells.json --cells path:park/path.json -o captures");
  viewcell::Options options;
  viewcell::declare(tool, options);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, options); });
}

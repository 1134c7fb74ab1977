// depthcap: captures colour and depth of every object from every cell's centre.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/file.h"
#include "base/folder_lock.h"
#include "capture/capture_centre.h"
#include "capture/captures.h"
#include "capture/raster_capture.h"
#include "capture/ray_capture.h"
#include "common/provenance.h"
#include "common/scene_inputs.h"
#include "depthcap/arguments.h"
#include "gl/context.h"
#include "scene/pictures.h"

namespace viewcell {
namespace {

// Sums over centres; captured from several threads.
struct Counts {
  std::atomic<std::size_t> n_kept{0}, n_tiles{0}, n_pixels{0}, n_left_out{0};
};

// Calls visit(engine, n_threads) with the engine asked for; GL draws on one thread only.
template <typename Visit>
void with_engine(const DepthcapArguments& a, const Scene& scene, int n_threads,
                 const Visit& visit) {
  if (a.engine == "embree") {
    const RayCapture rays(scene, n_threads);
    visit([&](ObjectId o, const CaptureView& v, const Crop& c) { return rays.capture(o, v, c); },
          n_threads);
  } else {
    const GlContext context(parse_gl_engine(a.gl));
    RasterCapture raster(context.gl(), scene);
    visit([&](ObjectId o, const CaptureView& v, const Crop& c) { return raster.capture(o, v, c); },
          1);
  }
}

// Megabytes of textures of the cell that needs most; refuses those that no player could hold.
double check_budget(const DepthcapArguments& a, const CellSet& cells,
                    const std::vector<CellId>& list,
                    const std::vector<std::vector<glm::dvec3>>& points, int n_threads) {
  const LargestCell largest = find_largest_cell(cells, list, points, a.density, n_threads);
  const double most_mb = 4e-6 * static_cast<double>(largest.n_pixels);
  if (a.budget_mb == 0 || most_mb <= a.budget_mb) return most_mb;
  throw InputError(a.cells_file, "cells[" + std::to_string(static_cast<int>(largest.cell)) + "]",
                   "needs up to " + std::to_string(std::lround(most_mb)) +
                       " MB of textures, more than --budget " +
                       std::to_string(std::lround(a.budget_mb)) +
                       (cells.is_tested.empty() ? "; leave out what cells never see (pvs)" : "") +
                       "; or a lower --resolution, or hexcells with smaller cells");
}

int run(Tool& tool, const DepthcapArguments& a) {
  const int n_threads = tool.common().n_threads;
  Scene scene = read_scene(a.scene_file, {.n_threads = n_threads, .limits = mesh_limits(tool)});
  load_pictures(a.scene_file, scene, {a.max_pixels}, n_threads);
  register_scene_files(tool, scene, a.scene_file);
  const CellSet cells = read_cells(a.cells_file);
  check_cells_of_scene(cells, scene, a.cells_file);
  const auto list = select_cells(cells, a.cell_list, a.slice);
  check_tested(cells, list, a.cells_file);
  const auto centres = centres_of(cells, list);
  const CaptureSettings settings{scene.hash, cells.file_hash, a.density, a.engine};
  const auto points = object_points_world(scene);
  const double most_mb = check_budget(a, cells, list, points, n_threads);
  const std::filesystem::path folder = tool.common().output;
  make_folder(folder);
  const FolderLock lock(folder, tool.name(), settings.key());

  Counts counts;
  with_engine(a, scene, n_threads, [&](const CaptureEngine& engine, int n_workers) {
    const auto capture = [&](std::size_t i) {
      const std::filesystem::path file = capture_file_of(folder, centres[i]);
      if (is_captured(file, settings)) {
        ++counts.n_kept;
        return;
      }
      const CentreTiles captured = capture_centre(cells, centres[i], points, a.density, engine);
      write_captures(file, captured.tiles, settings);
      counts.n_left_out += captured.n_left_out;
      counts.n_tiles += captured.tiles.size();
      for (const CaptureTile& tile : captured.tiles) counts.n_pixels += tile.color.pixels.size();
    };
    parallel_for(centres.size(), n_workers, capture, tool.progress("centres"));
  });
  const Json made_by = make_provenance(tool,
                                       {{"resolution", a.density.resolution_px},
                                        {"far_scale", a.density.far_scale},
                                        {"far_distance", a.density.far_distance},
                                        {"most_pixels", a.density.most_px},
                                        {"engine", a.engine}},
                                       {{"scene", scene.hash}, {"cells", settings.cells_hash}});
  write_file(folder / kCapturesManifest, format_json(format_settings(settings, made_by)));
  tool.report({{"centres", centres.size()},
               {"kept", counts.n_kept.load()},
               {"captures", counts.n_tiles.load()},
               {"pixels", counts.n_pixels.load()},
               {"left_out", counts.n_left_out.load()},
               {"cell_mb_most", most_mb}});
  tool.say(std::to_string(centres.size()) + " centres, " + std::to_string(counts.n_kept.load()) +
           " of them already there, " + std::to_string(counts.n_tiles.load()) +
           " captures; up to " + std::to_string(std::lround(most_mb)) + " MB a cell");
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "depthcap", "Capture colour and depth of objects from the centres of cells.",
      "depthcap park/scene.json cells.json --cells path:park/path.json -o captures");
  viewcell::DepthcapArguments arguments;
  viewcell::declare_arguments(tool, arguments);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, arguments); });
}

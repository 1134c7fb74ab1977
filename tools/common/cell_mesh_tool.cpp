#include "common/cell_mesh_tool.h"

#include <mutex>

#include "bake/derive.h"
#include "base/file.h"
#include "base/folder_lock.h"
#include "common/provenance.h"
#include "common/scene_inputs.h"
#include "common/tool.h"

namespace viewcell {
namespace {

struct Options {
  std::string scene_file, cells_file, captures;
  std::string cell_list = "all", slice;
  BakeOptions bake;
};

void declare_weights(Command& command, WeightOptions& w) {
  const auto add = [&](const char* flag, double& value, const char* what) {
    command.add_option(flag, &value, what).show_default().check(within(0, 100));
  };
  add("--weight-exterior", w.exterior_silhouette, "weight of exterior silhouettes");
  add("--weight-interior-silhouette", w.interior_silhouette, "weight of C0 discontinuities");
  add("--weight-sharp", w.sharp_edge, "weight of C1 discontinuities");
  add("--weight-interior", w.interior, "weight of other pixels");
  add("--weight-invisible", w.invisible, "weight of hidden vertices");
  add("--weight-back", w.back_facing, "weight of back-facing vertices");
}

void declare(Tool& tool, Options& options) {
  declare_scene_inputs(tool, &options.scene_file, &options.cells_file, &options.cell_list);
  tool.add_option("captures", &options.captures, "folder of captures")
      .required()
      .reads("the folder of captures that is read", kCaptureFiles);
  tool.add_option("--slice", &options.slice, "I/N: every N-th of those cells, from the I-th");
  const auto add = [&](const char* flag, double& value, const char* what) {
    tool.add_option(flag, &value, what).show_default().check(within(0, 1e6));
  };
  BakeOptions& bake = options.bake;
  add("--ts", bake.ts_px, "T_s: self-occluding error, px, up to which one view is enough");
  add("--tl", bake.tl_px, "T_l: cost at which collapsing ends");
  add("--max-drift", bake.max_drift_px,
      "bound in px, as seen from the cell, on how far a vertex may lie off the planes of the "
      "triangles that it replaces (a weighted root mean square)");
  add("--start-error", bake.start_error_px, "px of error of the level to start from; 0: original");
  add("--tc0", bake.categories.tc0, "T_C0, window depth for near 1, far infinite");
  add("--tc1", bake.categories.tc1, "T_C1, likewise");
  declare_weights(tool, bake.weights);
  tool.add_output_folder("folder of meshes to write, a PLY a cell", kCellMeshFiles);
}

Json format_counts(const DeriveCounts& counts, std::size_t n_cells, std::size_t n_kept) {
  const CellMeshCounts& t = counts.triangles;
  Json refused = Json::object();
  for (int k = 1; k < kRefusalKinds; ++k)
    refused[refusal_name(static_cast<Refusal>(k))] =
        t.collapses.n_refused[static_cast<std::size_t>(k)];
  return {{"cells", n_cells},
          {"kept", n_kept},
          {"meshes", counts.n_meshes},
          {"unseen", counts.n_unseen},
          {"uncaptured", counts.n_uncaptured},
          {"triangles_original", t.n_original},
          {"triangles_start", t.n_start},
          {"triangles_back_facing", t.n_back_facing},
          {"triangles_out", t.n_out},
          {"collapses", t.collapses.n_collapses},
          {"refused", refused}};
}

int run(Tool& tool, Representation kind, Options& options) {
  const int n_threads = tool.common().n_threads;
  const Scene scene =
      read_scene(options.scene_file, {.n_threads = n_threads, .limits = mesh_limits(tool)});
  register_scene_files(tool, scene, options.scene_file);
  const CellSet cells = read_cells(options.cells_file);
  check_cells_of_scene(cells, scene, options.cells_file);
  const auto list = select_cells(cells, options.cell_list, options.slice);
  check_tested(cells, list, options.cells_file);
  const CaptureSettings settings = read_settings(options.captures, scene, cells.file_hash);
  options.bake.resolution_px = settings.density.resolution_px;
  const std::string made_by =
      make_provenance(tool, format_options(options.bake), {{"captures", settings.key()}}).dump();
  const std::string key = hash_hex(settings.key() + format_options(options.bake).dump());
  const std::filesystem::path folder = tool.common().output;
  make_folder(folder);
  const FolderLock folder_lock(folder, tool.name(), key);

  const BakeScene bake = build_bake_scene(scene, cells, n_threads);
  std::mutex mutex;  // guards the sums
  DeriveCounts sums;
  std::size_t n_kept = 0;
  const auto derive = [&](std::size_t i) {
    const std::filesystem::path file = folder / weighted_mesh_name(list[i]);
    const bool is_there = is_derived(file, kind, list[i], key);
    DeriveCounts counts;
    if (!is_there) {
      WeightedMeshes meshes =
          derive_cell(bake, options.captures, settings, list[i], kind, options.bake, counts);
      meshes.made_from = key;
      write_weighted_meshes(file, meshes, made_by);
    }
    const std::lock_guard lock(mutex);
    sums.add(counts);
    n_kept += is_there;
  };
  parallel_for(list.size(), n_threads, derive, tool.progress("cells"));
  tool.report(format_counts(sums, list.size(), n_kept));
  tool.say(std::to_string(list.size()) + " cells (" + std::to_string(n_kept) + " already there), " +
           std::to_string(sums.n_meshes) + " meshes of " + std::to_string(sums.triangles.n_out) +
           " triangles");
  return 0;
}

}  // namespace

int cell_mesh_tool_main(int argc, char** argv, Representation kind, const std::string& name,
                        const std::string& description) {
  Tool tool(name, description,
            name + " park/scene.json cells.json captures/ --ts 5 --tl 4.5 --cells 120-130 -o " +
                name + "/");
  Options options;
  declare(tool, options);
  return tool.main(argc, argv, [&] { return run(tool, kind, options); });
}

}  // namespace viewcell

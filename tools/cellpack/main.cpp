// cellpack: packs a bake into the bundle that the player loads.
#include "bake/pack.h"
#include "common/provenance.h"
#include "common/scene_inputs.h"
#include "common/tool.h"

namespace viewcell {
namespace {

struct Options {
  PackInputs inputs;
  std::string cell_list = "all";
  std::string texture_format = "rgba8";
};

void declare(Tool& tool, Options& options) {
  PackInputs& inputs = options.inputs;
  declare_scene_inputs(tool, &inputs.scene_file, &inputs.cells_file, &options.cell_list);
  const auto add_folder = [&](const char* name, std::filesystem::path& folder, const char* what,
                              const std::vector<std::string>& files) {
    tool.add_option(name, &folder, what)
        .required()
        .reads("the " + std::string(what) + " that is read", files);
  };
  add_folder("captures", inputs.captures, "folder of captures", kCaptureFiles);
  add_folder("svmesh", inputs.svmesh, "folder of SVMeshes", kCellMeshFiles);
  add_folder("mvmesh", inputs.mvmesh, "folder of MVMeshes", kCellMeshFiles);
  tool.add_option("--textures", &options.texture_format, "rgba8 | bc3 (a quarter of the disk)")
      .show_default()
      .check(one_of({"rgba8", "bc3"}));
  tool.add_output_folder("folder of the bundle to write", kBundleFiles);
}

int run(Tool& tool, const Options& options) {
  const int n_threads = tool.common().n_threads;
  const Scene scene =
      read_scene(options.inputs.scene_file, {.n_threads = n_threads, .limits = mesh_limits(tool)});
  register_scene_files(tool, scene, options.inputs.scene_file);
  const CellSet cells = read_cells(options.inputs.cells_file);
  check_cells_of_scene(cells, scene, options.inputs.cells_file);
  const auto list = select_cells(cells, options.cell_list);
  const auto format = options.texture_format == "bc3" ? TextureFormat::bc3 : TextureFormat::rgba8;
  const Json made_by =
      make_provenance(tool, {{"textures", options.texture_format}}, {{"scene", scene.hash}});
  const PackCounts c = pack_bundle(scene, cells, options.inputs, list, format, made_by,
                                   tool.common().output, n_threads, tool.progress("files"));
  const double per_cell = static_cast<double>(c.n_triangles_originals + c.n_triangles_outside) /
                          static_cast<double>(c.n_cells);
  tool.report({{"cells", c.n_cells},
               {"centres", c.n_centres},
               {"single_view", c.n_single_view},
               {"multi_view", c.n_multi_view},
               {"inside", c.n_inside},
               {"own", c.n_own},
               {"unseen", c.n_unseen},
               {"triangles_originals", c.n_triangles_originals},
               {"triangles_outside", c.n_triangles_outside},
               {"triangles_per_cell_mean", per_cell},
               {"simplified_to_original", count_triangles(scene) / per_cell},
               {"texture_bytes", c.texel_bytes}});
  tool.say(std::to_string(c.n_cells) + " cells, " + std::to_string(c.n_centres) + " centres, " +
           std::to_string(static_cast<long>(per_cell)) + " triangles a cell, 1 to " +
           std::to_string(static_cast<double>(count_triangles(scene)) / per_cell).substr(0, 5) +
           " of the scene's");
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "cellpack", "Pack captures and meshes of view cells into a bundle.",
      "cellpack park/scene.json cells.json captures/ svmesh/ mvmesh/ -o park.bundle/");
  viewcell::Options options;
  viewcell::declare(tool, options);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, options); });
}

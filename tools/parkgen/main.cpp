// parkgen: generates a statuary park and a walk through it.
#include <sstream>

#include "base/error.h"
#include "base/file.h"
#include "base/folder_lock.h"
#include "common/mesh_input.h"
#include "common/provenance.h"
#include "common/tool.h"
#include "park/models.h"
#include "park/park.h"

namespace viewcell {
namespace {

struct Options {
  std::string preset = "demo";
  std::string models_folder;
  std::uint64_t seed = 3;
  bool list = false;
};

const ParkPreset& find_preset(const std::string& name) {
  for (const ParkPreset& preset : park_presets())
    if (preset.name == name) return preset;
  throw UsageError("--preset: '" + name + "' is not demo, 2m, 4m or 8m");
}

void declare(Tool& tool, Options& options) {
  tool.add_option("--preset", &options.preset, "demo (4m, short walk), 2m, 4m or 8m")
      .show_default();
  tool.add_option(
          "--models", &options.models_folder,
          "folder of real models: models.json (docs/formats.md), or files named by kind (--list)")
      .reads("the folder of models that is read", {"*"});
  tool.add_option("--seed", &options.seed, "of all that is random").show_default();
  tool.add_mesh_limit(tool);
  tool.add_flag(
      "--list", &options.list,
      "print the kinds of statue (what models.json may name), their triangles, sizes and numbers "
      "in each park, tab-separated, and stop");
  tool.add_output_folder("folder to write: scene.json, path.json, meshes/",
                         {"scene.json", "path.json", "meshes/*"}, false);
}

// Tab-separated, a heading first.
void print_kinds() {
  std::ostringstream out;
  out << "kind\ttriangles\twidth\tdepth\theight\tin 2m\tin 4m\tin 8m\tfigure\n";
  for (const StatueKind& kind : statue_kinds()) {
    out << kind.name << '\t' << kind.n_triangles;
    for (int axis = 0; axis < 3; ++axis) out << '\t' << kind.size[axis];
    for (const int count : kind.counts) out << '\t' << count;
    out << '\t' << kind.figure << '\n';
  }
  write_file("-", out.str());
}

Json make_report(const Park& park, const ParkPreset& preset, const Options& options) {
  const WalkReport& walk = park.report;
  const auto size = static_cast<std::size_t>(preset.size);
  Json meshes = Json::array();
  for (const SceneMesh& mesh : park.scene.meshes)
    meshes.push_back(
        {{"name", mesh.name}, {"triangles", mesh.n_triangles}, {"substitutes", mesh.substitutes}});
  return {{"preset", preset.name},
          {"seed", options.seed},
          {"objects", park.scene.objects.size()},
          {"triangles", count_triangles(park.scene)},
          {"meshes", meshes},
          {"coverage_estimate", walk.coverage[size]},
          {"inside_share", walk.share_inside[size]},
          {"inside_triangles_mean", walk.triangles_inside[size]},
          {"large_in_view_s", walk.large_in_view_s},
          {"path_length", walk.length},
          {"path_duration_s", walk.duration_s},
          {"path_cells", walk.n_cells},
          {"path_clearance", walk.min_clearance}};
}

int run(const Tool& tool, const Options& options) {
  if (options.list) {
    print_kinds();
    return 0;
  }
  const ParkPreset& preset = find_preset(options.preset);
  if (tool.common().output.empty()) throw UsageError("-o FOLDER is missing");
  const int n_threads = tool.common().n_threads;
  ParkMeshes meshes = make_park_meshes(options.models_folder, n_threads, mesh_limits(tool));
  for (const std::string& note : meshes.notes) tool.say(note);
  for (const auto& [file, remarks] : meshes.remarks) tool.remark(file, remarks);
  Json inputs = Json::object();  // the models' hashes
  for (std::size_t k = 0; k < kStatueKinds; ++k)
    if (!meshes.source_hashes[k].empty()) inputs[statue_kinds()[k].name] = meshes.source_hashes[k];
  Park park = make_park(std::move(meshes.meshes), preset, options.seed, n_threads);
  const Json made_by =
      make_provenance(tool, {{"preset", preset.name}, {"seed", options.seed}}, inputs);
  make_folder(tool.common().output);
  const FolderLock lock(tool.common().output, tool.name(), hash_hex(made_by.dump()));
  write_park(park, tool.common().output, made_by, tool.progress("mesh"));
  tool.report(make_report(park, preset, options));
  tool.say(std::to_string(park.scene.objects.size()) + " statues, " +
           std::to_string(count_triangles(park.scene)) + " triangles, a walk through " +
           std::to_string(park.report.n_cells) + " cells in " +
           std::to_string(static_cast<int>(park.report.duration_s)) + " s");
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool("parkgen", "Generate a statuary park and a walk through it.",
                      "parkgen --preset 2m --models out/models -o park/");
  viewcell::Options options;
  viewcell::declare(tool, options);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, options); });
}

// hexcells: lays hexagonal view cells over a scene.
#include "cells/cells.h"

#include "base/error.h"
#include "base/file.h"
#include "cells/map.h"
#include "cells/odd_sizes.h"
#include "cells/own_materials.h"
#include "common/provenance.h"
#include "common/scene_inputs.h"
#include "common/tool.h"

namespace viewcell {
namespace {

struct Options {
  std::string scene_file;
  double size = 50;
  std::string eye_height = "16:20";
  std::string svg_file;
  std::string path_file;
  std::string choose = "cost";
};

EyeHeight parse_eye_height(const std::string& text) {
  EyeHeight height;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf:%lf%c", &height.lo, &height.hi, &rest) != 2 ||
      !(height.lo <= height.hi) || !(std::abs(height.lo) < 1e6) || !(std::abs(height.hi) < 1e6))
    throw UsageError("--eye-height: '" + text + "' is not LO:HI with LO <= HI");
  return height;
}

void declare(Tool& tool, Options& options) {
  tool.add_option("scene", &options.scene_file, "scene.json")
      .required()
      .reads("the scene that is read");
  tool.add_option("--size", &options.size, "circumradius of a cell")
      .show_default()
      .check(within(1e-3, 1e6));
  tool.add_option("--eye-height", &options.eye_height, "range of the eye's heights, LO:HI")
      .show_default();
  tool.add_option("--choose", &options.choose,
                  "cost: objects outside are drawn as they are, too, where captures would cost "
                  "more or be too coarse; paper: never")
      .show_default()
      .check(one_of({"cost", "paper"}));
  tool.add_option("--svg", &options.svg_file, "draw a map of cells and objects").writes();
  tool.add_option("--path", &options.path_file, "path.json to draw into the map")
      .reads("the path that is read");
  tool.add_mesh_limit(tool);
  tool.add_output("cells.json to write (-: stdout)");
}

int run(Tool& tool, const Options& options) {
  const EyeHeight eye_height = parse_eye_height(options.eye_height);
  const Scene scene = read_scene(
      options.scene_file, {.n_threads = tool.common().n_threads, .limits = mesh_limits(tool)});
  register_scene_files(tool, scene, options.scene_file);
  CellSet cells = make_cells(scene, options.size, eye_height);
  if (options.choose == "cost") cells.own = find_own_materials(scene, cells);
  const Json made_by = make_provenance(
      tool,
      {{"size", options.size}, {"eye_height", options.eye_height}, {"choose", options.choose}},
      {{"scene", scene.hash}});
  if (!options.svg_file.empty()) {
    CameraPath path;
    Remarks remarks;
    if (!options.path_file.empty()) path = read_path(options.path_file, &remarks);
    tool.remark(options.path_file, remarks);
    write_file(options.svg_file,
               draw_map(scene, cells, options.path_file.empty() ? nullptr : &path));
  }
  write_file(tool.common().output, format_json(format_cells(cells, made_by)));
  const std::vector<std::string> hints = find_odd_sizes(scene, options.size);
  for (const std::string& hint : hints) tool.say(hint);
  std::size_t n_inside = 0;
  for (const auto& inside : cells.inside) n_inside += inside.size();
  std::size_t n_own = 0;
  for (const auto& own : cells.own) n_own += own.size();
  tool.report({{"columns", cells.grid.columns},
               {"rows", cells.grid.rows},
               {"cells", cells.grid.n_cells()},
               {"size", cells.grid.size},
               {"objects", scene.objects.size()},
               {"hints", hints},
               {"inside_mean", static_cast<double>(n_inside) / cells.grid.n_cells()},
               {"own_mean", static_cast<double>(n_own) / cells.grid.n_cells()}});
  tool.say(std::to_string(cells.grid.columns) + " x " + std::to_string(cells.grid.rows) +
           " cells over " + std::to_string(scene.objects.size()) + " objects");
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool("hexcells", "Lay hexagonal view cells over a scene.",
                      "hexcells park/scene.json --size 50 -o cells.json --svg map.svg");
  viewcell::Options options;
  viewcell::declare(tool, options);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, options); });
}

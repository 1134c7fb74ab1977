// pvs: tells which objects the eye may see from each cell.
#include <cstdio>
#include <mutex>

#include "base/error.h"
#include "base/file.h"
#include "common/mesh_input.h"
#include "common/provenance.h"
#include "common/scene_inputs.h"
#include "common/tool.h"
#include "visibility/seen_objects.h"

namespace viewcell {
namespace {

struct Options {
  std::string scene_file, cells_file, cell_list = "all";
  SeenOptions seen;
};

void declare(Tool& tool, Options& o) {
  declare_scene_inputs(tool, &o.scene_file, &o.cells_file, &o.cell_list);
  tool.add_option("--eyes", &o.seen.n_eyes, "eyes in a cell: its corners and middle, then others")
      .show_default()
      .check(within(13, 10000));
  tool.add_option("--patch", &o.seen.patch_px,
                  "px: what shows that much of an object is found with 95 %")
      .show_default()
      .check(within(0.01, 1e6));
  tool.add_option("--most-rays", &o.seen.most_rays, "rays that are aimed at one object at most")
      .show_default()
      .check(within(16, 1e7));
  tool.add_output("cells.json to write (-: stdout)");
}

int run(Tool& tool, const Options& o) {
  const int n_threads = tool.common().n_threads;
  const Scene scene =
      read_scene(o.scene_file, {.n_threads = n_threads, .limits = mesh_limits(tool)});
  register_scene_files(tool, scene, o.scene_file);
  CellSet cells = read_cells(o.cells_file);
  check_cells_of_scene(cells, scene, o.cells_file);
  const auto list = select_cells(cells, o.cell_list);
  const SeenFinder finder(scene, cells, o.seen, n_threads);
  std::vector<SeenFromCell> found(list.size());
  parallel_for(
      list.size(), n_threads, [&](std::size_t i) { found[i] = finder.find(list[i]); },
      tool.progress("cells"));

  const auto n_cells = static_cast<std::size_t>(cells.grid.n_cells());
  cells.is_tested.assign(n_cells, false);
  cells.unseen.assign(n_cells, {});
  std::size_t n_rays = 0, n_unseen = 0, n_outside = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    n_rays += found[i].n_rays, n_unseen += found[i].unseen.size();
    n_outside += cells.n_objects - cells.inside[index(list[i])].size();
    cells.is_tested[index(list[i])] = true;
    cells.unseen[index(list[i])] = std::move(found[i].unseen);
  }
  cells.seen_by = {{"method", "rays"},
                   {"eyes", o.seen.n_eyes},
                   {"patch_px", o.seen.patch_px},
                   {"most_rays", o.seen.most_rays}};
  const Json made_by = make_provenance(tool, {{"cells", o.cell_list}, {"seen_by", cells.seen_by}},
                                       {{"scene", scene.hash}, {"cells", cells.file_hash}});
  write_file(tool.common().output, format_json(format_cells(cells, made_by)));
  const double n = static_cast<double>(list.size());
  const double share = static_cast<double>(n_unseen) / std::max(1.0, double(n_outside));
  tool.report({{"cells", list.size()},
               {"rays_per_cell", static_cast<double>(n_rays) / n},
               {"unseen_mean", static_cast<double>(n_unseen) / n},
               {"unseen_share", share}});
  char text[160];
  std::snprintf(text, sizeof text,
                "%zu cells: of the objects outside %.1f %% are not seen, by %.0f rays a cell",
                list.size(), 100 * share, static_cast<double>(n_rays) / n);
  tool.say(text);
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool("pvs",
                      "Tell which objects the eye may see from each cell (potentially visible "
                      "sets), by rays.",
                      "pvs house/scene.json house/grid.json --cells path:house/path.json "
                      "-o house/cells.json");
  viewcell::Options options;
  viewcell::declare(tool, options);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, options); });
}

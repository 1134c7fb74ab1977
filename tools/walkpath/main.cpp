// walkpath: a walk through a scene, where one can stand.
#include <cstdio>

#include "base/error.h"
#include "base/file.h"
#include "common/mesh_input.h"
#include "common/provenance.h"
#include "common/scene_inputs.h"
#include "common/tool.h"
#include "walk/walk.h"

namespace viewcell {
namespace {

struct Options {
  std::string scene_file, cells_file;
  std::vector<std::string> through;
  double seconds = 0;
};

glm::dvec2 parse_place(const std::string& text) {
  glm::dvec2 place(0);
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf%c", &place.x, &place.y, &rest) != 2 ||
      !(std::abs(place.x) <= 1e7) || !(std::abs(place.y) <= 1e7))
    throw UsageError("--through: '" + text + "' is not X,Y");
  return place;
}

void declare(Tool& tool, Options& o) {
  tool.add_option("scene", &o.scene_file, "scene.json").required().reads("the scene that is read");
  tool.add_option("cells", &o.cells_file, "cells.json")
      .required()
      .reads("the file of cells that is read");
  tool.add_option("--through", &o.through,
                  "X,Y: a place to pass, in the scene's units; several times, in that order "
                  "(default: through the largest free space, by where there is much to see)");
  tool.add_option("--seconds", &o.seconds, "how long the walk is at most; 0: to its end")
      .show_default()
      .check(within(0, 1e5));
  tool.add_mesh_limit(tool);
  tool.add_output("path.json to write (-: stdout)");
}

int run(Tool& tool, const Options& o) {
  const int n_threads = tool.common().n_threads;
  const Scene scene =
      read_scene(o.scene_file, {.n_threads = n_threads, .limits = mesh_limits(tool)});
  register_scene_files(tool, scene, o.scene_file);
  const CellSet cells = read_cells(o.cells_file);
  check_cells_of_scene(cells, scene, o.cells_file);
  WalkOptions options;
  for (const std::string& place : o.through) options.through.push_back(parse_place(place));
  options.seconds = o.seconds;
  options.eye_height = cells.eye_height.middle();
  options.speed = 1.25 * options.eye_height / 1.6;
  const StandingRoom room =
      find_standing_room(scene, cells, walker_of(options.eye_height), n_threads);
  const Walk walk = make_walk(room, options, o.scene_file);
  Json through = Json::array();
  for (const std::string& place : o.through) through.push_back(place);
  const Json made_by = make_provenance(tool, {{"through", through}, {"seconds", o.seconds}},
                                       {{"scene", scene.hash}, {"cells", cells.file_hash}});
  write_file(tool.common().output, format_json(format_path(walk.path, made_by)));
  const double seconds = walk.path.samples.back().time_s;
  tool.report({{"length", walk.length}, {"seconds", seconds}, {"room_share", walk.room_share}});
  char text[120];
  std::snprintf(text, sizeof text, "%.0f s, %.0f units; one can walk to %.1f %% of the area",
                seconds, walk.length, 100 * walk.room_share);
  tool.say(text);
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool("walkpath", "Make a walk through a scene, where one can stand.",
                      "walkpath house/scene.json house/cells.json -o house/path.json");
  viewcell::Options options;
  viewcell::declare(tool, options);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, options); });
}

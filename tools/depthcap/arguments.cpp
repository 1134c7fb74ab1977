#include "depthcap/arguments.h"

namespace viewcell {

void declare_arguments(Tool& tool, DepthcapArguments& a) {
  CLI::App& app = tool.app();
  app.add_option("scene", a.scene_file, "scene.json")->required();
  app.add_option("cells", a.cells_file, "cells.json")->required();
  app.add_option("--cells", a.cell_list, "all | 3,7,10-19 | @FILE | path:path.json")
      ->capture_default_str();
  app.add_option("--slice", a.slice, "I/N: every N-th of those cells, from the I-th");
  app.add_option("--resolution", a.density.resolution_px, "pixels per width of a side face")
      ->capture_default_str()
      ->check(CLI::Range(16, 8192));
  app.add_option("--far-scale", a.density.far_scale, "times that density for far objects")
      ->capture_default_str()
      ->check(within(0.1, 16));
  app.add_option("--far-distance", a.density.far_distance, "from where an object is far")
      ->capture_default_str()
      ->check(within(0, 1e9));
  app.add_option("--most-pixels", a.density.most_px, "pixels of one object's crop at most")
      ->capture_default_str()
      ->check(CLI::Range(64, 1 << 28));
  app.add_option("--engine", a.engine, "embree | gl")
      ->capture_default_str()
      ->check(CLI::IsMember({"embree", "gl"}));
  app.add_option("--gl", a.gl, "of engine gl: osmesa | egl")->capture_default_str();
  tool.add_output("folder of captures to write");
}

}  // namespace viewcell

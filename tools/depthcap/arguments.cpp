#include "depthcap/arguments.h"

namespace viewcell {

void declare_arguments(Tool& tool, DepthcapArguments& a) {
  tool.add_option("scene", &a.scene_file, "scene.json").required();
  tool.add_option("cells", &a.cells_file, "cells.json").required();
  tool.add_option("--cells", &a.cell_list, "all | 3,7,10-19 | @FILE | path:path.json")
      .show_default();
  tool.add_option("--slice", &a.slice, "I/N: every N-th of those cells, from the I-th");
  tool.add_option("--resolution", &a.density.resolution_px, "pixels per width of a side face")
      .show_default()
      .check(in_range(16, 8192));
  tool.add_option("--far-scale", &a.density.far_scale, "times that density for far objects")
      .show_default()
      .check(within(0.1, 16));
  tool.add_option("--far-distance", &a.density.far_distance, "from where an object is far")
      .show_default()
      .check(within(0, 1e9));
  tool.add_option("--most-pixels", &a.density.most_px, "pixels of one object's crop at most")
      .show_default()
      .check(in_range(64, 1 << 28));
  tool.add_option("--engine", &a.engine, "embree | gl")
      .show_default()
      .check(one_of({"embree", "gl"}));
  tool.add_option("--gl", &a.gl, "of engine gl: osmesa | egl").show_default();
  tool.add_output("folder of captures to write");
}

}  // namespace viewcell

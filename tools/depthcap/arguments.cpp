#include "depthcap/arguments.h"

#include "common/picture_input.h"
#include "common/scene_inputs.h"

namespace viewcell {

void declare_arguments(Tool& tool, DepthcapArguments& a) {
  declare_scene_inputs(tool, &a.scene_file, &a.cells_file, &a.cell_list);
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
  tool.add_option("--budget", &a.budget_mb,
                  "MB of textures that a cell may need at most, by the captures of its seven "
                  "centres; play holds 512 at most; 0: any")
      .show_default()
      .check(within(0, 1e9));
  tool.add_option("--engine", &a.engine, "embree | gl")
      .show_default()
      .check(one_of({"embree", "gl"}));
  tool.add_option("--gl", &a.gl, "of engine gl: osmesa | egl").show_default();
  declare_max_pixels(tool, &a.max_pixels);
  tool.add_output_folder("folder of captures to write", kCaptureFiles);
}

}  // namespace viewcell

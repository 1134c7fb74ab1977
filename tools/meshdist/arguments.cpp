#include "meshdist/arguments.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "base/error.h"

namespace viewcell {
namespace {

std::array<double, 2> parse_range(const std::string& text) {
  double lo = 0, hi = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf:%lf%c", &lo, &hi, &rest) != 2 || !(lo < hi) ||
      !std::isfinite(lo) || !std::isfinite(hi))
    throw UsageError("--range: '" + text + "' is not LO:HI with LO below HI");
  return {lo, hi};
}

}  // namespace

void declare_arguments(Tool& tool, MeshdistArguments& arguments) {
  DistanceOptions& options = arguments.options;
  tool.add_option("A", &arguments.a,
                  "mesh: OBJ, PLY, PLY.GZ, OFF, STL, GLB, glTF or 3DS (-: stdin), or a point cloud")
      .required()
      .reads("A");
  tool.add_option("B", &arguments.b, "the mesh to compare with it").required().reads("B");
  tool.add_option("--samples", &options.n_samples,
                  "samples on the faces of each mesh; not for a point cloud")
      .show_default()
      .check(in_range(1, 100'000'000));
  tool.add_option("--seed", &options.seed, "shifts the samples on faces; not for a point cloud")
      .show_default()
      .check(whole_within(0, std::numeric_limits<decltype(options.seed)>::max()));
  tool.add_flag("--unit-cube", &options.unit_cube,
                "results as if A were scaled into the unit cube, and B by the same factor");
  tool.add_option(
          "--color", &arguments.color,
          "write A as PLY with distances of vertices, as colours too: green near, blue far; "
          "not for a point cloud as B")
      .writes();
  tool.add_option("--range", &arguments.range_text,
                  "LO:HI, distances of green and blue (default: 0 to the 99th percentile)");
  tool.add_option("--histogram", &options.n_bins,
                  "count distances in this many equal parts of 0:max")
      .check(in_range(1, 100'000));
  tool.add_option("--histogram-to", &options.histogram_most,
                  "end its last part here, not at max: the same parts for several meshes")
      .check(within(1e-30, 1e30))
      .needs("--histogram");
  tool.add_option(
          "--fail-above", &arguments.fail_above,
          "exit with 5 when the symmetric maximum, or that of a point cloud, is above this, or "
          "0.1%: of A's box's diagonal")
      .check(length_within(0, 1e300));
  tool.add_mesh_limit(tool);
  tool.add_output("write the table to this file (default -: standard output)", false);
}

void finish_arguments(MeshdistArguments& arguments) {
  check_ending({"--color", arguments.color}, {".ply"}, "a PLY");
  if (arguments.range_text) arguments.range = parse_range(*arguments.range_text);
}

}  // namespace viewcell

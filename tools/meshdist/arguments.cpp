#include "meshdist/arguments.h"

#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "common/files.h"

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
  CLI::App& app = tool.app();
  DistanceOptions& options = arguments.options;
  app.add_option("A", arguments.a, "mesh: OBJ, PLY, PLY.GZ, OFF, STL, GLB, glTF or 3DS (-: stdin)")
      ->required();
  app.add_option("B", arguments.b, "the mesh to compare with it")->required();
  app.add_option("--samples", options.n_samples, "samples on the faces of each mesh")
      ->capture_default_str()
      ->check(CLI::Range(1, 100'000'000));
  app.add_option("--seed", options.seed, "shifts the samples on faces")
      ->capture_default_str()
      ->check(whole_within(0, std::numeric_limits<decltype(options.seed)>::max()));
  app.add_flag("--unit-cube", options.unit_cube,
               "results as if A were scaled into the unit cube, and B by the same factor");
  app.add_option("--color", arguments.color,
                 "write A as PLY with distances of vertices, as colours too: green near, blue far");
  app.add_option("--range", arguments.range_text,
                 "LO:HI, distances of green and blue (default: 0 to the 99th percentile)");
  CLI::Option* histogram = app.add_option("--histogram", options.n_bins,
                                          "count distances in this many equal parts of 0:max")
                               ->check(CLI::Range(1, 100'000));
  app.add_option("--histogram-to", options.histogram_most,
                 "end its last part here, not at max: the same parts for several meshes")
      ->check(within(1e-30, 1e30))
      ->needs(histogram);
  app.add_option("--fail-above", arguments.fail_above,
                 "exit with 5 when the symmetric maximum is above this")
      ->check(within(0, 1e300));
  tool.add_output("write the table to this file (default -: standard output)", false);
}

void finish_arguments(const Tool& tool, MeshdistArguments& arguments) {
  const CommonOptions& common = tool.common();
  check_ending({"--color", arguments.color}, {".ply"}, "a PLY");
  check_files({{"A", arguments.a}, {"B", arguments.b}},
              {{"-o", common.output}, {"--json", common.json_file}, {"--color", arguments.color}});
  if (arguments.range_text) arguments.range = parse_range(*arguments.range_text);
}

}  // namespace viewcell

// meshdist: how far two surfaces are from each other.
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/file.h"
#include "base/table.h"
#include "common/files.h"
#include "common/provenance.h"
#include "common/stopwatch.h"
#include "common/tool.h"
#include "mesh/distance_report.h"

namespace viewcell {
namespace {

constexpr int kOverThreshold = 5;

struct Arguments {
  std::string a, b, color;
  std::optional<std::string> range;
  double fail_above = std::numeric_limits<double>::infinity();
  DistanceOptions options;
};

void declare(Tool& tool, Arguments& arguments) {
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
  app.add_option("--range", arguments.range,
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

std::array<double, 2> parse_range(const std::string& text) {
  double lo = 0, hi = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf:%lf%c", &lo, &hi, &rest) != 2 || !(lo < hi) ||
      !std::isfinite(lo) || !std::isfinite(hi))
    throw UsageError("--range: '" + text + "' is not LO:HI with LO below HI");
  return {lo, hi};
}

void write_color(const Tool& tool, const Arguments& arguments, const TriMesh& a,
                 const SurfaceDistance& distance, const std::array<double, 2>& range,
                 const std::array<std::string, 2>& hashes) {
  const DistanceOptions& options = arguments.options;
  const Json typed{{"samples", options.n_samples},
                   {"seed", options.seed},
                   {"unit_cube", options.unit_cube},
                   {"range", range}};
  write_colored_mesh(
      arguments.color, a, distance, range,
      {"provenance " + make_provenance(tool, typed, {{"a", hashes[0]}, {"b", hashes[1]}}).dump()});
}

void check_paths(const Tool& tool, const Arguments& arguments) {
  const CommonOptions& common = tool.common();
  check_ending({"--color", arguments.color}, {".ply"}, "a PLY");
  check_files({{"A", arguments.a}, {"B", arguments.b}},
              {{"-o", common.output}, {"--json", common.json_file}, {"--color", arguments.color}});
}

int run(const Tool& tool, const Arguments& arguments) {
  check_paths(tool, arguments);
  std::optional<std::array<double, 2>> range;
  if (arguments.range) range = parse_range(*arguments.range);
  std::array<std::string, 2> hashes;
  const TriMesh a = read_surface(arguments.a, &hashes[0]);
  const TriMesh b = read_surface(arguments.b, &hashes[1]);
  DistanceOptions options = arguments.options;
  options.n_threads = tool.common().n_threads;
  Stopwatch watch;
  const SurfaceDistance distance = measure_surface_distance(a, b, options, tool.progress("block"));
  const double took_s = watch.lap_s();
  if (!arguments.color.empty())
    write_color(tool, arguments, a, distance, range.value_or(default_color_range(distance)),
                hashes);

  const std::string table_file = tool.common().output.empty() ? "-" : tool.common().output;
  if (!(tool.common().json_file == "-" && table_file == "-"))
    write_file(table_file, format_surface_distance(distance));
  tool.report(report_surface_distance(distance, options));
  const std::size_t n = distance.forward.n_all_samples() + distance.backward.n_all_samples();
  tool.say(format_fixed(1e-6 * static_cast<double>(n), 2, "") + " million samples in " +
           format_fixed(took_s, 2, "") + " s");
  const double most = distance.symmetric().max;
  if (!(most > arguments.fail_above)) return 0;
  std::fprintf(stderr, "meshdist: symmetric maximum %.6g is above %.6g\n", most,
               arguments.fail_above);
  return kOverThreshold;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "meshdist",
      "Measures how far surface A is from B (forward) and B from A: maximum over vertices, edges "
      "and faces (Hausdorff distance), mean, RMS, percentiles over the area. Symmetric: the "
      "larger.",
      "meshdist bunny.ply bunny-1000.ply --unit-cube --color error.ply --range 0:0.03\n"
      "  meshdist a.ply b.ply --fail-above 0.01 --json distance.json");
  viewcell::Arguments arguments;
  viewcell::declare(tool, arguments);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, arguments); });
}

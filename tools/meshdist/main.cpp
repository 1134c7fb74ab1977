// meshdist: how far two surfaces are from each other.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/file.h"
#include "base/table.h"
#include "common/provenance.h"
#include "common/tool.h"
#include "mesh/distance_report.h"
#include "mesh/io.h"
#include "mesh/surface_samples.h"

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
  app.add_option("A", arguments.a, "mesh: OBJ, PLY, PLY.GZ, OFF, STL, GLB, glTF or 3DS")
      ->required();
  app.add_option("B", arguments.b, "the mesh to compare with it")->required();
  app.add_option("--samples", options.n_samples, "samples on the faces of each mesh")
      ->capture_default_str()
      ->check(CLI::Range(1, 100'000'000));
  app.add_option("--seed", options.seed, "shifts the samples on faces")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--unit-cube", options.unit_cube,
               "results as if A were scaled into the unit cube, and B by the same factor");
  app.add_option("--color", arguments.color,
                 "write A as PLY with its vertices' distances, as numbers and as colours: green "
                 "near 0, red in between, blue far");
  app.add_option("--range", arguments.range,
                 "LO:HI, distances of green and blue (default: 0 to the 99th percentile)");
  app.add_option("--histogram", options.n_bins, "count distances in this many equal parts of 0:max")
      ->check(CLI::Range(1, 100'000));
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

TriMesh read_surface(const std::string& file) {
  TriMesh mesh = read_mesh(file);
  if (!(surface_area(mesh) > 0)) throw InputError(file, "", "has no area: no face is a triangle");
  return mesh;
}

std::string format_speed(const SurfaceDistance& distance, double seconds) {
  const double millions = 1e-6 * static_cast<double>(distance.forward.n_all_samples() +
                                                     distance.backward.n_all_samples());
  return format_fixed(millions, 2, "") + " million samples in " + format_fixed(seconds, 2, "") +
         " s: " + format_fixed(millions / seconds, 2, "") + " million a second";
}

void write_color(const Tool& tool, const Arguments& arguments, const TriMesh& a,
                 const SurfaceDistance& distance, const std::array<double, 2>& range) {
  const Json options{{"samples", arguments.options.n_samples},
                     {"seed", arguments.options.seed},
                     {"unit_cube", arguments.options.unit_cube},
                     {"range", range}};
  const Json inputs{{"a", hash_file(arguments.a)}, {"b", hash_file(arguments.b)}};
  write_colored_mesh(arguments.color, a, distance, range,
                     {"provenance " + make_provenance(tool, options, inputs).dump()});
}

int run(const Tool& tool, const Arguments& arguments) {
  std::optional<std::array<double, 2>> range;
  if (arguments.range) range = parse_range(*arguments.range);
  const TriMesh a = read_surface(arguments.a);
  const TriMesh b = read_surface(arguments.b);
  DistanceOptions options = arguments.options;
  options.n_threads = tool.common().n_threads;
  const auto start = std::chrono::steady_clock::now();
  const SurfaceDistance distance = measure_surface_distance(a, b, options, tool.progress("block"));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  if (!arguments.color.empty())
    write_color(tool, arguments, a, distance, range.value_or(default_color_range(distance)));

  const CommonOptions& common = tool.common();
  const std::string table_file = common.output.empty() ? "-" : common.output;
  if (!(common.json_file == "-" && table_file == "-"))
    write_file(table_file, format_surface_distance(distance));
  tool.report(report_surface_distance(distance, options));
  tool.say(format_speed(distance, took.count()));
  return distance.symmetric().max > arguments.fail_above ? kOverThreshold : 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "meshdist",
      "Measures how far two surfaces are from each other, from A to B (forward) and from B to A: "
      "the maximum over vertices, edges and faces (Hausdorff distance), mean, RMS and percentiles "
      "over the area. Symmetric is the larger of both.",
      "meshdist bunny.ply bunny-1000.ply --unit-cube --color error.ply --range 0:0.03\n"
      "  meshdist a.ply b.ply --fail-above 0.01 --json distance.json");
  viewcell::Arguments arguments;
  viewcell::declare(tool, arguments);
  return tool.main(argc, argv, [&] { return viewcell::run(tool, arguments); });
}

// meshdist: how far two surfaces are from each other.
#include <chrono>
#include <cmath>
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

// "LO:HI" as two finite numbers, LO below HI.
std::array<double, 2> parse_range(const std::string& text) {
  const std::size_t colon = text.find(':');
  std::array<double, 2> range{};
  if (colon == std::string::npos || !CLI::detail::lexical_cast(text.substr(0, colon), range[0]) ||
      !CLI::detail::lexical_cast(text.substr(colon + 1), range[1]) || !std::isfinite(range[0]) ||
      !std::isfinite(range[1]) || !(range[0] < range[1]))
    throw UsageError("--range: '" + text + "' is not LO:HI with LO below HI");
  return range;
}

TriMesh read_surface(const std::string& file) {
  TriMesh mesh = read_mesh(file);
  if (!(surface_area(mesh) > 0)) throw InputError(file, "", "has no area: no face is a triangle");
  return mesh;
}

SurfaceDistance measure(const Tool& tool, const Arguments& arguments, const TriMesh& a) {
  const TriMesh b = read_surface(arguments.b);
  DistanceOptions options = arguments.options;
  options.n_threads = tool.common().n_threads;
  const auto start = std::chrono::steady_clock::now();
  SurfaceDistance distance = measure_surface_distance(a, b, options, tool.progress("block"));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  const auto n =
      static_cast<double>(distance.forward.n_all_samples() + distance.backward.n_all_samples());
  tool.say(format_fixed(n / 1e6, 2, "") + " million samples in " +
           format_fixed(took.count(), 2, "") +
           " s: " + format_fixed(n / 1e6 / took.count(), 2, "") + " million a second");
  return distance;
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
  std::array<double, 2> range{};
  if (arguments.range) range = parse_range(*arguments.range);
  const TriMesh a = read_surface(arguments.a);
  const SurfaceDistance distance = measure(tool, arguments, a);
  if (!arguments.range) range = default_color_range(distance);
  if (!arguments.color.empty()) write_color(tool, arguments, a, distance, range);

  const CommonOptions& common = tool.common();
  const std::string table_file = common.output.empty() ? "-" : common.output;
  if (!(common.json_file == "-" && table_file == "-"))
    write_file(table_file, format_surface_distance(distance));
  tool.report(report_surface_distance(distance, arguments.options));
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

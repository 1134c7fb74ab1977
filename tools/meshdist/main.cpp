// meshdist: how far two surfaces are from each other.
#include <cstdio>

#include "base/file.h"
#include "common/mesh_input.h"
#include "common/provenance.h"
#include "common/stopwatch.h"
#include "meshdist/arguments.h"
#include "report/table.h"

namespace viewcell {
namespace {

void write_color(const Tool& tool, const MeshdistArguments& arguments, const TriMesh& a,
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

int run(const Tool& tool, const MeshdistArguments& arguments) {
  std::array<std::string, 2> hashes;
  const TriMesh a = read_surface_input(tool, arguments.a, &hashes[0]);
  const TriMesh b = read_surface_input(tool, arguments.b, &hashes[1]);
  DistanceOptions options = arguments.options;
  options.n_threads = tool.common().n_threads;
  Stopwatch watch;
  const SurfaceDistance distance = measure_surface_distance(a, b, options, tool.progress("block"));
  const double took_s = watch.lap_s();
  if (!arguments.color.empty())
    write_color(tool, arguments, a, distance,
                arguments.range.value_or(default_color_range(distance)), hashes);

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
  viewcell::MeshdistArguments arguments;
  viewcell::declare_arguments(tool, arguments);
  return tool.main(
      argc, argv, [&] { viewcell::finish_arguments(arguments); },
      [&] { return viewcell::run(tool, arguments); });
}

// meshdist: how far two surfaces are from each other.
#include <cstdio>

#include "base/error.h"
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

// Options that count on samples or faces, with a point cloud.
void refuse_surface_options(const Tool& tool, const MeshdistArguments& o, PointCloud points) {
  const std::string& cloud = points == PointCloud::a ? o.a : o.b;
  for (const char* option : {"--samples", "--seed"})
    if (tool.is_given(option))
      throw InputError(cloud, "",
                       std::string("is a point cloud, all of whose points are measured: ") +
                           option + " needs two surfaces");
  if (points == PointCloud::b && !o.color.empty())
    throw InputError(cloud, "",
                     "is a point cloud, from whose points distances are measured: --color, of A, "
                     "needs a surface here, or the points as A");
}

struct Inputs {
  TriMesh a, b;
  std::array<std::string, 2> hashes;
  PointCloud points = PointCloud::none;
};

void check_extent(const MeshdistArguments& o, const TriMesh& a) {
  const Box box = bounding_box(a);
  if (o.options.unit_cube && box.lo == box.hi)
    throw InputError(o.a, "", "is one point, which --unit-cube cannot scale");
}

Inputs read_inputs(const Tool& tool, const MeshdistArguments& o) {
  Inputs in;
  in.a = read_surface_or_points_input(tool, o.a, &in.hashes[0]);
  in.b = read_surface_or_points_input(tool, o.b, &in.hashes[1]);
  if (in.a.triangles.empty() && in.b.triangles.empty())
    throw InputError(o.b, "",
                     "has no faces, and neither has " + o.a + ": distances are to a surface");
  if (in.a.triangles.empty()) in.points = PointCloud::a;
  if (in.b.triangles.empty()) in.points = PointCloud::b;
  if (in.points == PointCloud::none) return in;
  refuse_surface_options(tool, o, in.points);
  check_extent(o, in.a);
  return in;
}

SurfaceDistance measure(const Inputs& in, const DistanceOptions& options,
                        const Progress& progress) {
  if (in.points == PointCloud::none) return measure_surface_distance(in.a, in.b, options, progress);
  const bool is_a = in.points == PointCloud::a;
  return measure_point_distance(is_a ? in.a : in.b, is_a ? in.b : in.a, in.points, options,
                                progress);
}

int run(const Tool& tool, const MeshdistArguments& arguments) {
  const Inputs in = read_inputs(tool, arguments);
  DistanceOptions options = arguments.options;
  options.n_threads = tool.common().n_threads;
  Stopwatch watch;
  const SurfaceDistance distance = measure(in, options, tool.progress("block"));
  const double took_s = watch.lap_s();
  if (!arguments.color.empty())
    write_color(tool, arguments, in.a, distance,
                arguments.range.value_or(default_color_range(distance)), in.hashes);

  const std::string table_file = tool.common().output.empty() ? "-" : tool.common().output;
  if (!(tool.common().json_file == "-" && table_file == "-"))
    write_file(table_file, format_surface_distance(distance));
  tool.report(report_surface_distance(distance, options));
  const std::size_t n = distance.forward.n_all_samples() + distance.backward.n_all_samples();
  tool.say(format_fixed(1e-6 * static_cast<double>(n), 2, "") + " million samples in " +
           format_fixed(took_s, 2, "") + " s");
  const double most = distance.symmetric().max;
  if (!arguments.fail_above) return 0;
  const double allowed = parse_length(*arguments.fail_above).of(distance.bbox_diagonal);
  if (!(most > allowed)) return 0;
  std::fprintf(stderr, "meshdist: %s maximum %.6g is above %.6g\n",
               in.points == PointCloud::none ? "symmetric" : "forward", most, allowed);
  return kOverThreshold;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool(
      "meshdist",
      "Measures how far surface A is from B (forward) and B from A: maximum over vertices, edges "
      "and faces (Hausdorff distance), mean, RMS, percentiles over the area. Symmetric: the "
      "larger. One of them may be a point cloud, a file without faces: distances are then from its "
      "points alone.",
      "meshdist bunny.ply bunny-1000.ply --unit-cube --color error.ply --range 0:0.03\n"
      "  meshdist a.ply b.ply --fail-above 0.01 --json distance.json");
  viewcell::MeshdistArguments arguments;
  viewcell::declare_arguments(tool, arguments);
  return tool.main(
      argc, argv, [&] { viewcell::finish_arguments(arguments); },
      [&] { return viewcell::run(tool, arguments); });
}

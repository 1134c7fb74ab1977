// pmesh: progressive meshes, built under a choice of metrics, and meshes taken from them.
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/file.h"
#include "base/table.h"
#include "common/provenance.h"
#include "common/stopwatch.h"
#include "common/tool.h"
#include "mesh/io.h"
#include "pm/build.h"
#include "pm/pm_file.h"

namespace viewcell {
namespace {

constexpr int kOverThreshold = 5;

struct Arguments {
  std::string model, metric = "qem3", placement, error = "total", measure = "max", stop_at, pm;
  bool unweighted = false, mean = false, exact = false, no_texture = false;
  std::size_t n_faces = 0;
  BuildOptions build;
};

CLI::App& declare_build(CLI::App& app, Arguments& a) {
  CLI::App& build = *app.add_subcommand("build", "collapse a mesh and keep every step");
  build.add_option("MODEL", a.model, "mesh: OBJ, PLY, OFF, STL, glTF, 3DS")->required();
  build
      .add_option("--metric", a.metric,
                  "qem3: quadrics; qem5: of position and texture; aps: texture deviation; mapping: "
                  "cell by cell [Chen06]; lt: "
                  "Lindstrom-Turk, memoryless")
      ->capture_default_str();
  build.add_option("--placement", a.placement,
                   "half: a vertex goes to its neighbour; full: both to the best place (not "
                   "for aps; default: half, for lt full)");
  build
      .add_option("--error", a.error,
                  "aps, mapping: total, from the input, or incremental, from the step before")
      ->capture_default_str()
      ->check(CLI::IsMember({"total", "incremental"}));
  build
      .add_option("--measure", a.measure,
                  "mapping: max, of distances, or mean, of their squares over the surface")
      ->capture_default_str()
      ->check(CLI::IsMember({"max", "mean"}));
  build.add_option("--stop-at", a.stop_at,
                   "a whole number: faces; a number with a point: the metric's cost, in units of "
                   "the mesh (default: as far as it goes)");
  build.add_flag("--unweighted", a.unweighted,
                 "qem3, qem5: every plane counts alike, whatever its area");
  build.add_flag("--mean", a.mean, "qem3, qem5: the mean of squared distances, not their sum");
  build
      .add_option("--boundary-weight", a.build.qem.boundary_weight,
                  "qem3, qem5: of boundary planes")
      ->capture_default_str()
      ->check(within(0, 1e6));
  build
      .add_option("--texture-weight", a.build.texture_weight,
                  "qem5: of a length in the texture, once its area is scaled to the surface's")
      ->capture_default_str()
      ->check(within(0, 1e6));
  build
      .add_option("--bounded", a.build.error_bound,
                  "refuse what could bring a point farther than this from the other surface, in "
                  "units of the mesh")
      ->check(within(1e-30, 1e30));
  build.add_flag("--track-error", a.build.track_error,
                 "keep a bound of the distance for every level, under any metric (aps, mapping "
                 "and --bounded have it)");
  build.add_flag("--no-folds", a.build.refuse_folds,
                 "refuse what turns a triangle over in the texture (qem5, aps, mapping do)");
  build.add_flag("--no-texture", a.no_texture,
                 "leave texture coordinates out: charts then hold nothing back");
  build.add_flag("--exact", a.exact, "look at every changed cost at once, not when it comes up");
  return build;
}

void declare(Tool& tool, Arguments& a) {
  CLI::App& app = tool.app();
  app.require_subcommand(1);
  app.fallthrough();
  declare_build(app, a);
  CLI::App& extract = *app.add_subcommand("extract", "take a mesh of some size out of a .pm");
  extract.add_option("PM", a.pm, "progressive mesh")->required();
  extract.add_option("--faces", a.n_faces, "the finest level of at most so many faces")->required();
  CLI::App& info = *app.add_subcommand("info", "say what a .pm holds");
  info.add_option("PM", a.pm, "progressive mesh")->required();
  tool.add_output("file to write: .pm (build), .ply (extract); -: standard output", false);
}

void set_stop(const std::string& text, BuildOptions& build) {
  if (text.empty()) return;
  std::size_t used = 0;
  double value = 0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used != text.size() || !std::isfinite(value) || value <= 0)
    throw UsageError("--stop-at '" + text + "' is neither a number of faces nor a cost above 0");
  if (text.find_first_not_of("0123456789") == std::string::npos)
    build.target_faces = static_cast<std::size_t>(value);
  else
    build.max_cost = static_cast<float>(value);
}

Json format_options(const BuildOptions& b) {
  Json out{{"metric", metric_name(b.metric)},
           {"placement", placement_name(b.placement)},
           {"lazy", b.lazy},
           {"min_cosine", b.min_cosine}};
  if (b.target_faces > 1) out["target_faces"] = b.target_faces;
  if (std::isfinite(b.max_cost)) out["max_cost"] = b.max_cost;
  if (b.metric == MetricKind::aps || b.metric == MetricKind::mapping)
    out["error"] = b.total_error ? "total" : "incremental";
  if (b.metric == MetricKind::mapping) out["measure"] = b.measure == Measure::mean ? "mean" : "max";
  if (std::isfinite(b.error_bound)) out["error_bound"] = b.error_bound;
  if (b.track_error) out["track_error"] = true;
  if (b.refuse_folds) out["refuse_folds"] = true;
  if (b.metric == MetricKind::qem5) out["texture_weight"] = b.texture_weight;
  if (b.metric == MetricKind::qem3 || b.metric == MetricKind::qem5) {
    out["area_weighted"] = b.qem.area_weighted;
    out["mean"] = b.qem.mean;
    out["boundary_weight"] = b.qem.boundary_weight;
  }
  return out;
}

std::string format_refusals(const CollapseCounts& counts) {
  std::string out;
  for (int k = 1; k < kRefusalKinds; ++k)
    if (const std::size_t n = counts.n_refused[static_cast<std::size_t>(k)])
      out += (out.empty() ? "" : ", ") + std::to_string(n) + " by " +
             refusal_name(static_cast<Refusal>(k));
  return out.empty() ? "none" : out;
}

Json format_refused(const CollapseCounts& counts) {
  Json out = Json::object();
  for (int k = 1; k < kRefusalKinds; ++k)
    out[refusal_name(static_cast<Refusal>(k))] = counts.n_refused[static_cast<std::size_t>(k)];
  return out;
}

int build(const Tool& tool, Arguments& a) {
  if (tool.common().output.empty()) throw UsageError("build needs -o");
  BuildOptions& options = a.build;
  options.metric = parse_metric(a.metric);
  if (a.placement.empty()) a.placement = options.metric == MetricKind::lt ? "full" : "half";
  options.placement = parse_placement(a.placement);
  options.qem.area_weighted = !a.unweighted;
  options.qem.mean = a.mean;
  options.lazy = !a.exact;
  options.total_error = a.error == "total";
  options.measure = a.measure == "mean" ? Measure::mean : Measure::max;
  set_stop(a.stop_at, options);
  options.name = a.model;
  Stopwatch watch;
  TriMesh mesh = read_mesh(a.model);
  if (a.no_texture) mesh.texcoords.clear();
  const double read_s = watch.lap_s();
  BuildResult result = build_progressive_mesh(mesh, options, tool.progress("percent"));
  const double build_s = watch.lap_s();
  const std::size_t n_faces = result.record.faces.size();
  const std::size_t n_base = n_faces - result.record.born.size();
  Json said = format_options(options);
  if (a.no_texture) said["texture"] = false;
  result.record.made_by = make_provenance(tool, said, {{"model", hash_file(a.model)}}).dump();
  write_pm(tool.common().output, result.record);
  const CollapseCounts& counts = result.counts;
  const bool is_short =
      !a.stop_at.empty() && options.target_faces > 1 && n_base > options.target_faces;
  if (!is_short)
    tool.say(std::to_string(n_faces) + " -> " + std::to_string(n_base) + " faces, " +
             std::to_string(counts.n_collapses) +
             " collapses; refused: " + format_refusals(counts));
  tool.report({{"faces_in", n_faces},
               {"faces_base", n_base},
               {"collapses", counts.n_collapses},
               {"refused", format_refused(counts)},
               {"cost_evaluations", counts.n_costs},
               {"cost_max", counts.last_cost},
               {"vertices_welded", result.n_welded},
               {"faces_dropped", result.n_dropped},
               {"timing", {{"read_s", read_s}, {"build_s", build_s}}}});
  if (!is_short) return 0;
  std::fprintf(stderr, "pmesh: %zu faces were asked for, %zu remain; refused: %s\n",
               options.target_faces, n_base, format_refusals(counts).c_str());
  return kOverThreshold;
}

int extract(const Tool& tool, const Arguments& a) {
  if (tool.common().output.empty()) throw UsageError("extract needs -o");
  ProgressiveMesh mesh(read_pm(a.pm));
  mesh.set_level(mesh.n_splits());
  mesh.set_faces(a.n_faces);
  const TriMesh out = mesh.extract();
  write_ply(tool.common().output, out, {std::string("made by pmesh ") + version()});
  if (out.triangles.size() <= a.n_faces) tool.say(std::to_string(out.triangles.size()) + " faces");
  tool.report({{"faces", out.triangles.size()},
               {"vertices", out.positions.size()},
               {"cost", mesh.cost()},
               {"error_bound", mesh.error() < 0 ? Json() : Json(mesh.error())}});
  if (out.triangles.size() <= a.n_faces) return 0;
  std::fprintf(stderr, "pmesh: %s: %zu faces were asked for, its base has %zu\n", a.pm.c_str(),
               a.n_faces, mesh.n_base_faces());
  return kOverThreshold;
}

int info(const Tool& tool, const Arguments& a) {
  const ProgressiveRecord record = read_pm(a.pm);
  const Json made_by = record.made_by.empty() ? Json() : Json::parse(record.made_by);
  const Json report{{"faces", record.faces.size()},
                    {"faces_base", record.faces.size() - record.born.size()},
                    {"vertices", record.attributes.positions.size()},
                    {"wedges", record.attributes.positions.size() + record.extra_sources.size()},
                    {"splits", record.splits.size()},
                    {"placement", record.is_full_edge() ? "full" : "half"},
                    {"texture_coordinates", !record.texcoords.empty()},
                    {"made_by", made_by}};
  if (tool.common().json_file != "-") write_file("-", format_json(report));
  tool.report(report);
  return 0;
}

}  // namespace
}  // namespace viewcell

int main(int argc, char** argv) {
  viewcell::Tool tool("pmesh",
                      "Builds progressive meshes (a base mesh and the vertex splits back to the "
                      "input), and takes meshes of any size out of them.",
                      "pmesh build bunny.ply --metric lt -o bunny.pm\n"
                      "  pmesh extract bunny.pm --faces 1000 -o bunny-1000.ply\n"
                      "  pmesh info bunny.pm");
  viewcell::Arguments arguments;
  viewcell::declare(tool, arguments);
  return tool.main(argc, argv, [&] {
    if (tool.app().got_subcommand("build")) return viewcell::build(tool, arguments);
    if (tool.app().got_subcommand("extract")) return viewcell::extract(tool, arguments);
    return viewcell::info(tool, arguments);
  });
}

// pmesh: progressive meshes, built under a choice of metrics, and meshes taken from them.
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/file.h"
#include "common/provenance.h"
#include "common/stopwatch.h"
#include "common/tool.h"
#include "mesh/io.h"
#include "pm/build.h"
#include "pm/pm_file.h"
#include "pmesh/arguments.h"

namespace viewcell {
namespace {

constexpr int kOverThreshold = 5;

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
  if (b.charts_apart_px > 0) out["charts_apart_px"] = b.charts_apart_px;
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

// What helps where charts hold collapses back.
const char* advise(const PmeshArguments& a, const CollapseCounts& counts) {
  const bool can_leave_out =
      !needs_texture(a.build.metric) ||
      (a.build.metric == MetricKind::mapping && a.build.placement == Placement::full);
  const bool by_chart = counts.n_refused[static_cast<std::size_t>(Refusal::chart)] > 0;
  return by_chart && can_leave_out ? "; --no-texture leaves charts out" : "";
}

int build(Tool& tool, PmeshArguments& a) {
  finish_build(tool, a);
  const BuildOptions& options = a.build;
  Stopwatch watch;
  std::string hash;
  TriMesh mesh = read_mesh(a.model, &hash);
  if (a.no_texture) mesh.texcoords.clear();
  const double read_s = watch.lap_s();
  BuildResult result = build_progressive_mesh(mesh, options, tool.progress("percent"));
  const double build_s = watch.lap_s();
  const std::size_t n_faces = result.record.faces.size();
  const std::size_t n_base = n_faces - result.record.born.size();
  Json said = format_options(options);
  if (a.no_texture) said["texture"] = false;
  result.record.made_by = make_provenance(tool, said, {{"model", hash}}).dump();
  write_pm(tool.common().output, result.record);
  const CollapseCounts& counts = result.counts;
  const bool is_short = a.stops_at_faces && n_base > options.target_faces;
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
  std::fprintf(stderr, "pmesh: %s: %zu faces were asked for, %zu remain; refused: %s%s\n",
               a.model.c_str(), options.target_faces, n_base, format_refusals(counts).c_str(),
               advise(a, counts));
  return kOverThreshold;
}

void write_mesh(const std::string& file, const TriMesh& mesh) {
  const std::vector<std::string> comments{std::string("made by pmesh ") + version()};
  const std::string ending = std::filesystem::path(file).extension();
  if (ending == ".obj" || ending == ".OBJ") return write_obj(file, mesh, {comments, "", ""});
  write_ply(file, mesh, comments);
}

void choose_level(const PmeshArguments& a, ProgressiveMesh& mesh) {
  if (!a.within)
    mesh.set_faces(*a.n_faces);
  else if (!mesh.set_error(*a.within))
    throw InputError(a.pm, "", "has no error bounds; pmesh build --track-error keeps them");
}

int extract(const Tool& tool, const PmeshArguments& a) {
  check_extract(tool, a);
  ProgressiveMesh mesh(read_pm(a.pm));
  // From the finest level on, as a program that draws goes.
  mesh.set_level(mesh.n_splits());
  Stopwatch watch;
  choose_level(a, mesh);
  const double level_s = watch.lap_s();
  const TriMesh out = mesh.extract();
  write_mesh(tool.common().output, out);
  const bool is_short = a.n_faces && out.triangles.size() > *a.n_faces;
  if (!is_short) tool.say(std::to_string(out.triangles.size()) + " faces");
  tool.report({{"faces", out.triangles.size()},
               {"vertices", out.positions.size()},
               {"cost", mesh.cost()},
               {"error_bound", mesh.error() < 0 ? Json() : Json(mesh.error())},
               {"timing", {{"level_s", level_s}}}});
  if (!is_short) return 0;
  std::fprintf(stderr, "pmesh: %s: %zu faces were asked for, its base has %zu\n", a.pm.c_str(),
               *a.n_faces, mesh.n_base_faces());
  return kOverThreshold;
}

Json base_error(const ProgressiveRecord& record) {
  if (record.splits.empty()) return 0;
  const float error = record.splits.front().error;
  return error < 0 ? Json() : Json(error);
}

int info(const Tool& tool, const PmeshArguments& a) {
  check_info(tool, a);
  const ProgressiveRecord record = read_pm(a.pm);
  const Json made_by = record.made_by.empty() ? Json() : Json::parse(record.made_by);
  const Json report{{"faces", record.faces.size()},
                    {"faces_base", record.faces.size() - record.born.size()},
                    {"vertices", record.attributes.positions.size()},
                    {"wedges", record.attributes.positions.size() + record.extra_sources.size()},
                    {"splits", record.splits.size()},
                    {"placement", record.is_full_edge() ? "full" : "half"},
                    {"texture_coordinates", !record.texcoords.empty()},
                    {"error_bound_base", base_error(record)},
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
                      "  pmesh build bunny.ply --bounded 0.01 -o near.pm\n"
                      "  pmesh extract near.pm --within 0.001 -o near.obj\n"
                      "  pmesh info bunny.pm");
  viewcell::PmeshArguments arguments;
  viewcell::declare_arguments(tool, arguments);
  return tool.main(argc, argv, [&] {
    if (tool.app().got_subcommand("build")) return viewcell::build(tool, arguments);
    if (tool.app().got_subcommand("extract")) return viewcell::extract(tool, arguments);
    return viewcell::info(tool, arguments);
  });
}

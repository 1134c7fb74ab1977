#include "pm/build.h"

#include <cmath>
#include <cstdio>
#include <numeric>

#include "base/large_vector.h"
#include "common/mesh_input.h"
#include "common/provenance.h"
#include "common/stopwatch.h"
#include "mesh/backs.h"
#include "mesh/used_vertices.h"
#include "pm/pm_file.h"
#include "pmesh/commands.h"

namespace viewcell {
namespace {

// Fewer hold nobody back.
constexpr std::size_t kMostSmallPieces = 16;

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
  if (b.weld_tolerance) out["weld_tolerance"] = *b.weld_tolerance;
  if (std::isfinite(b.error_bound)) out["error_bound"] = b.error_bound;
  if (b.lock_borders) out["lock_borders"] = true;
  if (b.ignore_materials) out["ignore_materials"] = true;
  if (b.ignore_colours) out["ignore_colours"] = true;
  if (b.keep_pieces) out["keep_pieces"] = true;
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
std::string advise(const PmeshArguments& a, const BuildResult& result) {
  if (result.counts.n_refused[static_cast<std::size_t>(Refusal::chart)] == 0) return "";
  std::string out;
  if (!result.record.texcoords.empty() && !texture_needs(a.build).coordinates)
    out += "; --no-texture leaves charts out";
  if (result.n_region_edges > 0) out += "; --ignore materials,colours leaves their borders out";
  return out;
}

// Lengths that are shares of the mesh.
BuildOptions set_lengths(const PmeshArguments& a, const TriMesh& mesh) {
  BuildOptions options = a.build;
  const double diagonal = glm::length(surface_box(mesh).size());
  if (a.bounded) options.error_bound = static_cast<float>(parse_length(*a.bounded).of(diagonal));
  if (a.weld) options.weld_tolerance = parse_length(*a.weld).of(diagonal);
  return options;
}

std::size_t count_faces_without_texture(const TriMesh& mesh) {
  std::size_t n = 0;
  for (std::size_t c = 0; c + 2 < mesh.texcoords.size(); c += 3) {
    const glm::dvec2 a(mesh.texcoords[c]), ab = glm::dvec2(mesh.texcoords[c + 1]) - a,
                                           ac = glm::dvec2(mesh.texcoords[c + 2]) - a;
    n += ab.x * ac.y == ab.y * ac.x;
  }
  return n;
}

// What was done to the mesh, or holds it back, without being asked for.
Remarks remark_on(const TriMesh& mesh, const BuildOptions& options, const BuildResult& result) {
  Remarks out;
  if (options.metric == MetricKind::aps)
    add_remark(&out,
               "faces without area in the texture, by which metric aps measures: they stay, and "
               "others go in their place (--metric mapping measures them)",
               count_faces_without_texture(mesh));
  add_remark(&out, kBacksRecut, result.n_recut);
  char text[160];
  std::snprintf(text, sizeof text,
                "vertices welded to others up to %.3g away (--weld 0 leaves them apart)",
                result.welded_apart.gap);
  add_remark(&out, text, result.welded_apart.n_welded);
  add_remark(
      &out,
      "pieces, which edges and vertices do not join to others, vanish whole where that costs "
      "less than a collapse (--keep-pieces keeps them)",
      result.counts.n_vanished);
  const std::size_t by_chart = result.counts.n_refused[static_cast<std::size_t>(Refusal::chart)];
  const std::size_t n_refused = std::accumulate(result.counts.n_refused.begin(),
                                                result.counts.n_refused.end(), std::size_t{0});
  if (result.record.texcoords.empty() && 2 * by_chart > n_refused)
    add_remark(&out,
               "edges where materials or colours meet hold collapses back (--ignore "
               "materials,colours lets go of them)",
               result.n_region_edges);
  const PieceCounts& pieces = result.pieces;
  if (pieces.n_small >= kMostSmallPieces && 2 * pieces.n_in_small > result.record.faces.size())
    add_remark(&out,
               "pieces of at most four faces, which edges and vertices do not join, hold collapses "
               "back (--weld joins what is nearly at one place)",
               pieces.n_small);
  return out;
}

// Charts are to blame where they are the reason of most refusals, or hardly more faces are left
// than charts (a metric that measures within charts refuses nothing: it has no cost).
void remark_charts(const Tool& tool, const PmeshArguments& a, const TriMesh& mesh,
                   const BuildResult& result, std::size_t n_base) {
  constexpr std::size_t kMuch = 10;     // a tenth of the faces is left
  constexpr std::size_t kFewFaces = 4;  // a chart
  constexpr std::size_t kHundreds = 200;
  if (mesh.texcoords.empty() || n_base <= a.build.target_faces || std::isfinite(a.build.max_cost) ||
      a.bounded)
    return;
  const std::size_t n_charts = result.n_charts;
  if (n_base * kMuch <= mesh.triangles.size() && n_charts < kHundreds) return;
  const auto& n_refused = result.counts.n_refused;
  const std::size_t by_chart = n_refused[static_cast<std::size_t>(Refusal::chart)];
  const std::size_t all = std::accumulate(n_refused.begin() + 1, n_refused.end(), std::size_t{0});
  if (n_charts < 2 || (2 * by_chart <= all && n_base > kFewFaces * n_charts)) return;
  const char* how =
      texture_needs(a.build).coordinates ? "--metric qem3 --no-texture" : "--no-texture";
  tool.remark(
      a.model,
      {{std::string("charts of its texture, whose borders hold collapses back: ") + how +
            " goes on across them, and, of one picture, texadapt TEXTURED.pm --engine rebake "
            "--onto makes a texture for what pmesh extract takes out of that",
        n_charts}});
}

}  // namespace

int build(const Tool& tool, const PmeshArguments& a) {
  keep_freed_memory();
  Stopwatch watch;
  std::string hash;
  TriMesh mesh = read_mesh_input(tool, a.model, &hash);
  if (a.no_texture) mesh.texcoords.clear();
  if (a.flip_v)
    for (glm::vec2& uv : mesh.texcoords) uv.y = 1 - uv.y;
  const BuildOptions options = set_lengths(a, mesh);
  const double read_s = watch.lap_s();
  BuildResult result = build_progressive_mesh(mesh, options, tool.progress("percent"));
  const double build_s = watch.lap_s();
  const std::size_t n_faces = result.record.faces.size();
  const std::size_t n_base = n_faces - result.record.born.size();
  Json said = format_options(options);
  if (a.no_texture) said["texture"] = false;
  if (a.flip_v) said["flip_v"] = true;
  result.record.made_by = make_provenance(tool, said, {{"model", hash}}).dump();
  write_pm(tool.common().output, result.record);
  tool.remark(a.model, remark_on(mesh, options, result));
  const CollapseCounts& counts = result.counts;
  const bool is_short = a.stops_at_faces && n_base > options.target_faces;
  if (!is_short)
    tool.say(std::to_string(n_faces) + " -> " + std::to_string(n_base) + " faces, " +
             std::to_string(counts.n_collapses) +
             " collapses; refused: " + format_refusals(counts));
  remark_charts(tool, a, mesh, result, n_base);
  tool.report({{"faces_in", n_faces},
               {"faces_base", n_base},
               {"collapses", counts.n_collapses},
               {"refused", format_refused(counts)},
               {"cost_evaluations", counts.n_costs},
               {"cost_max", counts.last_cost},
               {"vertices_welded", result.n_welded},
               {"vertices_welded_apart", result.welded_apart.n_welded},
               {"weld_tolerance", result.weld_tolerance},
               {"pieces", result.pieces.n},
               {"pieces_small", result.pieces.n_small},
               {"pieces_vanished", counts.n_vanished},
               {"vertices_locked", result.n_locked},
               {"region_edges", result.n_region_edges},
               {"faces_dropped", result.n_dropped},
               {"timing", {{"read_s", read_s}, {"build_s", build_s}}}});
  if (!is_short) return 0;
  std::fprintf(stderr, "pmesh: %s: %zu faces were asked for, %zu remain; refused: %s%s\n",
               a.model.c_str(), options.target_faces, n_base, format_refusals(counts).c_str(),
               advise(a, result).c_str());
  return kOverThreshold;
}

}  // namespace viewcell

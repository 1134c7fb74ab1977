#include "pmesh/arguments.h"

#include <charconv>
#include <cmath>

#include "base/error.h"
#include "formats/mesh_file.h"

namespace viewcell {
namespace {

constexpr std::uint64_t kMostFaces = 4'000'000'000;

void declare_build(Tool& tool, PmeshArguments& a) {
  Command& build = tool.add_command("build", "collapse a mesh and keep every step");
  build.add_option("MODEL", &a.model, "mesh: OBJ, PLY, OFF, STL, glTF, 3DS")
      .required()
      .reads("the mesh that is read");
  tool.add_mesh_limit(build);
  build
      .add_option("--metric", &a.metric,
                  "qem3: quadrics; qem5: of position and texture; aps: texture deviation; mapping: "
                  "cell by cell [Chen06]; lt: "
                  "Lindstrom-Turk, memoryless")
      .show_default();
  build.add_option("--placement", &a.placement,
                   "half: a vertex goes to its neighbour; full: both to the best place (not "
                   "for aps; default: half, for lt full)");
  build
      .add_option("--error", &a.error,
                  "aps, mapping: total, from the input, or incremental, from the step before")
      .show_default()
      .check(one_of({"total", "incremental"}));
  build
      .add_option("--measure", &a.measure,
                  "mapping: max, of distances, or mean, of their squares over the surface")
      .show_default()
      .check(one_of({"max", "mean"}));
  build.add_option("--stop-at", &a.stop_at,
                   "a whole number: faces; a number with a point (0.5, 1.e-3): the metric's cost, "
                   "in units of the mesh. A bound of the distance for aps, and for mapping with "
                   "--error total and --measure max; for others it is none: see --bounded "
                   "(default: as far as it goes)");
  build.add_flag("--unweighted", &a.unweighted,
                 "qem3, qem5: every plane counts alike, whatever its area");
  build.add_flag("--mean", &a.mean, "qem3, qem5: the mean of squared distances, not their sum");
  build
      .add_option("--boundary-weight", &a.build.qem.boundary_weight,
                  "qem3, qem5: of boundary planes")
      .show_default()
      .check(within(0, 1e6));
  build
      .add_option("--texture-weight", &a.build.texture_weight,
                  "qem5: of a length in the texture, once its area is scaled to the surface's")
      .show_default()
      .check(within(0, 1e6));
  build
      .add_option("--bounded", &a.bounded,
                  "refuse what could bring a point farther than this from the other surface, in "
                  "units of the mesh, or 0.1%: of its box's diagonal")
      .check(length_within(1e-30, 1e30));
  build
      .add_option("--weld", &a.weld,
                  "vertices on borders up to so far apart are one, in units of the mesh or %; 0: "
                  "at equal positions only (default: 0.001%, but a quarter of the shortest edge "
                  "there at most)")
      .check(length_within(0, 1e30));
  build.add_flag(
      "--lock-borders", &a.build.lock_borders,
      "vertices on borders neither move nor vanish, so that neighbouring tiles still fit");
  build.add_flag("--keep-pieces", &a.build.keep_pieces,
                 "no piece (a part that neither edges nor vertices join to others) vanishes; "
                 "otherwise one does when no collapse costs less than its radius, all but the "
                 "largest");
  build.add_flag("--track-error", &a.build.track_error,
                 "keep a bound of the distance for every level, under any metric (aps, mapping "
                 "and --bounded have it)");
  build.add_flag("--no-folds", &a.build.refuse_folds,
                 "refuse what turns a triangle over in the texture (qem5, aps, mapping do)");
  build
      .add_option("--charts-apart", &a.build.charts_apart_px,
                  "for texadapt: texels a side of the texture on which no chart may grow over "
                  "another as borders are simplified; 0: do not look")
      .check(whole_within(0, 32768));
  build.add_flag("--flip-v", &a.flip_v,
                 "turn v upside down, for files in which it runs against their pictures");
  build.add_flag("--no-texture", &a.no_texture,
                 "leave texture coordinates out: charts then hold nothing back");
  build.add_option("--ignore", &a.ignored,
                   "materials, colours or both (materials,colours): where they meet is then no "
                   "border, and nothing is spent on them");
  build.add_flag("--exact", &a.exact, "look at every changed cost at once, not when it comes up");
}

[[noreturn]] void refuse_stop(const std::string& text) {
  throw UsageError("--stop-at '" + text +
                   "' is neither a whole number of faces from 1 (500) nor a cost above 0 with a "
                   "point (0.5, 1.e-3)");
}

// Digits alone are faces; what has a point, and perhaps an exponent, is a cost.
void set_stop(const std::string& text, PmeshArguments& a) {
  if (text.find_first_not_of("0123456789") == std::string::npos) {
    if (!parse_whole(text, 1, kMostFaces, a.build.target_faces)) refuse_stop(text);
    a.stops_at_faces = true;
    return;
  }
  const std::size_t exponent = text.find_first_of("eE");
  const char* end = text.data() + text.size();
  float& cost = a.build.max_cost;
  if (text.find_first_not_of("0123456789.") < exponent ||
      text.substr(0, exponent).find('.') == std::string::npos ||
      std::from_chars(text.data(), end, cost) != std::from_chars_result{end, std::errc()} ||
      !std::isfinite(cost) || !(cost > 0))
    refuse_stop(text);
}

void set_ignored(const std::string& text, BuildOptions& options) {
  for (std::size_t first = 0, end = 0; end != std::string::npos; first = end + 1) {
    end = text.find(',', first);
    const std::string word = text.substr(first, end == std::string::npos ? end : end - first);
    if (word == "materials")
      options.ignore_materials = true;
    else if (word == "colours" || word == "colors")
      options.ignore_colours = true;
    else
      throw UsageError("--ignore '" + text + "': '" + word +
                       "' is neither materials nor colours (materials,colours for both)");
  }
}

// Options that do nothing under the metric chosen were meant for another.
void check_metric_options(const Command& build, const PmeshArguments& a) {
  const auto only = [&](const char* option, bool fits, const char* metrics) {
    if (build.is_given(option) && !fits)
      throw UsageError(std::string(option) + " does nothing under --metric " + a.metric +
                       ": it is for " + metrics);
  };
  const MetricKind metric = a.build.metric;
  const bool is_quadric = metric == MetricKind::qem3 || metric == MetricKind::qem5;
  only("--error", metric == MetricKind::aps || metric == MetricKind::mapping, "aps and mapping");
  only("--measure", metric == MetricKind::mapping, "mapping");
  for (const char* option : {"--unweighted", "--mean", "--boundary-weight"})
    only(option, is_quadric, "qem3 and qem5");
  only("--texture-weight", metric == MetricKind::qem5, "qem5");
}

void check_texture_options(const PmeshArguments& a) {
  if (!a.no_texture) return;
  if (a.build.charts_apart_px > 0)
    throw UsageError("--charts-apart looks at the texture that --no-texture leaves out");
  if (a.build.refuse_folds)
    throw UsageError("--no-folds looks at the texture that --no-texture leaves out");
  if (texture_needs(a.build).coordinates)
    throw UsageError("--metric " + a.metric +
                     " needs the texture coordinates that --no-texture leaves out" +
                     (a.build.metric == MetricKind::mapping ? "; --placement full does not" : ""));
}

void finish_build(const Tool& tool, PmeshArguments& a) {
  const CommonOptions& common = tool.common();
  if (common.output.empty()) throw UsageError("build needs -o");
  BuildOptions& options = a.build;
  options.metric = parse_metric(a.metric);
  if (a.placement.empty()) a.placement = options.metric == MetricKind::lt ? "full" : "half";
  options.placement = parse_placement(a.placement);
  options.qem.area_weighted = !a.unweighted;
  options.qem.mean = a.mean;
  options.lazy = !a.exact;
  options.total_error = a.error == "total";
  options.measure = a.measure == "mean" ? Measure::mean : Measure::max;
  if (a.stop_at) set_stop(*a.stop_at, a);
  if (a.ignored) set_ignored(*a.ignored, options);
  options.name = a.model;
  check_metric_options(tool.command("build"), a);
  check_texture_options(a);
  check_ending({"-o", common.output}, {".pm"}, "a progressive mesh");
}

void check_extract(const Tool& tool, const PmeshArguments& a) {
  const CommonOptions& common = tool.common();
  if (common.output.empty()) throw UsageError("extract needs -o");
  if (!a.n_faces && !a.within) throw UsageError("extract needs --faces or --within");
  check_ending({"-o", common.output}, kWrittenEndings, "a mesh");
}

}  // namespace

void declare_arguments(Tool& tool, PmeshArguments& a) {
  declare_build(tool, a);
  Command& extract = tool.add_command("extract", "take a mesh of some size out of a .pm");
  const std::string pm = "the progressive mesh that is read";
  extract.add_option("PM", &a.pm, "progressive mesh").required().reads(pm);
  extract.add_option("--faces", &a.n_faces, "the finest level of at most so many faces")
      .check(whole_within(1, kMostFaces));
  extract
      .add_option("--within", &a.within,
                  "the coarsest level that is surely no farther than this from the input, in units "
                  "of the mesh, or 0.1%: of its box's diagonal; for a .pm with bounds (see build "
                  "--track-error)")
      .check(length_within(0, 1e30))
      .excludes("--faces");
  Command& info = tool.add_command("info", "say what a .pm holds");
  info.add_option("PM", &a.pm, "progressive mesh").required().reads(pm);
  tool.add_output(
      "file to write: .pm (build), .ply, .obj, .stl, .off or .glb (extract); -: standard "
      "output, a PLY of extract",
      false);
}

void finish_arguments(const Tool& tool, PmeshArguments& a) {
  if (tool.command("build").is_given()) finish_build(tool, a);
  if (tool.command("extract").is_given()) check_extract(tool, a);
  if (tool.command("info").is_given() && !tool.common().output.empty())
    throw UsageError("info writes to standard output; --json FILE writes it to a file, not -o");
}

}  // namespace viewcell

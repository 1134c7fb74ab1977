#include "pm/build.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "mesh/backs.h"
#include "pm/border_edges.h"
#include "pm/recorded_metric.h"
#include "pm/recorder.h"
#include "pm/vanish_map.h"
#include "pm/vanishing_pieces.h"
#include "pm/wedge_mesh.h"

namespace viewcell {
namespace {

constexpr std::array<const char*, 5> kMetricNames{"qem3", "qem5", "aps", "mapping", "lt"};
constexpr std::array<const char*, 2> kPlacementNames{"half", "full"};

template <typename Enum, std::size_t N>
Enum parse_name(const std::array<const char*, N>& names, const std::string& name,
                const char* what) {
  std::string all;
  for (std::size_t i = 0; i < N; ++i) {
    if (name == names[i]) return static_cast<Enum>(i);
    all += (i ? ", " : "") + std::string(names[i]);
  }
  throw UsageError("'" + name + "' is no " + what + "; there are " + all);
}

// The power of two that brings the box's longest side into [1, 2): with it float products neither
// vanish nor overflow, and no digit of a position is lost.
float unit_scale(std::span<const glm::vec3> positions) {
  Box box;
  for (const glm::vec3& p : positions) box.add(p);
  const glm::dvec3 size = box.size();
  const double longest = std::max({size.x, size.y, size.z});
  if (!(longest > 0)) return 1;
  return std::ldexp(1.0f, -std::clamp(std::ilogb(longest), -126, 126));
}

// Of lengths: as metrics see them and as the input has them.
struct Units {
  float scale = 1;  // positions are the input's times this
  float gap = 0;    // how far welding has moved vertices, in the input's units
  float in_metric(float length) const { return length * scale; }
  float in_input(float length) const { return length / scale; }
};

// What is made from the mesh before any metric: at its positions and faces, without copies.
struct Start {
  std::span<const glm::vec3> positions;
  std::span<const Triangle> triangles;
  const std::vector<bool>& locked;
  AttributeCost* attributes;  // or none
  VanishingPieces pieces;
};

// Runs the loop in slices, for the progress.
template <typename Metric>
CollapseCounts collapse_all(CollapseMesh& mesh, Metric& metric, Recorder& recorder,
                            CollapseBound* guard, ChartGuard* charts, Start& begin,
                            const Units& units, const BuildOptions& options,
                            const Progress& progress) {
  constexpr std::size_t kSlices = 100;
  constexpr std::size_t kTail = 4;  // what is left may be looked at again: a quarter
  RecordedMetric<Metric> recorded{mesh,
                                  metric,
                                  recorder,
                                  guard,
                                  units.in_metric(options.error_bound - units.gap),
                                  texture_needs(options).no_folds,
                                  charts,
                                  begin.locked,
                                  begin.attributes,
                                  begin.pieces,
                                  nullptr,
                                  units.in_metric(options.max_cost)};
  std::optional<VanishMapper> mapper;
  if (begin.pieces.cost() < std::numeric_limits<float>::infinity() && recorded.error() >= 0)
    recorded.mapper = &mapper.emplace(mesh, begin.positions, begin.triangles);
  CollapseLoop loop(mesh, recorded);
  const std::size_t start = mesh.n_triangles();
  const std::size_t span = start - std::min(start, std::max<std::size_t>(options.target_faces, 1));
  CollapseCounts total;
  const auto made = [&](std::uint32_t u, std::uint32_t v, float cost, const CollapseTrace& trace) {
    const float error = recorded.error();
    recorder.made(u, v, units.in_input(cost), error < 0 ? error : units.in_input(error) + units.gap,
                  trace);
  };
  const auto run_to = [&](std::size_t target) {
    const CollapseCounts counts = loop.run({.target_triangles = target,
                                            .max_cost = units.in_metric(options.max_cost),
                                            .min_cosine = options.min_cosine,
                                            .lazy = options.lazy},
                                           made);
    total.n_collapses += counts.n_collapses;
    total.n_vanished += counts.n_vanished;
    total.n_costs += counts.n_costs;
    total.n_visited = counts.n_visited;
    for (std::size_t i = 0; i < counts.n_refused.size(); ++i)
      total.n_refused[i] += counts.n_refused[i];
    total.last_cost = std::max(total.last_cost, units.in_input(counts.last_cost));
    return counts.n_collapses;
  };
  for (std::size_t slice = 1; slice <= kSlices; ++slice) {
    const std::size_t target = start - span * slice / kSlices;
    if (mesh.n_triangles() <= target && slice < kSlices) continue;
    run_to(target);
    if (progress) progress(slice, kSlices);
    if (mesh.n_triangles() > target) break;  // nothing more can go
  }
  const bool is_bounded = std::isfinite(options.max_cost) || std::isfinite(options.error_bound);
  if (is_bounded || mesh.n_triangles() > start / kTail) return total;
  // What was refused once may be legal by now; then vertices stay where they are, which turns over
  // fewer triangles.
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    for (const bool ends_only : {false, true}) {
      recorded.ends_only = ends_only;
      loop.choose_all();
      goes_on = (mesh.n_triangles() > start - span && run_to(start - span) > 0) || goes_on;
    }
  }
  return total;
}

// triangles: without copies.
CollapseCounts run_metric(CollapseMesh& mesh, WedgeMesh& wedges,
                          const std::vector<Triangle>& triangles, Recorder& recorder, Start& start,
                          const Units& units, const BuildOptions& options,
                          const Progress& progress) {
  std::span<glm::vec3> positions = wedges.positions;
  std::optional<CollapseBound> guard;
  if (options.track_error || std::isfinite(options.error_bound))
    guard.emplace(mesh, recorder.table(), positions, DeviationBoxes(triangles.size()));
  std::optional<ChartGuard> charts;
  if (options.charts_apart_px > 0 && !wedges.texcoords.empty())
    charts.emplace(wedges, options.charts_apart_px);
  const auto run = [&](auto&& metric) {
    return collapse_all(mesh, metric, recorder, guard ? &*guard : nullptr,
                        charts ? &*charts : nullptr, start, units, options, progress);
  };
  if (options.metric == MetricKind::mapping && options.placement == Placement::full) {
    if (options.measure == Measure::mean)
      return run(MappingFullMetric(mesh, recorder.table(), positions, recorder.texcoords(),
                                   DeviationMoments(positions, triangles), options.lt));
    return run(MappingFullMetric(mesh, recorder.table(), positions, recorder.texcoords(),
                                 DeviationBoxes(triangles.size()), options.lt));
  }
  if (options.metric == MetricKind::aps || options.metric == MetricKind::mapping)
    return run(MappingMetric(
        mesh, recorder.table(), positions, recorder.texcoords(), triangles,
        {.matching = options.metric == MetricKind::aps ? Matching::texture : Matching::nearest,
         .total = options.total_error,
         .measure = options.measure}));
  if (options.metric == MetricKind::qem5 && options.placement == Placement::full)
    return run(TextureQemFullMetric(mesh, wedges, recorder.table(), positions, triangles,
                                    recorder.texcoords(), {options.qem, options.texture_weight}));
  if (options.metric == MetricKind::qem5)
    return run(TextureQemMetric(mesh, wedges, recorder.table(), positions, triangles,
                                {options.qem, options.texture_weight}));
  if (options.metric == MetricKind::lt)
    return run(LindstromTurkMetric(mesh, positions, options.lt));
  if (options.placement == Placement::full)
    return run(QemFullMetric(positions, triangles, options.qem));
  return run(QemMetric(positions, triangles, options.qem));
}

// In the unit of the metric, see PieceCost.
PieceCost piece_cost(const BuildOptions& options) {
  const MetricKind metric = options.metric;
  if (metric == MetricKind::mapping && options.measure == Measure::mean) return PieceCost::area;
  if ((metric != MetricKind::qem3 && metric != MetricKind::qem5) || options.qem.mean)
    return PieceCost::radius;
  return options.qem.area_weighted ? PieceCost::area : PieceCost::planes;
}

PieceCounts count_pieces(const Charts& pieces) {
  std::vector<std::size_t> sizes(pieces.size(), 0);
  for (const std::uint32_t piece : pieces.of) ++sizes[piece];
  PieceCounts out{pieces.size()};
  for (const std::size_t n : sizes)
    if (n <= PieceCounts::kMostSmall) ++out.n_small, out.n_in_small += n;
  return out;
}

// What materials and colours cost beside the metric. Maps keep to borders by themselves.
AttributeCost make_attribute_cost(const WedgeMesh& wedges, const std::vector<Triangle>& triangles,
                                  const TriMesh& mesh, const BuildOptions& options) {
  const bool is_quadric = options.metric == MetricKind::qem3 || options.metric == MetricKind::qem5;
  AttributeCostOptions out;
  out.borders = is_quadric || options.metric == MetricKind::lt;
  out.colours = !options.ignore_colours;
  out.boundary_weight = options.qem.boundary_weight;
  out.fourth_root = !is_quadric && options.measure != Measure::mean;
  const bool matters = !wedges.region_vertex.empty() || (out.colours && !mesh.colors.empty());
  if (matters && !out.fourth_root)
    out.scale = make_quadric_scale(wedges.positions, triangles,
                                   {.area_weighted = true, .mean = is_quadric && options.qem.mean});
  return {wedges, wedges.positions, triangles, mesh.colors, out};
}

// triangles: with copies.
void find_pieces(const std::vector<Triangle>& triangles, const VanishOptions& vanish,
                 const BuildOptions& options, PieceCounts& counts, Start& start) {
  const Charts pieces = connect_charts(triangles, start.positions.size(), ChartLink::corner);
  counts = count_pieces(pieces);
  if (!options.keep_pieces && pieces.size() > 1)
    start.pieces = VanishingPieces(start.positions, triangles, pieces, vanish);
}

// Of coordinates near the end of floats.
void check_places(const ProgressiveRecord& record, const std::string& name) {
  for (const auto* places : {&record.attributes.positions, &record.parent_positions})
    for (const glm::vec3& p : *places)
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw InputError(name, "",
                         "coordinates are so large that collapses leave what floats hold");
}

WeldOptions weld_options(const TriMesh& mesh, const BuildOptions& options) {
  if (!options.weld_tolerance) return {.tolerance = default_weld_tolerance(mesh)};
  return {*options.weld_tolerance, std::numeric_limits<double>::infinity()};
}

// A float that is not below it.
float round_up(double x) {
  const auto out = static_cast<float>(x);
  return out < x ? std::nextafter(out, std::numeric_limits<float>::infinity()) : out;
}

// Sets recut to the mesh with its backs cut as its fronts are, where that is another.
std::size_t cut_backs(const TriMesh& mesh, const WedgeMesh& wedges, TriMesh& recut) {
  const std::size_t n = mesh.positions.size();
  if (!may_have_backs(wedges.faces.size(), n - wedges.n_welded)) return 0;
  recut = mesh;
  return cut_backs_alike(recut, std::span(wedges.wedge_vertex).first(n));
}

void check_options(const TriMesh& mesh, const BuildOptions& options) {
  if (options.charts_apart_px > 0 && mesh.texcoords.empty())
    throw InputError(options.name, "",
                     "has no texture coordinates, so no charts that could be kept apart");
  if (options.metric == MetricKind::lt && options.placement == Placement::half)
    throw UsageError("metric lt places vertices anew: it needs --placement full");
  const bool is_full = options.placement == Placement::full;
  if (options.metric == MetricKind::mapping && is_full && !options.total_error)
    throw UsageError("metric mapping with --placement full is --error total only");
  const std::string metric = std::string("metric ") + metric_name(options.metric);
  if (options.metric == MetricKind::aps && is_full)
    throw UsageError(metric + " is for half-edge collapses: it needs --placement half");
  if (texture_needs(options).coordinates && mesh.texcoords.empty())
    throw InputError(
        options.name, "",
        "has no texture coordinates, which " + metric + " needs; uvpatch makes some for a patch" +
            (options.metric == MetricKind::mapping ? ", and --placement full needs none" : ""));
}

}  // namespace

MetricKind parse_metric(const std::string& name) {
  return parse_name<MetricKind>(kMetricNames, name, "metric");
}
Placement parse_placement(const std::string& name) {
  return parse_name<Placement>(kPlacementNames, name, "placement");
}
const char* metric_name(MetricKind metric) {
  return kMetricNames[static_cast<std::size_t>(metric)];
}
const char* placement_name(Placement placement) {
  return kPlacementNames[static_cast<std::size_t>(placement)];
}

// Full-edge collapses under mapping match points by nearness on the surface, and keep to charts
// only where there are some.
TextureNeeds texture_needs(const BuildOptions& options) {
  const MetricKind metric = options.metric;
  const bool measures_texture =
      metric == MetricKind::qem5 || metric == MetricKind::aps || metric == MetricKind::mapping;
  const bool does_without = metric == MetricKind::mapping && options.placement == Placement::full;
  return {measures_texture && !does_without, measures_texture || options.refuse_folds};
}

BuildResult build_progressive_mesh(const TriMesh& input, const BuildOptions& options,
                                   const Progress& progress) {
  check_options(input, options);
  const WeldOptions weld = weld_options(input, options);
  const WedgeOptions wedge_options{.along_curve = true,
                                   .weld = weld,
                                   .materials = !options.ignore_materials,
                                   .colours = !options.ignore_colours};
  WedgeMesh wedges = make_wedges(input, wedge_options);
  TriMesh recut;
  const std::size_t n_recut = cut_backs(input, wedges, recut);
  if (n_recut > 0) wedges = make_wedges(recut, wedge_options);
  const TriMesh& mesh = n_recut > 0 ? recut : input;
  if (wedges.faces.empty())
    throw InputError(options.name, "", "has no triangle with three different corners");
  const Units units{unit_scale(wedges.positions), round_up(wedges.apart.gap)};
  for (glm::vec3& p : wedges.positions) p *= units.scale;
  std::vector<Triangle> triangles = wedges.vertex_triangles();
  const FaceCopies copies = find_face_copies(triangles, wedges.positions.size());
  CollapseMesh work(wedges.positions, triangles, copies);
  Recorder recorder(wedges, mesh, units.scale, options.placement == Placement::full);
  BuildResult result;
  result.n_recut = n_recut;
  const std::size_t n_vertices = wedges.positions.size();
  VanishOptions vanish{piece_cost(options), {}};
  const std::vector<Triangle> sheets = without_copies(triangles, copies);
  if (options.lock_borders) vanish.locked = find_border_vertices(sheets, n_vertices);
  AttributeCost attributes = make_attribute_cost(wedges, sheets, mesh, options);
  Start start{
      wedges.positions, sheets, vanish.locked, attributes.is_empty() ? nullptr : &attributes, {}};
  find_pieces(triangles, vanish, options, result.pieces, start);
  triangles = {};
  if (!wedges.texcoords.empty()) result.n_charts = find_joined_charts(wedges).size();
  result.n_region_edges = attributes.n_border_edges();
  result.n_locked =
      static_cast<std::size_t>(std::count(vanish.locked.begin(), vanish.locked.end(), true));
  result.counts = run_metric(work, wedges, sheets, recorder, start, units, options, progress);
  result.record = recorder.finish();
  check_places(result.record, options.name);
  result.n_welded = wedges.n_welded;
  result.n_dropped = wedges.n_dropped;
  result.weld_tolerance = weld.tolerance;
  result.welded_apart = wedges.apart;
  return result;
}

}  // namespace viewcell

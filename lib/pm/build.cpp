#include "pm/build.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/error.h"
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
float unit_scale(const std::vector<glm::vec3>& positions) {
  Box box;
  for (const glm::vec3& p : positions) box.add(p);
  const glm::dvec3 size = box.size();
  const double longest = std::max({size.x, size.y, size.z});
  if (!(longest > 0)) return 1;
  return std::ldexp(1.0f, -std::clamp(std::ilogb(longest), -126, 126));
}

// A collapse as it was made; its lists lie in the recorder's arrays, in the same order.
struct Made {
  VertexSplit split;
  std::size_t first_born, first_moved, first_pair;
};

// What the loop did, to be turned around.
class Recorder {
 public:
  // positions: scaled, and moved by the metric. input: as they were in the file.
  Recorder(const WedgeMesh& mesh, const std::vector<glm::vec3>& positions,
           const std::vector<glm::vec3>& input, float scale, bool is_full)
      : positions_(positions),
        input_(input),
        scale_(scale),
        has_moved_(is_full ? input.size() : 0, false),
        texcoords_(mesh.texcoords),
        table_(mesh),
        is_full_(is_full) {}

  bool match(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v) {
    return table_.match(mesh, u, v, is_full_);
  }
  // Before the parent moves.
  void traced(std::uint32_t, std::uint32_t v, const CollapseTrace& trace) {
    moved_from_.clear();
    for (const std::uint32_t c : trace.moved) moved_from_.push_back(table_.at(c));
    table_.apply(trace);
    matched_ = table_.pairs();
    if (is_full_) parent_positions_.push_back(positions_[v]);
  }
  // A position in the input's units, to the bit where it is the input's.
  glm::vec3 unscaled(std::uint32_t v, const glm::vec3& p) const {
    return has_moved_[v] ? p / scale_ : input_[v];
  }
  // After it.
  void made(std::uint32_t u, std::uint32_t v, float cost, float error, const CollapseTrace& trace) {
    const auto& pairs = matched_;
    made_.push_back({{u, v, size32(trace.died), size32(trace.moved), size32(pairs), cost, error},
                     born_.size(),
                     moved_.size(),
                     pairs_.size()});
    born_.insert(born_.end(), trace.died.begin(), trace.died.end());
    moved_.insert(moved_.end(), trace.moved.begin(), trace.moved.end());
    for (const std::uint32_t wedge : moved_from_) moved_by_.push_back(place_of(wedge));
    for (const auto& [from, to] : pairs) pairs_.push_back({from, to});
    if (is_full_) {
      parent_positions_.back() = unscaled(v, parent_positions_.back());
      has_moved_[v] = true;
    }
    if (is_full_ && !texcoords_.empty()) move_texcoords(u, v);
  }

  void finish(ProgressiveRecord& record);
  WedgeTable& table() { return table_; }
  const std::vector<glm::vec2>& texcoords() const { return texcoords_; }

 private:
  template <typename T>
  static std::uint32_t size32(const std::vector<T>& values) {
    return static_cast<std::uint32_t>(values.size());
  }
  std::uint8_t place_of(std::uint32_t wedge) const {
    const auto& pairs = matched_;
    const auto found = std::find_if(pairs.begin(), pairs.end(),
                                    [&](const auto& pair) { return pair.from == wedge; });
    const auto place = found - pairs.begin();
    VIEWCELL_CHECK(place < 256, place);
    return static_cast<std::uint8_t>(place);
  }
  // The parent's texture coordinates go as far towards the child's as its position did.
  void move_texcoords(std::uint32_t u, std::uint32_t v) {
    const glm::dvec3 from(parent_positions_.back() * scale_);
    const glm::dvec3 edge = glm::dvec3(positions_[u]) - from;
    const double length2 = glm::dot(edge, edge);
    const double along = glm::dot(glm::dvec3(positions_[v]) - from, edge);
    const double t = length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
    for (const auto& [child, parent] : matched_) {
      parent_texcoords_.push_back(texcoords_[parent]);
      texcoords_[parent] =
          glm::vec2(glm::mix(glm::dvec2(texcoords_[parent]), glm::dvec2(texcoords_[child]), t));
    }
  }

  const std::vector<glm::vec3>& positions_;
  const std::vector<glm::vec3>& input_;
  float scale_;
  std::vector<bool> has_moved_;
  std::vector<glm::vec2> texcoords_;
  WedgeTable table_;
  bool is_full_;
  std::vector<WedgeTable::Pair> matched_;  // of the last collapse
  std::vector<std::uint32_t> moved_from_;  // wedges of the last collapse's moved corners
  std::vector<Made> made_;
  std::vector<std::uint32_t> born_, moved_;
  std::vector<std::uint8_t> moved_by_;
  std::vector<ProgressiveRecord::WedgePair> pairs_;
  std::vector<glm::vec3> parent_positions_;
  std::vector<glm::vec2> parent_texcoords_;
};

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from, std::size_t first, std::size_t n) {
  const auto at = from.begin() + static_cast<std::ptrdiff_t>(first);
  to.insert(to.end(), at, at + static_cast<std::ptrdiff_t>(n));
}

// The collapses backwards are the splits.
void Recorder::finish(ProgressiveRecord& r) {
  r.texcoords = std::move(texcoords_);
  for (std::size_t i = made_.size(); i-- > 0;) {
    const Made& made = made_[i];
    r.splits.push_back(made.split);
    append(r.born, born_, made.first_born, made.split.n_born);
    append(r.moved, moved_, made.first_moved, made.split.n_moved);
    append(r.moved_by, moved_by_, made.first_moved, made.split.n_moved);
    append(r.pairs, pairs_, made.first_pair, made.split.n_pairs);
    if (!parent_texcoords_.empty())
      append(r.parent_texcoords, parent_texcoords_, made.first_pair, made.split.n_pairs);
    if (is_full_) r.parent_positions.push_back(parent_positions_[i]);
  }
}

// The metric asked for, held to the boundaries of texture charts, with every collapse recorded.
template <typename Metric>
struct Recorded {
  Metric& metric;
  Recorder& recorder;
  MappingMetric* guard;  // of the error bound, or none
  float error_bound;
  static constexpr int kReach = [] {
    if constexpr (requires { Metric::kReach; }) return Metric::kReach;
    return 1;
  }();

  float cost(std::uint32_t u, std::uint32_t v) { return metric.cost(u, v); }
  glm::vec3 place(std::uint32_t u, std::uint32_t v) requires requires(Metric m) { m.place(u, v); }
  { return metric.place(u, v); }
  Refusal allows(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v) {
    if (!recorder.match(mesh, u, v)) return Refusal::chart;
    const Refusal refusal = as_refusal(metric.allows(mesh, u, v));
    if (refusal != Refusal::none || !guard) return refusal;
    if (guard->allows(mesh, u, v) != Refusal::none) return Refusal::bound;
    return guard->next_reach() <= error_bound ? Refusal::none : Refusal::bound;
  }
  // A bound of the distance from the input so far.
  float error() const {
    if (guard) return guard->bound();
    if constexpr (requires { metric.bound(); }) return metric.bound();
    return -1;
  }
  void traced(std::uint32_t u, std::uint32_t v, const CollapseTrace& trace) {
    if constexpr (requires { metric.traced(u, v, trace); }) metric.traced(u, v, trace);
    recorder.traced(u, v, trace);
  }
  template <typename... Place>
  void collapsed(std::uint32_t u, std::uint32_t v, const Place&... place) {
    metric.collapsed(u, v, place...);
    if (guard) guard->collapsed(u, v);
  }
};

// Runs the loop in slices, for the progress.
template <typename Metric>
CollapseCounts collapse_all(CollapseMesh& mesh, Metric& metric, Recorder& recorder,
                            MappingMetric* guard, float scale, const BuildOptions& options,
                            const Progress& progress) {
  constexpr std::size_t kSlices = 100;
  Recorded<Metric> recorded{metric, recorder, guard, options.error_bound * scale};
  CollapseLoop loop(mesh, recorded);
  const std::size_t start = mesh.n_triangles();
  const std::size_t span = start - std::min(start, std::max<std::size_t>(options.target_faces, 1));
  CollapseCounts total;
  const auto made = [&](std::uint32_t u, std::uint32_t v, float cost, const CollapseTrace& trace) {
    const float error = recorded.error();
    recorder.made(u, v, cost / scale, error < 0 ? error : error / scale, trace);
  };
  for (std::size_t slice = 1; slice <= kSlices; ++slice) {
    const std::size_t target = start - span * slice / kSlices;
    if (mesh.n_triangles() <= target && slice < kSlices) continue;
    const CollapseCounts counts = loop.run({.target_triangles = target,
                                            .max_cost = options.max_cost * scale,
                                            .min_cosine = options.min_cosine,
                                            .lazy = options.lazy},
                                           made);
    total.n_collapses += counts.n_collapses;
    total.n_costs += counts.n_costs;
    for (std::size_t i = 0; i < counts.n_refused.size(); ++i)
      total.n_refused[i] += counts.n_refused[i];
    total.last_cost = std::max(total.last_cost, counts.last_cost / scale);
    if (progress) progress(slice, kSlices);
    if (mesh.n_triangles() > target) break;  // nothing more can go
  }
  return total;
}

CollapseCounts run_metric(CollapseMesh& mesh, WedgeMesh& wedges,
                          const std::vector<Triangle>& triangles, Recorder& recorder, float scale,
                          const BuildOptions& options, const Progress& progress) {
  std::vector<glm::vec3>& positions = wedges.positions;
  std::optional<MappingMetric> guard;
  if (std::isfinite(options.error_bound))
    guard.emplace(mesh, recorder.table(), positions, std::span<const glm::vec2>(), triangles);
  const auto run = [&](auto&& metric) {
    return collapse_all(mesh, metric, recorder, guard ? &*guard : nullptr, scale, options,
                        progress);
  };
  if (options.metric == MetricKind::aps || options.metric == MetricKind::mapping)
    return run(MappingMetric(
        mesh, recorder.table(), positions, recorder.texcoords(), triangles,
        {.matching = options.metric == MetricKind::aps ? Matching::texture : Matching::nearest,
         .total = options.total_error,
         .measure = options.measure}));
  if (options.metric == MetricKind::qem5)
    return run(TextureQemMetric(mesh, wedges, recorder.table(), positions,
                                {options.qem, options.texture_weight}));
  if (options.metric == MetricKind::lt)
    return run(LindstromTurkMetric(mesh, positions, options.lt));
  if (options.placement == Placement::full)
    return run(QemFullMetric(positions, triangles, options.qem));
  return run(QemMetric(positions, triangles, options.qem));
}

void check_options(const TriMesh& mesh, const BuildOptions& options) {
  if (options.metric == MetricKind::lt && options.placement == Placement::half)
    throw UsageError("metric lt places vertices anew: it needs --placement full");
  if (std::isfinite(options.error_bound) && options.placement == Placement::full)
    throw UsageError("an error bound is for half-edge collapses: it needs --placement half");
  if (!needs_texture(options.metric)) return;
  const std::string metric = std::string("metric ") + metric_name(options.metric);
  if (options.placement == Placement::full)
    throw UsageError(metric + " is for half-edge collapses: it needs --placement half");
  if (mesh.texcoords.empty())
    throw InputError(options.name, "",
                     "has no texture coordinates, which " + metric + " needs; uvpatch makes some");
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

bool needs_texture(MetricKind metric) {
  return metric == MetricKind::qem5 || metric == MetricKind::aps || metric == MetricKind::mapping;
}

BuildResult build_progressive_mesh(const TriMesh& mesh, const BuildOptions& options,
                                   const Progress& progress) {
  check_options(mesh, options);
  WedgeMesh wedges = make_wedges(mesh);
  const float scale = unit_scale(wedges.positions);
  for (glm::vec3& p : wedges.positions) p *= scale;
  const std::vector<Triangle> triangles = wedges.vertex_triangles();
  CollapseMesh work(wedges.positions, triangles);
  const bool is_full = options.placement == Placement::full;
  Recorder recorder(wedges, wedges.positions, mesh.positions, scale, is_full);
  BuildResult result;
  result.counts = run_metric(work, wedges, triangles, recorder, scale, options, progress);

  ProgressiveRecord& r = result.record;
  r.attributes = mesh;
  r.attributes.triangles.clear();
  r.attributes.texcoords.clear();
  if (is_full)
    for (std::uint32_t v = 0; v < wedges.positions.size(); ++v)
      r.attributes.positions[v] = recorder.unscaled(v, wedges.positions[v]);
  if (!mesh.materials.empty()) {
    r.attributes.materials.clear();
    for (const std::uint32_t t : wedges.face_source)
      r.attributes.materials.push_back(mesh.materials[t]);
  }
  r.vertex_of.assign(
      wedges.wedge_vertex.begin(),
      wedges.wedge_vertex.begin() + static_cast<std::ptrdiff_t>(mesh.positions.size()));
  r.extra_sources.assign(
      wedges.wedge_source.begin() + static_cast<std::ptrdiff_t>(mesh.positions.size()),
      wedges.wedge_source.end());
  for (std::uint32_t c = 0; c < 3 * wedges.faces.size(); c += 3)
    r.faces.push_back(
        {recorder.table().at(c), recorder.table().at(c + 1), recorder.table().at(c + 2)});
  recorder.finish(r);
  result.n_welded = wedges.n_welded;
  result.n_dropped = wedges.n_dropped;
  return result;
}

}  // namespace viewcell

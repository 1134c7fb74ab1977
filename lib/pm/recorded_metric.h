// A metric for the loop that builds progressive meshes.
#pragma once

#include <cmath>

#include "mesh/closest_on_segment.h"
#include "pm/collapse_look.h"
#include "pm/collapse_loop.h"
#include "pm/recorder.h"

namespace viewcell {

/// The metric asked for, held to the boundaries of texture charts and whatever else is asked of
/// collapses, with every one recorded. Keeps references.
template <typename Metric>
struct RecordedMetric {
  const CollapseMesh& mesh;
  Metric& metric;
  Recorder& recorder;
  CollapseBound* guard;  ///< for the error bound, or none
  float error_bound;
  bool refuse_folds;   ///< in the texture
  ChartGuard* charts;  ///< to keep them apart, or none
  /// Where an edge may go in a full-edge collapse: nowhere, to its end v (from inside a chart to
  /// its border, from a border to where borders meet), to a place on itself (along a border),
  /// anywhere.
  enum class Way { none, to_end, along, free };
  glm::vec3 last_place{0};
  Way last_way = Way::free;

  static constexpr bool kPlaces = requires(Metric m) { m.place(0u, 0u); };
  static constexpr int kReach = [] {
    if constexpr (requires { Metric::kReach; }) return Metric::kReach;
    return 1;
  }();

  float cost(std::uint32_t u, std::uint32_t v) {
    if constexpr (requires { metric.cost_at(u, v, last_place); })
      if (const Way way = find_way(u, v); way == Way::to_end || way == Way::along)
        return metric.cost_at(u, v, place(u, v));
    return metric.cost(u, v);
  }
  void fetch(std::uint32_t v) const requires requires(Metric m) { m.fetch(v); }
  { metric.fetch(v); }
  float cost_at_least(std::uint32_t u, std::uint32_t v) requires requires(Metric m) {
    m.cost_at_least(u, v);
  }
  { return metric.cost_at_least(u, v); }
  Way find_way(std::uint32_t u, std::uint32_t v) requires kPlaces {
    if (recorder.texcoords().empty()) return Way::free;
    if (!recorder.match(mesh, u, v)) return Way::none;
    if (!recorder.table().match_both(mesh, v)) return Way::to_end;
    return recorder.table().texture_pairs().size() < 2 ? Way::free : Way::along;
  }
  bool may_collapse(std::uint32_t u, std::uint32_t v) requires kPlaces {
    const Way way = find_way(u, v);
    return way == Way::to_end || (way != Way::none && u < v);
  }
  bool stays() const requires kPlaces { return last_way == Way::to_end; }
  /// Whatever the metric knows of charts.
  glm::vec3 place(std::uint32_t u, std::uint32_t v) requires kPlaces {
    last_way = find_way(u, v);
    if (last_way == Way::to_end) return last_place = mesh.position(v);
    last_place = metric.place(u, v);
    if (last_way != Way::along) return last_place;
    const glm::dvec3 a(mesh.position(u)), b(mesh.position(v));
    const double t = closest_on_segment(glm::dvec3(last_place), a, b);
    return last_place = glm::vec3(glm::mix(a, b, t));
  }
  Refusal allows(const CollapseMesh&, std::uint32_t u, std::uint32_t v) {
    if (!recorder.match(mesh, u, v)) return Refusal::chart;
    if constexpr (kPlaces)
      if (!stays()) recorder.table().match_both(mesh, v);
    if (kPlaces && is_astray(u, v)) return Refusal::metric;
    merge(u, v);
    if (refuse_folds && recorder.folds(mesh, u, v)) return Refusal::fold;
    if (charts && recorder.overlaps(mesh, u, v, *charts)) return Refusal::overlap;
    const Refusal refusal = metric_allows(u, v);
    if (refusal != Refusal::none || !guard) return refusal;
    const float reach = kPlaces ? guard->look(u, v, last_place) : guard->look(u, v);
    return reach <= error_bound ? Refusal::none : Refusal::bound;
  }
  /// Whether the place is off the box around both stars by more than a quarter of its diagonal:
  /// what is nearly flat or nearly balanced may be least far away from the surface.
  bool is_astray(std::uint32_t u, std::uint32_t v) const {
    Box box;
    for (const std::uint32_t w : {u, v})
      mesh.for_each_triangle(w, [&](std::uint32_t a, std::uint32_t b) {
        box.add(mesh.position(a)), box.add(mesh.position(b));
      });
    const glm::dvec3 off =
        glm::max(box.lo - glm::dvec3(last_place), glm::dvec3(last_place) - box.hi);
    return std::max({off.x, off.y, off.z}) > 0.25 * glm::length(box.size());
  }
  void merge(std::uint32_t u, std::uint32_t v) {
    if constexpr (requires { metric.texcoord(); })
      if (last_way == Way::free && metric.texcoord()) return recorder.merge(*metric.texcoord());
    if (kPlaces || refuse_folds || charts)
      recorder.merge(mesh, u, v, kPlaces ? last_place : glm::vec3(0));
  }
  Refusal metric_allows(std::uint32_t u, std::uint32_t v) {
    if constexpr (requires { metric.allows(mesh, u, v, last_place); })
      return as_refusal(metric.allows(mesh, u, v, last_place));
    else
      return as_refusal(metric.allows(mesh, u, v));
  }
  /// A bound of the distance from the input so far; below 0: not known.
  float error() const {
    float bound = -1;
    if constexpr (requires { metric.bound(); }) bound = metric.bound();
    if (guard) bound = guard->deviations().bound();
    return std::isfinite(bound) ? bound : -1;
  }
  void traced(std::uint32_t u, std::uint32_t v, const CollapseTrace& trace) {
    if constexpr (requires { metric.traced(u, v, trace); }) metric.traced(u, v, trace);
    recorder.traced(u, v, trace);
  }
  template <typename... Place>
  void collapsed(std::uint32_t u, std::uint32_t v, const Place&... place) {
    metric.collapsed(u, v, place...);
    if (guard) guard->take();
    if (charts) charts->take();
  }
};

}  // namespace viewcell

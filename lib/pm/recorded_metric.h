// A metric for the loop that builds progressive meshes.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "mesh/closest_on_segment.h"
#include "pm/attribute_cost.h"
#include "pm/collapse_loop.h"
#include "pm/collapse_trial.h"
#include "pm/recorder.h"
#include "pm/vanish_map.h"
#include "pm/vanishing_pieces.h"

namespace viewcell {

/// The metric asked for, restricted to collapses that keep to the boundaries of texture charts and
/// meet the other conditions; every collapse is recorded. Keeps references.
template <typename Metric>
struct RecordedMetric {
  const CollapseMesh& mesh;
  Metric& metric;
  Recorder& recorder;
  CollapseBound* guard;  ///< for the error bound, or none
  float error_bound;
  bool refuse_folds;                ///< in the texture
  ChartGuard* charts;               ///< to keep them apart, or none
  const std::vector<bool>& locked;  ///< vertices that neither move nor vanish; empty: none
  AttributeCost* attributes;        ///< of materials and colours, or none
  VanishingPieces& pieces;
  VanishMapper* mapper;  ///< of pieces that vanish, where there is a bound to keep; or none
  float cost_bound;      ///< of metrics whose costs are bounds
  /// Where an edge may go in a full-edge collapse: nowhere, to its end v (from inside a chart to
  /// its border, from a border to where borders meet, to what is locked or a hub), to a point on
  /// itself (along a border), anywhere.
  enum class Way { none, to_end, along, free };
  std::span<const std::uint32_t> live_faces = {};
  bool ends_only = false;  ///< full-edge collapses go to v
  glm::vec3 last_position{0};
  Way last_way = Way::free;

  static constexpr float kNever = std::numeric_limits<float>::infinity();
  static constexpr bool kHasPlacement = requires(Metric m) { m.optimal_position(0u, 0u); };
  static constexpr int kReach = [] {
    if constexpr (requires { Metric::kReach; }) return Metric::kReach;
    return 1;
  }();

  float cost(std::uint32_t u, std::uint32_t v) {
    const float cost = geometric_cost(u, v);
    if (!attributes || !std::isfinite(cost)) return cost;
    glm::vec3 position = mesh.position(v);
    if constexpr (kHasPlacement) position = optimal_position(u, v);
    if (attributes->has_colours() && !recorder.match(mesh, u, v)) return kNever;
    return std::hypot(cost, attributes->cost(recorder.table(), u, v, position));
  }
  float geometric_cost(std::uint32_t u, std::uint32_t v) {
    if constexpr (!kHasPlacement) {
      if (is_locked(u)) return kNever;
    } else {
      const Way way = find_way(u, v);
      if constexpr (requires { metric.cost_at(u, v, last_position); }) {
        if (way == Way::to_end || way == Way::along)
          return metric.cost_at(u, v, optimal_position(u, v));
      } else if (way == Way::to_end) {
        return metric.cost_at_end(u, v);
      }
    }
    return metric.cost(u, v);
  }
  bool is_locked(std::uint32_t v) const { return !locked.empty() && locked[v]; }
  /// Of full-edge collapses: where v is, or nowhere.
  bool must_stay(std::uint32_t v) const { return mesh.is_hub(v) || is_locked(v); }
  bool goes_to_end(std::uint32_t v) const { return ends_only || must_stay(v); }
  void fetch(std::uint32_t v) const requires requires(Metric m) { m.fetch(v); }
  { metric.fetch(v); }
  float cost_at_least(std::uint32_t u, std::uint32_t v) requires requires(Metric m) {
    m.cost_at_least(u, v);
  }
  { return metric.cost_at_least(u, v); }
  /// Where colours differ a free position may move their border, which an end does not: the
  /// cheapest of both ends and the free one is taken.
  Way find_way(std::uint32_t u, std::uint32_t v) requires kHasPlacement {
    const Way way = find_way_of_charts(u, v);
    if (way != Way::free || !attributes || !attributes->has_colours() ||
        !recorder.match(mesh, u, v) || !attributes->has_gradient(recorder.table(), u, v))
      return way;
    return u > v || is_end_better(u, v) ? Way::to_end : Way::free;
  }
  bool is_end_better(std::uint32_t u, std::uint32_t v) requires kHasPlacement {
    const auto total = [&](float cost, const glm::vec3& position) {
      return std::hypot(cost, attributes->cost(recorder.table(), u, v, position));
    };
    const glm::vec3 end = mesh.position(v), free = metric.optimal_position(u, v);
    const float free_cost = metric.cost(u, v);
    float end_cost = 0;
    if constexpr (requires { metric.cost_at(u, v, end); })
      end_cost = metric.cost_at(u, v, end);
    else
      end_cost = metric.cost_at_end(u, v);
    return !(total(free_cost, free) < total(end_cost, end));
  }
  Way find_way_of_charts(std::uint32_t u, std::uint32_t v) requires kHasPlacement {
    if (must_stay(u)) return Way::none;
    if (!recorder.table().has_charts()) return goes_to_end(v) ? Way::to_end : Way::free;
    if (!recorder.match(mesh, u, v)) return Way::none;
    if (goes_to_end(v) || !recorder.table().match_both(mesh, v)) return Way::to_end;
    return n_charts() < 2 ? Way::free : Way::along;
  }
  /// Of the last match: charts that hold both ends. Of two-sided sheets one side's, unless the
  /// metric looks at the texture.
  std::size_t n_charts() const {
    if constexpr (requires { metric.texcoord(); }) return recorder.table().chart_pairs().size();
    return recorder.table().n_sheet_pairs();
  }
  bool may_collapse(std::uint32_t u, std::uint32_t v) requires kHasPlacement {
    const Way way = find_way(u, v);
    return way == Way::to_end || (way != Way::none && u < v);
  }
  bool stays() const requires kHasPlacement { return last_way == Way::to_end; }
  /// The metric's, restricted to where charts let the edge go.
  glm::vec3 optimal_position(std::uint32_t u, std::uint32_t v) requires kHasPlacement {
    last_way = find_way(u, v);
    if (last_way == Way::to_end) return last_position = mesh.position(v);
    last_position = metric.optimal_position(u, v);
    if (last_way != Way::along) return last_position;
    const glm::dvec3 a(mesh.position(u)), b(mesh.position(v));
    const double t = closest_on_segment(glm::dvec3(last_position), a, b);
    return last_position = glm::vec3(glm::mix(a, b, t));
  }
  /// Pieces do not end by collapses.
  Refusal allows(const CollapseMesh&, std::uint32_t u, std::uint32_t v) {
    if (mesh.is_lone_triangle(u, v)) return Refusal::link;
    if (!recorder.match(mesh, u, v)) return Refusal::chart;
    recorder.table().choose_by_normals(mesh, v);
    if constexpr (kHasPlacement)
      if (!stays()) recorder.table().match_both(mesh, v);
    if constexpr (kHasPlacement)
      if (!stays() && is_far_from_stars(u, v)) return Refusal::metric;
    merge(u, v);
    const bool moves_both = kHasPlacement && !mesh.is_hub(v);
    if (refuse_folds && recorder.folds(mesh, u, v, moves_both)) return Refusal::fold;
    if (charts && recorder.overlaps(mesh, u, v, moves_both, *charts)) return Refusal::overlap;
    const Refusal refusal = metric_allows(u, v);
    if (refusal != Refusal::none) return refusal;
    if constexpr (requires { metric.vanished_reach(); })
      if (metric.vanished_reach() > cost_bound) return Refusal::bound;
    if (!guard) return Refusal::none;
    const float reach = kHasPlacement ? guard->measure(u, v, last_position) : guard->measure(u, v);
    return std::max(reach, guard->vanished_reach()) <= error_bound ? Refusal::none : Refusal::bound;
  }
  float vanish_cost() const { return pieces.cost(); }
  bool may_vanish(bool is_last) { return pieces.is_small(mesh, is_last); }
  std::span<const std::uint32_t> vanishing() const { return live_faces; }
  Refusal check_vanish() {
    const Refusal refusal = find_vanish_refusal();
    if (refusal != Refusal::none) pieces.pop();
    return refusal;
  }
  Refusal find_vanish_refusal() {
    live_faces = pieces.live_faces(mesh);
    if (live_faces.empty() || live_faces.size() == mesh.n_triangles()) return Refusal::link;
    if (!mapper) return Refusal::none;
    bool fits = mapper->build(pieces.faces(), live_faces);
    if constexpr (requires { metric.vanish_reach(mapper->map()); })
      fits = fits && metric.vanish_reach(mapper->map()) <= cost_bound;
    if (guard) fits = fits && guard->deviations().vanish_reach(mapper->map()) <= error_bound;
    if (fits) return Refusal::none;
    mapper->put_back(pieces.faces());
    return Refusal::bound;
  }
  /// Where costs are bounds the cost is how far the piece is off, if that is more.
  float vanished(std::uint32_t v, const CollapseTrace& trace) {
    float cost = pieces.cost();
    if (mapper) {
      if constexpr (requires { metric.vanish_reach(mapper->map()); }) {
        cost = std::max(cost, metric.vanish_reach(mapper->map()));
        metric.vanished(mapper->map());
      }
      if (guard) guard->accept(mapper->map());
    }
    recorder.traced(v, v, trace);
    pieces.pop();
    return cost;
  }
  /// Whether the position lies outside the box around both stars by more than a quarter of the
  /// box's diagonal: the objective of a nearly flat surface may have its minimum far from it.
  bool is_far_from_stars(std::uint32_t u, std::uint32_t v) const {
    Box box;
    for (const std::uint32_t w : {u, v})
      mesh.for_each_triangle(w, [&](std::uint32_t a, std::uint32_t b) {
        box.add(mesh.position(a)), box.add(mesh.position(b));
      });
    const glm::dvec3 off =
        glm::max(box.lo - glm::dvec3(last_position), glm::dvec3(last_position) - box.hi);
    return std::max({off.x, off.y, off.z}) > 0.25 * glm::length(box.size());
  }
  void merge(std::uint32_t u, std::uint32_t v) {
    if constexpr (requires { metric.texcoord(); })
      if (last_way == Way::free && metric.texcoord()) return recorder.merge(*metric.texcoord());
    if (kHasPlacement || refuse_folds || charts)
      recorder.merge(mesh, u, v, kHasPlacement ? last_position : glm::vec3(0));
  }
  Refusal metric_allows(std::uint32_t u, std::uint32_t v) {
    if constexpr (requires { metric.allows(mesh, u, v, last_position); })
      return as_refusal(metric.allows(mesh, u, v, last_position));
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
    if (attributes) attributes->merge(recorder.table(), u, v);
    recorder.traced(u, v, trace);
    if (mapper) mapper->traced(u, v, trace);
  }
  template <typename... Position>
  void collapsed(std::uint32_t u, std::uint32_t v, const Position&... position) {
    metric.collapsed(u, v, position...);
    if (guard) guard->accept();
    if (charts) charts->accept();
  }
};

}  // namespace viewcell

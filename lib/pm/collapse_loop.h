// The one collapse loop. What it minimises is a type of its own, the metric; see qem.h for one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/heap.h"
#include "pm/collapse_mesh.h"

namespace viewcell {

struct CollapseLimits {
  std::size_t target_triangles = 0;  ///< stop at or below this count; 0: no such stop
  float max_cost = std::numeric_limits<float>::infinity();  ///< stop when the cheapest costs more
  /// A triangle's normal may turn by up to acos of this in one collapse.
  float min_cosine = 0.2f;
  /// Costs that a collapse has changed are evaluated again only when they come to the top of the
  /// heap [Cohen et al. 1997]: fewer evaluations, an order that is nearly the same.
  bool lazy = false;
};

struct CollapseCounts {
  std::size_t n_collapses = 0;
  std::size_t n_vanished = 0;   ///< pieces
  std::size_t n_costs = 0;      ///< evaluations of the metric
  std::uint64_t n_visited = 0;  ///< triangles gone through around vertices, since the mesh was made
  std::array<std::size_t, kRefusalKinds> n_refused{};  ///< by Refusal
  float last_cost = 0;  ///< the highest cost of a collapse made, or of a piece that vanished
};

/// For metrics that say no more than yes or no.
inline Refusal as_refusal(bool allowed) {
  return allowed ? Refusal::none : Refusal::metric;
}
inline Refusal as_refusal(Refusal refusal) {
  return refusal;
}

/// What a metric has:
/// - float cost(u, v): of collapsing u into v, +infinity for never;
/// - float cost_at_least(u, v), if there is one: something cheaper that cost(u, v) is not below;
/// - bool or Refusal allows(mesh, u, v): a last check before the collapse is made;
/// - void fetch(v), if there is one: brings what cost() reads of v into the cache;
/// - void traced(u, v, trace), if there is one: called after the triangles have changed;
/// - void collapsed(u, v): called after the collapse.
/// For full-edge collapses:
/// - glm::vec3 optimal_position(u, v): where both go; it and the cost are the same for (u, v) and
///   (v, u);
/// - bool may_collapse(u, v), if there is one: whether u may be the vertex that is removed;
///   without it, the lower one is;
/// - bool stays(), if there is one: whether v must keep its position in the collapse of the last
///   optimal_position();
/// - float cost_at(u, v, position): of going to another place; where v is a hub and stays, it must
///   not look at all of its triangles. Not needed where cost() and stays() know of hubs;
/// - void collapsed(u, v, position): moves v.
/// Where pieces (parts that neither edges nor vertices join) may vanish whole, which they do as
/// soon as no collapse costs less:
/// - float vanish_cost(): of the next piece; infinity: there is none;
/// - bool may_vanish(is_last): whether it may go by now; is_last: no collapse is left;
/// - Refusal check_vanish(): a last check; what is refused is not next any more;
/// - std::span<const uint32_t> vanishing(): the triangles of the piece checked last;
/// - float vanished(v, trace): called after they are gone, v one of the vertices; returns the cost.
/// Metric::kReach (1 where there is none): 1 when a collapse u -> v changes costs of pairs with v
/// only; 2 when it changes those of every vertex around v.
///
/// Collapses in order of cost, one candidate a vertex (its cheapest legal target) in an indexed
/// heap [Chen06 4]. An illegal candidate is replaced by the vertex's next best, or parked until its
/// surroundings change; it does not end the loop (in the paper it does).
///
/// Hubs (kHubTriangles) stay as long as they are hubs: others collapse into them, at a cost that is
/// looked at again when it comes up, for what a collapse changes there is near its own star alone.
/// So the work is in proportion to the triangles that change, whatever stars they are in.
template <typename Metric>
class CollapseLoop {
 public:
  CollapseLoop(CollapseMesh& mesh, Metric& metric)
      : mesh_(mesh),
        metric_(metric),
        heap_(size32(mesh)),
        target_(mesh.n_vertices(), 0),
        n_stale_(mesh.n_vertices(), 0) {
    choose_all();
  }

  /// Looks at every vertex again, also those for which there was no legal target when they came up.
  void choose_all() {
    for (std::uint32_t u = 0; u < target_.size(); ++u) choose(u);
  }

  /// Goes on from where the last call stopped.
  CollapseCounts run(const CollapseLimits& limits) {
    return run(limits, [](std::uint32_t, std::uint32_t, float, const CollapseTrace&) {});
  }
  /// made(u, v, cost, trace) is called after each collapse; with u = v when a piece has vanished.
  template <typename Made>
  CollapseCounts run(const CollapseLimits& limits, Made&& made) {
    CollapseCounts counts;
    while (mesh_.n_triangles() > limits.target_triangles) {
      if (vanishes_next(limits.max_cost)) {
        vanish(counts, made);
        continue;
      }
      if (heap_.empty()) break;
      const std::uint32_t u = heap_.top(), v = target_[u];
      fetch_next();
      float cost = heap_.key(u);
      if (n_stale_[u] > 0 || has_risen(u, v, limits.max_cost, cost)) {
        choose(u);
        continue;
      }
      if (cost > limits.max_cost) break;
      const Refusal refusal = check(u, v, limits);
      if (refusal != Refusal::none) {
        ++counts.n_refused[static_cast<std::size_t>(refusal)];
        choose_legal(u, limits);
        continue;
      }
      counts.last_cost = std::max(counts.last_cost, cost);
      ++counts.n_collapses;
      make(u, v, limits.lazy);
      made(u, v, cost, trace_);
    }
    counts.n_costs = std::exchange(n_costs_, 0);
    counts.n_visited = mesh_.lists().n_visited();
    return counts;
  }

 private:
  static constexpr float kNever = std::numeric_limits<float>::infinity();
  struct Candidate {
    float cost;
    std::uint32_t v;
    bool is_exact;  // otherwise the cost is not below this
    // What is not exact comes first, so that nothing is taken before an equal cost is known.
    bool operator<(const Candidate& o) const {
      if (cost != o.cost) return cost < o.cost;
      return is_exact != o.is_exact ? o.is_exact : v < o.v;
    }
  };
  static constexpr bool kEstimates = requires(Metric m) { m.cost_at_least(0u, 0u); };
  static constexpr bool kHasPlacement = requires(Metric m) { m.optimal_position(0u, 0u); };
  static constexpr bool kVanishes = requires(Metric m) { m.vanish_cost(); };
  static constexpr int reach() {
    if constexpr (requires { Metric::kReach; }) return Metric::kReach;
    return 1;
  }
  static constexpr int kReach = reach();
  // A lazy key that is too high would never come up: costs into optimal positions fall, too, when
  // what is around them is gone, and are looked at again after kMostStale changes.
  static constexpr bool kFalls = kHasPlacement && kReach > 1;
  static constexpr std::uint8_t kMostStale = 8;

  static std::uint32_t size32(const CollapseMesh& mesh) {
    return static_cast<std::uint32_t>(mesh.n_vertices());
  }

  // Whether the cost is more than the heap has, and nobody has said so. Of a hub with each collapse
  // into it: a little more is let pass, or all others beside it would be looked at between any two.
  bool has_risen(std::uint32_t u, std::uint32_t v, float max_cost, float& cost) {
    constexpr float kLittle = 1.125f;
    if (!mesh_.is_hub(v)) return kReach > 1 && kHasPlacement && metric_cost(u, v) > cost;
    const float before = std::exchange(cost, metric_cost(u, v));
    return cost > kLittle * before || (cost > max_cost && before <= max_cost);
  }

  // A full-edge collapse is the same from both ends: the edge is a candidate of its lower one only,
  // unless that is a hub.
  bool is_candidate(std::uint32_t u, std::uint32_t v) {
    if constexpr (requires { metric_.may_collapse(u, v); }) return metric_.may_collapse(u, v);
    return !kHasPlacement || u < v || mesh_.is_hub(v);
  }

  float metric_cost(std::uint32_t u, std::uint32_t v) {
    ++n_costs_;
    const float cost = cost_of(u, v);
    return cost < kNever ? cost : kNever;  // NaN is never, too
  }
  float cost_of(std::uint32_t u, std::uint32_t v) {
    if constexpr (kHasPlacement && requires { metric_.cost_at(u, v, position_); })
      if (mesh_.is_hub(v)) return metric_.cost_at(u, v, mesh_.position(v));
    return metric_.cost(u, v);
  }

  bool vanishes_next(float max_cost) {
    if constexpr (kVanishes) {
      const float cost = metric_.vanish_cost();
      return cost < kNever && cost <= max_cost &&
             (heap_.empty() || cost <= heap_.key(heap_.top())) && metric_.may_vanish(heap_.empty());
    }
    return false;
  }

  template <typename Made>
  void vanish(CollapseCounts& counts, Made&& made) {
    if constexpr (kVanishes) {
      const Refusal refusal = metric_.check_vanish();
      if (refusal != Refusal::none) {
        ++counts.n_refused[static_cast<std::size_t>(refusal)];
        return;
      }
      mesh_.remove(metric_.vanishing(), trace_);
      for (const std::uint32_t t : trace_.died)
        for (std::uint32_t c = 3 * t; c < 3 * t + 3; ++c) heap_.erase(mesh_.vertex_at(c));
      const std::uint32_t v = mesh_.vertex_at(3 * trace_.died.front());
      const float cost = metric_.vanished(v, trace_);
      counts.last_cost = std::max(counts.last_cost, cost);
      ++counts.n_vanished;
      made(v, v, cost, trace_);
    }
  }

  // Sets position_; whether v keeps its own.
  bool place(std::uint32_t u, std::uint32_t v) {
    if constexpr (requires { metric_.stays(); }) {
      position_ = metric_.optimal_position(u, v);
      return metric_.stays();
    } else {
      const bool stays = mesh_.is_hub(v);
      position_ = stays ? mesh_.position(v) : metric_.optimal_position(u, v);
      return stays;
    }
  }

  Refusal check(std::uint32_t u, std::uint32_t v, const CollapseLimits& limits) {
    Refusal refusal;
    if constexpr (kHasPlacement) {
      refusal = place(u, v) ? mesh_.check(u, v, limits.min_cosine)
                            : mesh_.check(u, v, position_, limits.min_cosine);
    } else {
      refusal = mesh_.check(u, v, limits.min_cosine);
    }
    return refusal != Refusal::none ? refusal : as_refusal(metric_.allows(mesh_, u, v));
  }

  // Brings what the next collapses read into the cache while this one is made: each vertex goes
  // through the five stages one after another, and each stage has what the one before has fetched.
  void fetch_next() const {
    const auto [first, second, third, fourth, fifth] = heap_.next();
    if (fifth == IndexedHeap::kNone) return;
    const CornerLists& lists = mesh_.lists();
    lists.fetch_star(fifth);
    __builtin_prefetch(&target_[fifth]);
    lists.fetch(fourth);
    lists.fetch_star(target_[fourth]);
    mesh_.fetch_triangles(third);
    lists.fetch(target_[third]);
    if (!mesh_.is_hub(target_[second])) mesh_.fetch_triangles(target_[second]);
    if constexpr (requires { metric_.fetch(0u); }) {
      const auto fetch = [&](std::uint32_t a, std::uint32_t) { metric_.fetch(a); };
      mesh_.for_each_triangle(first, fetch);
      if (n_stale_[first] == 0 && !mesh_.is_hub(target_[first]))
        mesh_.for_each_triangle(target_[first], fetch);
    }
  }

  // The targets of u, with the least that each can cost.
  void gather_candidates(std::uint32_t u) {
    candidates_.clear();
    if (mesh_.is_hub(u)) return;
    mesh_.ring(u, ring_);
    for (const std::uint32_t v : ring_) {
      if (!is_candidate(u, v)) continue;
      if constexpr (kEstimates)
        candidates_.push_back({metric_.cost_at_least(u, v), v, false});
      else
        candidates_.push_back({metric_cost(u, v), v, true});
    }
  }

  // Takes the next cheapest candidate out; its cost is kNever when there is none. Costs are
  // evaluated as far as that needs.
  Candidate pop_candidate(std::uint32_t u) {
    while (!candidates_.empty()) {
      Candidate& least = *std::min_element(candidates_.begin(), candidates_.end());
      if (!least.is_exact && least.cost < kNever) {
        least = {metric_cost(u, least.v), least.v, true};
        continue;
      }
      const Candidate out = std::exchange(least, candidates_.back());
      candidates_.pop_back();
      return out;
    }
    return {kNever, 0, true};
  }

  // Puts u into the heap with its cheapest target, legal or not.
  void choose(std::uint32_t u) {
    n_stale_[u] = 0;
    gather_candidates(u);
    enter(u, pop_candidate(u));
  }

  // Puts u into the heap with its cheapest legal target; without one, takes it out.
  void choose_legal(std::uint32_t u, const CollapseLimits& limits) {
    gather_candidates(u);
    Candidate next = pop_candidate(u);
    while (next.cost < kNever && check(u, next.v, limits) != Refusal::none) next = pop_candidate(u);
    enter(u, next);
  }

  void enter(std::uint32_t u, const Candidate& candidate) {
    if (!(candidate.cost < kNever)) return heap_.erase(u);
    target_[u] = candidate.v;
    heap_.set(u, candidate.cost);
  }

  void make(std::uint32_t u, std::uint32_t v, bool lazy) {
    const bool into_hub = mesh_.is_hub(v);
    if (into_hub) mesh_.ring(u, around_);  // v stays, and the rest of its star is as it was
    mesh_.collapse(u, v, &trace_);
    if constexpr (requires { metric_.traced(u, v, trace_); }) metric_.traced(u, v, trace_);
    if constexpr (kHasPlacement)
      metric_.collapsed(u, v, position_);
    else
      metric_.collapsed(u, v);
    heap_.erase(u);
    choose(v);
    if (!into_hub) mesh_.ring(v, around_);
    for (const std::uint32_t w : around_) revise(w, u, v, lazy, into_hub || kReach > 1);
    for (const std::uint32_t hub : mesh_.lists().shrunk()) {
      choose(hub);
      mesh_.ring(hub, around_);
      for (const std::uint32_t w : around_) revise(w, u, v, lazy, true);
    }
  }

  // Costs of w have changed: all of them, or those towards u and v.
  void revise(std::uint32_t w, std::uint32_t u, std::uint32_t v, bool lazy, bool all) {
    if (lazy && heap_.contains(w) && may_wait(w))
      n_stale_[w] = kFalls ? static_cast<std::uint8_t>(n_stale_[w] + 1) : 1;
    else if (all)
      choose(w);
    else
      update(w, u, v);
  }

  bool may_wait(std::uint32_t w) const { return !kFalls || n_stale_[w] + 1 < kMostStale; }

  void update(std::uint32_t w, std::uint32_t u, std::uint32_t v) {
    if (!heap_.contains(w) || target_[w] == u || target_[w] == v) return choose(w);
    if (!is_candidate(w, v)) return;
    const float cost = metric_cost(w, v);
    if (cost < heap_.key(w) || (cost == heap_.key(w) && v < target_[w])) {
      target_[w] = v;
      heap_.set(w, cost);
    }
  }

  CollapseMesh& mesh_;
  Metric& metric_;
  IndexedHeap heap_;
  std::vector<std::uint32_t> target_;  // vertex -> the vertex that it would collapse into
  std::vector<std::uint8_t> n_stale_;  // changes that its key knows nothing of
  std::vector<std::uint32_t> ring_, around_;
  std::vector<Candidate> candidates_;
  CollapseTrace trace_;
  glm::vec3 position_{0};
  std::size_t n_costs_ = 0;
};

}  // namespace viewcell

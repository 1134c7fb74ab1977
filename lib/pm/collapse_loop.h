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
};

struct CollapseCounts {
  std::size_t n_collapses = 0;
  std::array<std::size_t, kRefusalKinds> n_refused{};  ///< by Refusal
  float last_cost = 0;  ///< the highest cost of a collapse that was made
};

/// Half-edge collapses in order of cost, one candidate a vertex (its cheapest legal target) in an
/// indexed heap [Chen06 4]. An illegal candidate is replaced by the vertex's next best, or parked
/// until its surroundings change; it does not end the loop (trap 14).
///
/// Metric: float cost(u, v): of collapsing u into v, +infinity for never;
///         bool allows(mesh, u, v): a last check before the collapse is made;
///         void collapsed(u, v): told after it; costs of pairs without u or v must not change.
template <typename Metric>
class CollapseLoop {
 public:
  CollapseLoop(CollapseMesh& mesh, Metric& metric)
      : mesh_(mesh), metric_(metric), heap_(size32(mesh)), target_(mesh.n_vertices(), 0) {
    for (std::uint32_t u = 0; u < target_.size(); ++u) choose(u);
  }

  /// Goes on from where the last call stopped.
  CollapseCounts run(const CollapseLimits& limits) {
    CollapseCounts counts;
    while (mesh_.n_triangles() > limits.target_triangles && !heap_.empty()) {
      const std::uint32_t u = heap_.top(), v = target_[u];
      if (heap_.key(u) > limits.max_cost) break;
      const Refusal refusal = check(u, v, limits);
      if (refusal != Refusal::none) {
        ++counts.n_refused[static_cast<std::size_t>(refusal)];
        choose_legal(u, limits);
        continue;
      }
      counts.last_cost = std::max(counts.last_cost, heap_.key(u));
      ++counts.n_collapses;
      make(u, v);
    }
    return counts;
  }

 private:
  static constexpr float kNever = std::numeric_limits<float>::infinity();
  static std::uint32_t size32(const CollapseMesh& mesh) {
    return static_cast<std::uint32_t>(mesh.n_vertices());
  }

  Refusal check(std::uint32_t u, std::uint32_t v, const CollapseLimits& limits) {
    const Refusal refusal = mesh_.check(u, v, limits.min_cosine);
    if (refusal != Refusal::none) return refusal;
    return metric_.allows(mesh_, u, v) ? Refusal::none : Refusal::metric;
  }

  // Puts u into the heap with its cheapest target, legal or not.
  void choose(std::uint32_t u) {
    float best = kNever;
    mesh_.ring(u, ring_);
    for (const std::uint32_t v : ring_) {
      const float cost = metric_.cost(u, v);
      if (cost < best || (cost == best && cost < kNever && v < target_[u])) {
        best = cost;
        target_[u] = v;
      }
    }
    best < kNever ? heap_.set(u, best) : heap_.erase(u);
  }

  // Puts u into the heap with its cheapest legal target; without one, takes it out.
  void choose_legal(std::uint32_t u, const CollapseLimits& limits) {
    mesh_.ring(u, ring_);
    sorted_.clear();
    for (const std::uint32_t v : ring_)
      if (const float cost = metric_.cost(u, v); cost < kNever) sorted_.emplace_back(cost, v);
    std::sort(sorted_.begin(), sorted_.end());
    for (const auto& [cost, v] : sorted_) {
      if (check(u, v, limits) != Refusal::none) continue;
      target_[u] = v;
      return heap_.set(u, cost);
    }
    heap_.erase(u);
  }

  void make(std::uint32_t u, std::uint32_t v) {
    mesh_.collapse(u, v);
    metric_.collapsed(u, v);
    heap_.erase(u);
    choose(v);
    mesh_.ring(v, around_);
    for (const std::uint32_t w : around_) update(w, u, v);
  }

  // After u -> v beside w: only w's costs towards u and v have changed.
  void update(std::uint32_t w, std::uint32_t u, std::uint32_t v) {
    if (!heap_.contains(w) || target_[w] == u || target_[w] == v) return choose(w);
    const float cost = metric_.cost(w, v);
    if (cost < heap_.key(w) || (cost == heap_.key(w) && v < target_[w])) {
      target_[w] = v;
      heap_.set(w, cost);
    }
  }

  CollapseMesh& mesh_;
  Metric& metric_;
  IndexedHeap heap_;
  std::vector<std::uint32_t> target_;  // vertex -> the vertex that it would collapse into
  std::vector<std::uint32_t> ring_, around_;
  std::vector<std::pair<float, std::uint32_t>> sorted_;
};

}  // namespace viewcell

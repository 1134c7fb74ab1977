#include "pm/border_edges.h"

#include <algorithm>
#include <utility>

namespace viewcell {

namespace {

// Calls visit(a, uses) for the triangles at each edge (a, b): pairs of b and a triangle, ascending.
template <typename Visit>
void for_each_edge_use(std::span<const Triangle> triangles, std::size_t n, Visit&& visit) {
  const auto for_each_edge = [&](auto&& add) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
        add(a, b, t);
      }
  };
  std::vector<std::uint32_t> first(n + 1, 0);  // of each lower end's edges
  for_each_edge([&](std::uint32_t a, std::uint32_t, std::uint32_t) { ++first[a + 1]; });
  for (std::size_t v = 0; v < n; ++v) first[v + 1] += first[v];
  std::vector<std::pair<std::uint32_t, std::uint32_t>> uses(3 * triangles.size());  // b, triangle
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for_each_edge([&](std::uint32_t a, std::uint32_t b, std::uint32_t t) {
    uses[next[a]++] = {b, t};
  });
  for (std::uint32_t a = 0; a < n; ++a) {
    std::sort(uses.begin() + first[a], uses.begin() + first[a + 1]);
    for (std::uint32_t i = first[a], j = i; i < first[a + 1]; i = j) {
      while (j < first[a + 1] && uses[j].first == uses[i].first) ++j;
      visit(a, std::span(uses).subspan(i, j - i));
    }
  }
}

}  // namespace

std::vector<BorderEdge> find_border_edges(std::span<const Triangle> triangles, std::size_t n) {
  std::vector<BorderEdge> border;
  for_each_edge_use(triangles, n, [&](std::uint32_t a, const auto& uses) {
    if (uses.size() == 1) border.push_back({a, uses[0].first, uses[0].second});
  });
  return border;
}

std::vector<BorderEdge> find_edges_between(
    std::span<const Triangle> triangles, std::size_t n,
    const std::function<bool(std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t)>& apart) {
  std::vector<BorderEdge> out;
  for_each_edge_use(triangles, n, [&](std::uint32_t a, const auto& uses) {
    const auto [b, first] = uses[0];
    if (a == b) return;  // a point
    const auto is_other = [&, b = b, first = first](const auto& use) {
      return apart(a, b, first, use.second);
    };
    if (std::none_of(uses.begin() + 1, uses.end(), is_other)) return;
    for (const auto& use : uses) out.push_back({a, b, use.second});
  });
  return out;
}

std::vector<bool> find_border_vertices(std::span<const Triangle> triangles,
                                       std::size_t n_vertices) {
  std::vector<bool> out(n_vertices, false);
  for (const BorderEdge& edge : find_border_edges(triangles, n_vertices))
    out[edge.a] = out[edge.b] = true;
  return out;
}

}  // namespace viewcell

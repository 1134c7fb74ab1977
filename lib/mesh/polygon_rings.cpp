#include "mesh/polygon_rings.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace viewcell {
namespace {

constexpr std::uint32_t kNoEdge = 0xffffffffu;

// Edge e runs from corner e to the next. Its ends are places: numbers that equal points share.
struct RingEdge {
  std::uint32_t from = 0, to = 0;
  bool is_there = true;
};

std::vector<std::uint32_t> find_places(const std::vector<glm::dvec2>& points) {
  std::vector<std::uint32_t> order(points.size()), place(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const glm::dvec2 &a = points[i], &b = points[j];
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : i < j;
  });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool is_new = k == 0 || points[order[k]] != points[order[k - 1]];
    place[order[k]] = is_new ? order[k] : place[order[k - 1]];
  }
  return place;
}

// Without those that lead nowhere or are run along both ways.
std::vector<RingEdge> make_edges(const std::vector<std::uint32_t>& place) {
  const auto n = static_cast<std::uint32_t>(place.size());
  const auto key = [](std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; };
  std::vector<RingEdge> edges(n);
  std::unordered_multimap<std::uint64_t, std::uint32_t> unmatched;
  for (std::uint32_t e = 0; e < n; ++e) {
    const std::uint32_t a = place[e], b = place[(e + 1) % n];
    edges[e] = {a, b, a != b};
    if (a == b) continue;
    const auto opposite = unmatched.find(key(b, a));
    if (opposite == unmatched.end()) {
      unmatched.emplace(key(a, b), e);
      continue;
    }
    edges[e].is_there = edges[opposite->second].is_there = false;
    unmatched.erase(opposite);
  }
  return edges;
}

// An edge at a place where several meet.
struct Spoke {
  std::uint32_t edge;
  bool is_out;
  glm::dvec2 direction;  // away from the place
};

// Clockwise from the negative x axis on.
bool is_clockwise_before(const Spoke& s, const Spoke& t) {
  const glm::dvec2 &a = s.direction, &b = t.direction;
  const auto is_low = [](const glm::dvec2& d) { return d.y < 0 || (d.y == 0 && d.x > 0); };
  if (is_low(a) != is_low(b)) return is_low(b);
  return a.x * b.y - a.y * b.x < 0;
}

// What is inside lies clockwise of an edge that came in, up to one that goes out.
bool pair_spokes(std::vector<Spoke>& spokes, std::vector<std::uint32_t>& next) {
  std::stable_sort(spokes.begin(), spokes.end(), is_clockwise_before);
  for (std::size_t k = 0; k < spokes.size(); ++k) {
    const Spoke& after = spokes[(k + 1) % spokes.size()];
    if (spokes[k].is_out == after.is_out) return false;
    if (!spokes[k].is_out) next[spokes[k].edge] = after.edge;
  }
  return true;
}

// The edge that follows each; empty where edges cross.
std::vector<std::uint32_t> link_edges(const std::vector<RingEdge>& edges,
                                      const std::vector<glm::dvec2>& points) {
  const auto n = static_cast<std::uint32_t>(edges.size());
  std::vector<std::uint32_t> next(n, kNoEdge), out(n, kNoEdge);  // out: by place, the only one
  std::map<std::uint32_t, std::vector<Spoke>> shared;            // by place
  for (std::uint32_t e = 0; e < n; ++e)
    if (edges[e].is_there && std::exchange(out[edges[e].from], e) != kNoEdge) shared[edges[e].from];
  for (std::uint32_t e = 0; e < n; ++e) {
    if (!edges[e].is_there) continue;
    next[e] = out[edges[e].to];
    const glm::dvec2 along = points[edges[e].to] - points[edges[e].from];
    if (const auto at = shared.find(edges[e].from); at != shared.end())
      at->second.push_back({e, true, along});
    if (const auto at = shared.find(edges[e].to); at != shared.end())
      at->second.push_back({e, false, -along});
  }
  for (auto& [place, spokes] : shared)
    if (!pair_spokes(spokes, next)) return {};
  return next;
}

}  // namespace

std::vector<RingStep> make_rings(const std::vector<glm::dvec2>& points) {
  const std::vector<RingEdge> edges = make_edges(find_places(points));
  const std::vector<std::uint32_t> next = link_edges(edges, points);
  std::vector<std::uint32_t> step(next.size());
  std::vector<RingStep> out;
  for (std::uint32_t e = 0; e < next.size(); ++e) {
    if (!edges[e].is_there) continue;
    step[e] = static_cast<std::uint32_t>(out.size());
    out.push_back({points[e], e, 0, 0});
  }
  for (RingStep& here : out) {
    const std::uint32_t from = step[here.corner], to = step[next[here.corner]];
    here.next = to;
    out[to].prev = from;
  }
  return out;
}

}  // namespace viewcell

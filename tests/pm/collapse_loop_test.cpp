#include "pm/collapse_loop.h"

#include <gtest/gtest.h>

#include <set>

#include "pm/qem.h"
#include "pm/shapes.h"

namespace viewcell {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

// A cost per vertex, whatever it collapses into; keeps the collapses that were made.
struct ListedMetric {
  std::vector<float> costs;
  std::set<Edge> forbidden;
  std::vector<Edge> made;
  float cost(std::uint32_t u, std::uint32_t) const { return costs[u]; }
  bool allows(const CollapseMesh&, std::uint32_t u, std::uint32_t v) const {
    return !forbidden.contains({u, v});
  }
  void collapsed(std::uint32_t u, std::uint32_t v) { made.emplace_back(u, v); }
};

constexpr float kNever = std::numeric_limits<float>::infinity();

// Every second vertex of every second row inside a grid: no two are neighbours, so all may go.
struct Islands {
  TriMesh grid = make_flat_grid(12);
  std::vector<std::uint32_t> vertices;
  ListedMetric metric;
  explicit Islands(std::uint64_t seed) {
    Random random(seed);
    metric.costs.assign(grid.positions.size(), kNever);
    for (std::uint32_t y = 2; y < 11; y += 2)
      for (std::uint32_t x = 2; x < 11; x += 2) {
        vertices.push_back(y * 13 + x);
        metric.costs[vertices.back()] = static_cast<float>(random.below(5));
      }
  }
};

TEST(CollapseLoop, CollapsesInOrderOfCostThenId) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    Islands islands(seed);
    CollapseMesh mesh(islands.grid.positions, islands.grid.triangles);
    CollapseLoop loop(mesh, islands.metric);
    const CollapseCounts counts = loop.run({});
    std::vector<std::pair<float, std::uint32_t>> expected, made;
    for (const std::uint32_t v : islands.vertices)
      expected.emplace_back(islands.metric.costs[v], v);
    std::sort(expected.begin(), expected.end());
    for (const auto& [u, v] : islands.metric.made) made.emplace_back(islands.metric.costs[u], u);
    EXPECT_EQ(made, expected);
    EXPECT_EQ(counts.n_collapses, expected.size());
    EXPECT_EQ(counts.last_cost, expected.back().first);
    EXPECT_EQ(mesh.n_triangles(), islands.grid.triangles.size() - 2 * expected.size());
  }
}

TEST(CollapseLoop, EqualTargetsGoToTheLowestId) {
  Islands islands(1);
  CollapseMesh mesh(islands.grid.positions, islands.grid.triangles);
  CollapseLoop loop(mesh, islands.metric);
  loop.run({});
  for (const auto& [u, v] : islands.metric.made) EXPECT_EQ(v, u - 14);  // below, to the left
}

TEST(CollapseLoop, MaxCostStopsIt) {
  Islands islands(2);
  CollapseMesh mesh(islands.grid.positions, islands.grid.triangles);
  CollapseLoop loop(mesh, islands.metric);
  const CollapseCounts counts = loop.run({.max_cost = 2});
  std::size_t n_cheap = 0;
  for (const std::uint32_t v : islands.vertices) n_cheap += islands.metric.costs[v] <= 2;
  EXPECT_EQ(counts.n_collapses, n_cheap);
  EXPECT_LE(counts.last_cost, 2);
}

TEST(CollapseLoop, TargetStopsIt) {
  Islands islands(3);
  CollapseMesh mesh(islands.grid.positions, islands.grid.triangles);
  CollapseLoop loop(mesh, islands.metric);
  const std::size_t n = islands.grid.triangles.size();
  EXPECT_EQ(loop.run({.target_triangles = n}).n_collapses, 0u);
  EXPECT_EQ(loop.run({.target_triangles = n - 5}).n_collapses, 3u);  // two triangles each
  EXPECT_EQ(mesh.n_triangles(), n - 6);
}

// What the metric forbids is counted, and the vertex takes its next target.
TEST(CollapseLoop, RefusalIsReplacedByTheNextTarget) {
  Islands islands(4);
  const std::uint32_t u = islands.vertices[7];
  islands.metric.forbidden.emplace(u, u - 14);
  CollapseMesh mesh(islands.grid.positions, islands.grid.triangles);
  CollapseLoop loop(mesh, islands.metric);
  const CollapseCounts counts = loop.run({});
  EXPECT_EQ(counts.n_refused[static_cast<std::size_t>(Refusal::metric)], 1u);
  EXPECT_EQ(counts.n_collapses, islands.vertices.size());
  EXPECT_EQ(std::count(islands.metric.made.begin(), islands.metric.made.end(), Edge(u, u - 13)), 1);
}

// An illegal edge at the top does not end the loop: only boundary vertices are cheap, and
// only inward.
TEST(CollapseLoop, IllegalTopDoesNotEndIt) {
  const TriMesh sphere = make_noisy_sphere(2, 0.1, 1);
  struct : QemMetric {
    using QemMetric::QemMetric;
    bool allows(const CollapseMesh&, std::uint32_t u, std::uint32_t) const { return u % 3 != 0; }
  } metric(sphere.positions, sphere.triangles);
  CollapseMesh mesh(sphere.positions, sphere.triangles);
  CollapseLoop loop(mesh, metric);
  const CollapseCounts counts = loop.run({});
  EXPECT_GT(counts.n_refused[static_cast<std::size_t>(Refusal::metric)], 0u);
  EXPECT_GT(counts.n_collapses, sphere.positions.size() / 3);
  for (std::uint32_t v = 0; v < sphere.positions.size(); v += 3) EXPECT_TRUE(mesh.has_triangles(v));
}

// Vertex 84 may not collapse anywhere before its neighbour 98 has; 98 may not go into 84.
struct WaitingMetric : ListedMetric {
  bool is_open = false;
  bool allows(const CollapseMesh&, std::uint32_t u, std::uint32_t v) const {
    return u == 84 ? is_open : v != 84;
  }
  void collapsed(std::uint32_t u, std::uint32_t v) {
    is_open = is_open || u == 98;
    ListedMetric::collapsed(u, v);
  }
};

TEST(CollapseLoop, ParkedVertexIsTriedAgainWhenItsSurroundingsChange) {
  const TriMesh grid = make_flat_grid(12);
  WaitingMetric metric;
  metric.costs.assign(grid.positions.size(), kNever);
  metric.costs[84] = 0, metric.costs[98] = 1;
  CollapseMesh mesh(grid.positions, grid.triangles);
  CollapseLoop loop(mesh, metric);
  EXPECT_EQ(loop.run({}).n_collapses, 2u);
  EXPECT_EQ(metric.made, (std::vector<Edge>{{98, 85}, {84, 70}}));
}

std::vector<Triangle> run_in_steps(const TriMesh& input, const std::vector<CollapseLimits>& steps,
                                   std::size_t& n_collapses) {
  CollapseMesh mesh(input.positions, input.triangles);
  QemMetric metric(input.positions, input.triangles);
  CollapseLoop loop(mesh, metric);
  n_collapses = 0;
  for (const CollapseLimits& limits : steps) n_collapses += loop.run(limits).n_collapses;
  return mesh.triangles();
}

TEST(CollapseLoop, ContinuingEqualsOneRun) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    const TriMesh sphere = make_noisy_sphere(3, 0.2, seed);
    std::size_t n_once = 0, n_steps = 0;
    const auto once = run_in_steps(sphere, {{.target_triangles = 60}}, n_once);
    EXPECT_EQ(run_in_steps(sphere,
                           {{.target_triangles = 400},
                            {.target_triangles = 100, .max_cost = 0.05f},
                            {.target_triangles = 61},
                            {.target_triangles = 60}},
                           n_steps),
              once);
    EXPECT_EQ(n_steps, n_once);
  }
}

// No vertex that the loop gave up can still collapse for less than what it was last told to allow.
TEST(CollapseLoop, LeavesNothingLegalThatCostsLess) {
  const TriMesh sphere = make_noisy_sphere(3, 0.2, 9);
  CollapseMesh mesh(sphere.positions, sphere.triangles);
  QemMetric metric(sphere.positions, sphere.triangles);
  CollapseLoop loop(mesh, metric);
  const CollapseLimits limits{.max_cost = 0.05f};
  loop.run(limits);
  std::vector<std::uint32_t> ring;
  std::size_t n_missed = 0, n_tried = 0;
  for (std::uint32_t u = 0; u < mesh.n_vertices(); ++u) {
    mesh.ring(u, ring);
    for (const std::uint32_t v : ring) {
      ++n_tried;
      n_missed += metric.cost(u, v) <= limits.max_cost &&
                  mesh.check(u, v, limits.min_cosine) == Refusal::none;
    }
  }
  EXPECT_GT(n_tried, 100u);
  EXPECT_EQ(n_missed, 0u);
}

}  // namespace
}  // namespace viewcell

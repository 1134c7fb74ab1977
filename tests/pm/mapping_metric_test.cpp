#include "pm/mapping_metric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "base/error.h"
#include "mesh/closest_point.h"
#include "mesh/surface_distance.h"
#include "pm/build.h"
#include "pm/parts.h"

namespace viewcell {
namespace {

struct Surface {
  const TriMesh& mesh;
  std::vector<Triangle> triangles;

  // The point at some texture coordinates.
  std::optional<glm::dvec3> at(const std::vector<glm::vec2>& uv, const glm::dvec2& p) const {
    for (const Triangle& t : triangles) {
      const glm::dvec2 a = uv[t[0]], b = uv[t[1]], c = uv[t[2]];
      const auto area = [](glm::dvec2 x, glm::dvec2 y) { return x.x * y.y - x.y * y.x; };
      const glm::dvec3 w(area(b - p, c - p), area(c - p, a - p), area(a - p, b - p));
      const double sum = w.x + w.y + w.z;
      if (std::min({w.x, w.y, w.z}) < -1e-9 * sum) continue;
      return (w.x * glm::dvec3(mesh.positions[t[0]]) + w.y * glm::dvec3(mesh.positions[t[1]]) +
              w.z * glm::dvec3(mesh.positions[t[2]])) /
             sum;
    }
    return {};
  }
  double distance(const glm::dvec3& p) const {
    double best = 1e30;
    for (const Triangle& t : triangles)
      best = std::min(
          best, glm::distance(p, closest_point_on_triangle(p, glm::dvec3(mesh.positions[t[0]]),
                                                           glm::dvec3(mesh.positions[t[1]]),
                                                           glm::dvec3(mesh.positions[t[2]]))));
    return best;
  }
  // Points of all triangles, n to a side.
  template <typename Visit>
  void sample(int n, Visit&& visit) const {
    for (const Triangle& t : triangles)
      for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j) visit(t, i / double(n), j / double(n));
  }
};

// The fan after 0 -> v.
std::vector<Triangle> collapsed_fan(const TriMesh& fan, std::uint32_t v) {
  std::vector<Triangle> out;
  for (Triangle t : fan.triangles) {
    if (t[1] == v || t[2] == v) continue;
    t[0] = v;
    out.push_back(t);
  }
  return out;
}

std::vector<glm::vec2> vertex_texcoords(const TriMesh& fan) {
  std::vector<glm::vec2> out(fan.positions.size());
  for (std::size_t c = 0; c < fan.texcoords.size(); ++c)
    out[fan.triangles[c / 3][c % 3]] = fan.texcoords[c];
  return out;
}

//       2---1         a flat hexagon, its middle raised by 0.25: whatever it collapses into, the
//      / \ / \        middle lies 0.25 above the new faces, and nothing is farther
//     3---0---6
//      \ / \ /
//       4---5
TEST(MappingMetric, ARaisedMiddleIsItsHeight) {
  Random random(1);
  TriMesh fan = make_fan(6, 0, 0, random);
  fan.positions[0].z = 0.25f;
  Parts parts(fan);
  for (const Matching matching : {Matching::texture, Matching::nearest})
    for (const bool total : {false, true}) {
      MappingMetric metric = parts.metric(matching, total);
      // a box around the vectors (0, 0, 0.25) and (0, x, y) reaches a little farther than they do
      const double slack = total ? 0.01 : 1e-6;
      for (std::uint32_t v = 1; v <= 6; ++v) EXPECT_NEAR(metric.cost(0, v), 0.25, slack);
    }
}

// With the middle's texture coordinates moved aside APS sees a slide; the mapping metric does not.
TEST(MappingMetric, BadTextureCoordinatesMisleadApsOnly) {
  Random random(2);
  TriMesh fan = make_fan(6, 0, 0, random);
  for (std::size_t c = 0; c < fan.texcoords.size(); c += 3) fan.texcoords[c] = {0.4f, 0.1f};
  Parts parts(fan);
  MappingMetric aps = parts.metric(Matching::texture, false);
  MappingMetric mapping = parts.metric(Matching::nearest, false);
  for (std::uint32_t v = 1; v <= 6; ++v) {
    EXPECT_GE(aps.cost(0, v), std::hypot(0.4, 0.1) - 1e-6);
    EXPECT_NEAR(mapping.cost(0, v), 0, 1e-6);
  }
}

// The largest distance of points of equal texture coordinates, by sampling both surfaces.
TEST(MappingMetric, ApsIsTheLargestTextureDeviation) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const TriMesh fan = make_fan(4 + random.below(5), 0.12, 0.5, random);
    const std::vector<glm::vec2> uv = vertex_texcoords(fan);
    const std::uint32_t v = 1 + random.below(static_cast<std::uint32_t>(fan.positions.size() - 1));
    Parts parts(fan);
    if (parts.turns_over(0, v)) continue;
    const double cost = parts.metric(Matching::texture, false).cost(0, v);
    const Surface before{fan, fan.triangles}, after{fan, collapsed_fan(fan, v)};
    double largest = 0;
    before.sample(60, [&](const Triangle& t, double b, double c) {
      const glm::dvec2 p =
          (1 - b - c) * glm::dvec2(uv[t[0]]) + b * glm::dvec2(uv[t[1]]) + c * glm::dvec2(uv[t[2]]);
      const auto x = before.at(uv, p), y = after.at(uv, p);
      if (x && y) largest = std::max(largest, glm::distance(*x, *y));
    });
    EXPECT_LE(largest, cost * (1 + 1e-6));
    EXPECT_GE(largest, 0.93 * cost);
  }
}

// No point of either surface is farther from the other than the cost of the step says.
TEST(MappingMetric, BoundsTheDistanceOfAStep) {
  double tightest = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const TriMesh fan = make_fan(3 + random.below(8), 0.4, 0.8, random);
    const std::uint32_t v = 1 + random.below(static_cast<std::uint32_t>(fan.positions.size() - 1));
    Parts parts(fan);
    const Surface before{fan, fan.triangles}, after{fan, collapsed_fan(fan, v)};
    double largest = 0;
    for (const auto& [from, to] : {std::pair{&before, &after}, std::pair{&after, &before}})
      from->sample(20, [&, f = from, g = to](const Triangle& t, double b, double c) {
        const auto at = [&](std::size_t k) { return glm::dvec3(f->mesh.positions[t[k]]); };
        largest = std::max(largest, g->distance((1 - b - c) * at(0) + b * at(1) + c * at(2)));
      });
    for (const Matching matching : {Matching::texture, Matching::nearest}) {
      const double cost = parts.metric(matching, false).cost(0, v);
      EXPECT_GE(cost * (1 + 1e-6), largest);
      tightest = std::max(tightest, largest / cost);
      EXPECT_GE(parts.metric(matching, true).cost(0, v) * (1 + 1e-6), cost);
    }
  }
  EXPECT_GT(tightest, 0.95);
}

// Flat meshes with a flat texture collapse for nothing, at boundaries and chart borders too.
TEST(MappingMetric, FlatCostsNothing) {
  TriMesh grid = make_flat_grid(8);
  for (const Triangle& t : grid.triangles)
    for (const std::uint32_t v : t)
      grid.texcoords.emplace_back(grid.positions[v].x + (t[0] % 9 < 4 ? 0 : 100),
                                  grid.positions[v].y);
  for (const MetricKind kind : {MetricKind::aps, MetricKind::mapping}) {
    BuildOptions options;
    options.metric = kind;
    options.max_cost = 1e-3f;
    const BuildResult built = build_progressive_mesh(grid, options);
    EXPECT_LE(built.record.faces.size() - built.record.born.size(), 4u);
  }
}

TEST(MappingMetric, NoFaceTurnsOverInTheTexture) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const auto& [kind, placement] : {std::pair{MetricKind::aps, Placement::half},
                                          {MetricKind::mapping, Placement::half},
                                          {MetricKind::mapping, Placement::full},
                                          {MetricKind::qem5, Placement::half},
                                          {MetricKind::qem5, Placement::full},
                                          {MetricKind::qem3, Placement::half},
                                          {MetricKind::lt, Placement::full}}) {
      SCOPED_TRACE(std::string(metric_name(kind)) + " " + std::to_string(seed));
      BuildOptions options;
      options.metric = kind;
      options.placement = placement;
      options.refuse_folds = !texture_needs(options).no_folds;
      options.min_cosine = -1;
      ProgressiveMesh pm(build_progressive_mesh(make_relief(seed), options).record);
      for (;;) {
        const TriMesh mesh = pm.extract();
        for (std::size_t c = 0; c < mesh.texcoords.size(); c += 3) {
          const glm::vec2 a = mesh.texcoords[c + 1] - mesh.texcoords[c];
          const glm::vec2 b = mesh.texcoords[c + 2] - mesh.texcoords[c];
          ASSERT_GT(a.x * b.y - a.y * b.x, 0) << pm.level();
        }
        if (pm.level() == pm.n_splits()) break;
        pm.refine();
      }
    }
}

// Costs of the mean add up to the mean square distance of matched points, which is about that of
// nearest points, and no less than it.
TEST(MappingMetric, MeansAddUp) {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    SCOPED_TRACE(seed);
    TriMesh sphere = make_noisy_sphere(4, 0.01, seed);
    for (const Triangle& t : sphere.triangles)
      for (const std::uint32_t v : t)
        sphere.texcoords.emplace_back(
            sphere.positions[v].x + (sphere.positions[t[0]].z > 0 ? 3 : 0), sphere.positions[v].y);
    BuildOptions options;
    options.metric = MetricKind::mapping;
    options.measure = Measure::mean;
    if (seed > 2) options.placement = Placement::full;
    const BuildResult built = build_progressive_mesh(sphere, options);
    ProgressiveMesh pm(built.record);
    for (const std::size_t n : {500u, 200u, 100u}) {
      pm.set_faces(n);
      double square = 0;
      for (std::size_t i = pm.level(); i < pm.n_splits(); ++i)
        square += std::pow(built.record.splits[i].cost, 2);
      DistanceOptions distance;
      distance.n_samples = 20000;
      const double rms = measure_surface_distance(sphere, pm.extract(), distance).forward.rms;
      EXPECT_GT(std::sqrt(square), 0.98 * rms) << n;
      // two steps a collapse, either of which may go astray and the other bring back
      EXPECT_LT(std::sqrt(square), (seed > 2 ? 1.6 : 1.35) * rms) << n;
    }
  }
}

TEST(MappingMetric, NeedsTextureCoordinates) {
  for (const MetricKind kind : {MetricKind::aps, MetricKind::mapping, MetricKind::qem5}) {
    BuildOptions options;
    options.metric = kind;
    EXPECT_THROW(build_progressive_mesh(make_octahedron(), options), InputError);
    options.placement = Placement::full;
    if (kind == MetricKind::aps) {
      EXPECT_THROW(build_progressive_mesh(make_octahedron(), options), UsageError);
    } else if (kind == MetricKind::qem5) {
      EXPECT_THROW(build_progressive_mesh(make_octahedron(), options), InputError);
    }
  }
}

}  // namespace
}  // namespace viewcell

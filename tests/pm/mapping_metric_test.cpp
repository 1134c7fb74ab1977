#include "pm/mapping_metric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "base/error.h"
#include "mesh/closest_point.h"
#include "mesh/surface_distance.h"
#include "pm/build.h"
#include "pm/shapes.h"
#include "pm/texture_fold.h"

namespace viewcell {
namespace {

// A fan of n triangles around vertex 0; rim vertices 1 ... n. Positions and texture coordinates are
// near a regular n-gon, off by up to `noise`; heights are random.
TriMesh make_fan(std::uint32_t n, double noise, double height, Random& random) {
  TriMesh mesh;
  std::vector<glm::vec2> uv;
  const auto add = [&](double x, double y) {
    const auto off = [&] { return random.uniform(-noise, noise); };
    mesh.positions.emplace_back(x + off(), y + off(), random.uniform(-height, height));
    uv.emplace_back(x + off(), y + off());
  };
  add(0, 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 6.283185307179586 * i / n;
    add(std::cos(angle), std::sin(angle));
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
    for (const std::uint32_t v : mesh.triangles.back()) mesh.texcoords.push_back(uv[v]);
  }
  return mesh;
}

// The parts that a metric needs.
struct Parts {
  WedgeMesh wedges;
  std::vector<Triangle> triangles;
  CollapseMesh mesh;
  WedgeTable table;
  explicit Parts(const TriMesh& input)
      : wedges(make_wedges(input)),
        triangles(wedges.vertex_triangles()),
        mesh(wedges.positions, triangles),
        table(wedges) {}
  bool turns_over(std::uint32_t u, std::uint32_t v) {
    if (!table.match(mesh, u, v, false)) return false;
    std::vector<glm::vec2> merged;
    for (const auto& pair : table.pairs()) merged.push_back(wedges.texcoords[pair.to]);
    return turns_over_texture(mesh, table, wedges.texcoords, u, v, merged, false);
  }
  MappingMetric metric(Matching matching, bool total) {
    return {mesh,
            table,
            wedges.positions,
            wedges.texcoords,
            triangles,
            {.matching = matching, .total = total}};
  }
};

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

// A sphere of 128 triangles with random radii; texture coordinates by latitude and longitude of
// each hemisphere, off by some noise.
TriMesh make_small_sphere(std::uint64_t seed) {
  Random random(seed);
  TriMesh mesh = make_noisy_sphere(2, 0.3, seed);
  std::vector<glm::vec2> uv;
  for (const glm::vec3& p : mesh.positions) {
    const glm::vec3 n = glm::normalize(p);
    uv.emplace_back(n.x + random.uniform(-0.02, 0.02), n.y + random.uniform(-0.02, 0.02));
  }
  for (const Triangle& t : mesh.triangles) {
    float z = 0;
    for (const std::uint32_t v : t) z += mesh.positions[v].z;
    for (const std::uint32_t v : t) mesh.texcoords.push_back(uv[v] + glm::vec2(z > 0 ? 3 : 0, 0));
  }
  return mesh;
}

double measure_max(const TriMesh& a, const TriMesh& b) {
  DistanceOptions options;
  options.n_samples = 2000;
  options.n_threads = 1;
  return measure_surface_distance(a, b, options).symmetric().max;
}

TEST(MappingMetric, TotalErrorsHold) {
  double tightest = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    const TriMesh sphere = make_small_sphere(seed);
    BuildOptions options;
    options.metric = seed % 2 ? MetricKind::mapping : MetricKind::aps;
    if (seed % 3 == 0) {  // the bound beside another metric
      options.metric = MetricKind::qem3;
      options.error_bound = 1e30f;
    }
    ProgressiveMesh pm(build_progressive_mesh(sphere, options).record);
    for (const std::size_t n : {100u, 50u, 20u}) {
      pm.set_faces(n);
      if (pm.n_faces() < 8) continue;
      const double measured = measure_max(sphere, pm.extract());
      ASSERT_GE(pm.error(), 0);
      ASSERT_LE(measured, pm.error() * (1 + 1e-6)) << n;
      tightest = std::max(tightest, measured / pm.error());
    }
  }
  EXPECT_GT(tightest, 0.8);
}

// An open mesh in relief, with texture coordinates that are a little off.
TriMesh make_relief(std::uint64_t seed) {
  Random random(seed);
  TriMesh grid = make_flat_grid(7);
  std::vector<glm::vec2> uv;
  for (glm::vec3& p : grid.positions) {
    uv.emplace_back(p.x + random.uniform(-0.1, 0.1), p.y + random.uniform(-0.1, 0.1));
    p.z = static_cast<float>(random.uniform(0, 0.7));
  }
  for (const Triangle& t : grid.triangles)
    for (const std::uint32_t v : t) grid.texcoords.push_back(uv[v]);
  return grid;
}

TEST(MappingMetric, TotalErrorsHoldAtBoundaries) {
  double tightest = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    const TriMesh relief = make_relief(seed);
    BuildOptions options;
    options.metric = seed % 2 ? MetricKind::mapping : MetricKind::aps;
    options.min_cosine = -1;  // whatever folds
    ProgressiveMesh pm(build_progressive_mesh(relief, options).record);
    for (const std::size_t n : {60u, 30u, 10u, 3u}) {
      pm.set_faces(n);
      const double measured = measure_max(relief, pm.extract());
      ASSERT_LE(measured, pm.error() * (1 + 1e-6)) << n;
      tightest = std::max(tightest, measured / pm.error());
    }
  }
  EXPECT_GT(tightest, 0.8);
}

// Full-edge collapses: the bound beside lt and qem3, and the metric made of it. It is sums of two
// boxes, so it is farther from the measured distance than half-edge collapses' are.
TEST(MappingMetric, TotalErrorsHoldForFullEdges) {
  double tightest = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    SCOPED_TRACE(seed);
    TriMesh mesh = seed % 2 ? make_small_sphere(seed) : make_relief(seed);
    if (seed % 5 == 0) mesh.texcoords.clear();  // no chart borders
    BuildOptions options;
    options.placement = Placement::full;
    options.min_cosine = seed % 4 ? 0.2f : -1;
    options.metric = seed % 3 == 0   ? MetricKind::mapping
                     : seed % 3 == 1 ? MetricKind::lt
                                     : MetricKind::qem3;
    if (options.metric != MetricKind::mapping) options.error_bound = 1e30f;
    ProgressiveMesh pm(build_progressive_mesh(mesh, options).record);
    for (const std::size_t n : {70u, 40u, 12u, 4u}) {
      pm.set_faces(n);
      if (pm.n_faces() < 2) continue;
      const double measured = measure_max(mesh, pm.extract());
      ASSERT_LE(measured, pm.error() * (1 + 1e-6)) << n;
      tightest = std::max(tightest, measured / pm.error());
    }
  }
  EXPECT_GT(tightest, 0.7);
}

// Where both vertices go makes no difference on a plane; nor which of them is called u.
TEST(MappingMetric, FlatFullEdgesCostNothing) {
  for (const bool is_bound : {false, true}) {
    BuildOptions options;
    options.placement = Placement::full;
    options.metric = is_bound ? MetricKind::lt : MetricKind::mapping;
    options.max_cost = is_bound ? std::numeric_limits<float>::infinity() : 1e-3f;
    if (is_bound) options.error_bound = 1e-3f;
    const BuildResult built = build_progressive_mesh(make_flat_grid(8), options);
    EXPECT_LE(built.record.faces.size() - built.record.born.size(), 4u);
  }
}

// The cells of a moved vertex take up the whole star before, whichever way it moves.
TEST(CollapseMap, MovedCellsCoverTheStar) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriMesh fan = make_fan(3 + random.below(6), 0.1, 0, random);
    const bool is_open = seed % 3 == 0;
    if (is_open) fan.triangles.pop_back(), fan.texcoords.resize(3 * fan.triangles.size());
    Parts parts(fan);
    CollapseMap map(parts.mesh, parts.table, parts.wedges.positions, {}, Matching::nearest, true);
    const double angle = random.uniform(0, 6.28), radius = random.uniform(0, 0.35);
    const glm::dvec3 to =
        glm::dvec3(fan.positions[0]) + radius * glm::dvec3(std::cos(angle), std::sin(angle), 0);
    ASSERT_TRUE(map.lay_move(0, to));
    std::vector<double> covered(fan.triangles.size(), 0);
    for (std::size_t i = 0; i < map.overlay().cells().size(); ++i)
      covered[map.faces()[map.overlay().cells()[i].old_face]] += map.overlay().moments()[i].area;
    for (std::size_t f = 0; f < fan.triangles.size(); ++f) {
      const double area = glm::length(area_normal(fan, fan.triangles[f])) / 2;
      EXPECT_GE(covered[f], area - 1e-5) << f;
      EXPECT_LE(covered[f], is_open ? 1e30 : area + 1e-5) << f;
    }
    if (is_open) continue;
    EXPECT_NEAR(map.overlay().largest_shift(), 0, 1e-7);
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
      options.refuse_folds = !needs_texture(kind);
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

// The parts of an old face that the cells take make up the face.
TEST(CollapseMap, CellsCoverTheStar) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const TriMesh fan = make_fan(4 + random.below(6), 0.1, 0, random);
    const std::uint32_t v = 1 + random.below(static_cast<std::uint32_t>(fan.positions.size() - 1));
    Parts parts(fan);
    CollapseMap map(parts.mesh, parts.table, parts.wedges.positions, parts.wedges.texcoords,
                    Matching::texture, true);
    ASSERT_TRUE(map.lay(0, v));
    if (parts.turns_over(0, v)) continue;
    std::vector<double> covered(fan.triangles.size(), 0);
    for (std::size_t i = 0; i < map.overlay().cells().size(); ++i)
      covered[map.faces()[map.overlay().cells()[i].old_face]] += map.overlay().moments()[i].area;
    for (std::size_t f = 0; f < fan.triangles.size(); ++f)
      EXPECT_NEAR(covered[f], glm::length(area_normal(fan, fan.triangles[f])) / 2, 1e-5) << f;
  }
}

// Costs of the mean add up to the mean square distance of matched points, which is about that of
// nearest points, and no less than it.
TEST(MappingMetric, MeansAddUp) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    TriMesh sphere = make_noisy_sphere(4, 0.01, seed);
    for (const Triangle& t : sphere.triangles)
      for (const std::uint32_t v : t)
        sphere.texcoords.emplace_back(
            sphere.positions[v].x + (sphere.positions[t[0]].z > 0 ? 3 : 0), sphere.positions[v].y);
    BuildOptions options;
    options.metric = MetricKind::mapping;
    options.measure = Measure::mean;
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
      EXPECT_LT(std::sqrt(square), 1.35 * rms) << n;
    }
  }
}

TEST(MappingMetric, ABoundIsKept) {
  const TriMesh sphere = make_noisy_sphere(4, 0.02, 3);
  BuildOptions options;
  options.error_bound = 0.05f;
  const BuildResult built = build_progressive_mesh(sphere, options);
  EXPECT_GT(built.counts.n_refused[static_cast<std::size_t>(Refusal::bound)], 0u);
  ProgressiveMesh pm(built.record);
  EXPECT_LE(pm.error(), 0.05f);
  EXPECT_LT(pm.n_faces(), sphere.triangles.size() / 4);
  EXPECT_LE(measure_max(sphere, pm.extract()), 0.05);
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

// Whether errors that are said to bound a distance do.
#include "pm/collapse_trial.h"

#include <gtest/gtest.h>

#include "pm/build.h"
#include "pm/measure.h"
#include "pm/shapes.h"

namespace viewcell {
namespace {

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

// No level is farther from the mesh than it says. Returns the largest share of that which a
// distance takes. least_faces: levels below are left out.
double check_levels(const TriMesh& mesh, const BuildOptions& options,
                    std::initializer_list<std::size_t> levels, std::size_t least_faces) {
  double tightest = 0;
  ProgressiveMesh pm(build_progressive_mesh(mesh, options).record);
  for (const std::size_t n : levels) {
    pm.set_faces(n);
    if (pm.n_faces() < least_faces) continue;
    const double measured = measure_farthest(mesh, pm.extract());
    EXPECT_GE(pm.error(), 0);
    EXPECT_LE(measured, pm.error() * (1 + 1e-6)) << n;
    tightest = std::max(tightest, measured / pm.error());
  }
  return tightest;
}

TEST(CollapseBound, TotalErrorsHold) {
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
    tightest = std::max(tightest, check_levels(sphere, options, {100u, 50u, 20u}, 8));
  }
  EXPECT_GT(tightest, 0.8);
}

TEST(CollapseBound, TotalErrorsHoldAtBoundaries) {
  double tightest = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    const TriMesh relief = make_relief(seed);
    BuildOptions options;
    options.metric = seed % 2 ? MetricKind::mapping : MetricKind::aps;
    options.min_cosine = -1;  // whatever folds
    tightest = std::max(tightest, check_levels(relief, options, {60u, 30u, 10u, 3u}, 0));
  }
  EXPECT_GT(tightest, 0.8);
}

// Full-edge collapses: the bound beside lt and qem3, and the metric made of it. It is sums of two
// boxes, so it is farther from the measured distance than half-edge collapses' are.
TEST(CollapseBound, TotalErrorsHoldForFullEdges) {
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
    tightest = std::max(tightest, check_levels(mesh, options, {70u, 40u, 12u, 4u}, 2));
  }
  EXPECT_GT(tightest, 0.7);
}

// Where both vertices go makes no difference on a plane; nor which of them is called u.
TEST(CollapseBound, FlatFullEdgesCostNothing) {
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

// Where vertices of the file are split, for their normals say, the surface is none the less whole.
TEST(CollapseBound, SplitVerticesDoNotCutIt) {
  const TriMesh grid = make_flat_grid(8);
  TriMesh soup;
  for (const Triangle& t : grid.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : t) soup.positions.push_back(grid.positions[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  BuildOptions options;
  options.track_error = true;
  ProgressiveMesh pm(build_progressive_mesh(soup, options).record);
  pm.set_faces(4);
  EXPECT_LE(pm.n_faces(), 4u);
  EXPECT_LT(pm.error(), 1e-5f);
}

// A face on its own that vanishes counts in the bound, and with a bound it stays.
TEST(CollapseBound, APieceThatVanishesCounts) {
  for (const Placement placement : {Placement::half, Placement::full}) {
    TriMesh mesh = make_noisy_sphere(2, 0.1, 1);
    const auto n = static_cast<std::uint32_t>(mesh.positions.size());
    for (const float x : {0.0f, 1e-3f, 2e-3f}) mesh.positions.emplace_back(9 + x, x * x, 0);
    mesh.triangles.push_back({n, n + 1, n + 2});
    BuildOptions options;
    options.placement = placement;
    options.min_cosine = -1;
    options.track_error = true;
    ProgressiveMesh pm(build_progressive_mesh(mesh, options).record);
    bool is_gone = false;
    for (pm.set_level(pm.n_splits()); pm.level() > 0; pm.coarsen()) {
      const double measured = measure_farthest(mesh, pm.extract());
      is_gone = is_gone || measured > 5;
      if (pm.error() >= 0) {
        EXPECT_LE(measured, pm.error() * (1 + 1e-6) + 1e-9) << pm.level();
      }
    }
    EXPECT_TRUE(is_gone);
    options.error_bound = 0.5f;
    ProgressiveMesh kept(build_progressive_mesh(mesh, options).record);
    EXPECT_LE(measure_farthest(mesh, kept.extract()), 0.5);
    EXPECT_GE(kept.error(), 0);
  }
}

TEST(CollapseBound, ABoundIsKept) {
  const TriMesh sphere = make_noisy_sphere(4, 0.02, 3);
  BuildOptions options;
  options.error_bound = 0.05f;
  const BuildResult built = build_progressive_mesh(sphere, options);
  EXPECT_GT(built.counts.n_refused[static_cast<std::size_t>(Refusal::bound)], 0u);
  ProgressiveMesh pm(built.record);
  EXPECT_LE(pm.error(), 0.05f);
  EXPECT_LT(pm.n_faces(), sphere.triangles.size() / 4);
  EXPECT_LE(measure_farthest(sphere, pm.extract()), 0.05);
}

}  // namespace
}  // namespace viewcell

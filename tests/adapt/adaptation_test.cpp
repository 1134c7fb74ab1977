#include "adapt/adaptation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "adapt/adaptation_areas.h"
#include "pm/build.h"
#include "pm/shapes.h"

namespace viewcell {
namespace {

double texture_area(const TriMesh& mesh) {
  double sum = 0;
  for (std::size_t c = 0; c < mesh.texcoords.size(); c += 3)
    sum += std::abs(area({mesh.texcoords[c], mesh.texcoords[c + 1], mesh.texcoords[c + 2]}));
  return sum;
}

// A plane, its texture an affine map of it.
TriMesh make_uneven_grid() {
  TriMesh grid = make_flat_grid(8);
  Random random(3);
  for (glm::vec3& p : grid.positions)
    if (p.x > 0 && p.x < 8 && p.y > 0 && p.y < 8)
      p += glm::vec3(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0);
  for (const Triangle& t : grid.triangles)
    for (const std::uint32_t v : t) {
      const glm::vec3& p = grid.positions[v];
      grid.texcoords.emplace_back(0.1f * p.x + 0.02f * p.y, 0.1f * p.y);
    }
  return grid;
}

// Every collapse takes the part of the texture that its star has, once, to the part that its new
// faces have; nothing turns over.
void expect_stars_covered(const BuildResult& built, std::size_t& n_adapted) {
  const AdaptationLog log = make_adaptation_log(built.record);
  ProgressiveMesh pm(built.record);
  ASSERT_EQ(log.n_collapses(), pm.n_splits());
  pm.set_level(pm.n_splits());
  for (std::size_t i = 0; i < log.n_collapses(); ++i) {
    const double before = texture_area(pm.extract());
    pm.coarsen();
    const double after = texture_area(pm.extract());
    double sum_before = 0, sum_after = 0;
    bool adapts = true;
    for (std::size_t step = 0; step < log.steps_per_collapse; ++step) {
      const Adaptation adaptation = log.of(i * log.steps_per_collapse + step);
      adapts = adapts && !adaptation.triangles.empty();
      for (const AdaptationTriangle& t : adaptation.triangles) {
        const double b = area(adaptation, t, &AdaptationPoint::before);
        const double a = area(adaptation, t, &AdaptationPoint::after);
        EXPECT_GE(b, -1e-6);
        EXPECT_GE(a, -1e-6);
        sum_before += b, sum_after += a;
      }
    }
    if (!adapts) continue;
    EXPECT_NEAR(sum_after - sum_before, after - before, 1e-4) << i;
    EXPECT_GT(sum_before, 0);
    ++n_adapted;
  }
  EXPECT_EQ(log.n_folded, 0u);
  EXPECT_LT(log.n_unmapped, 1 + log.n_steps() / 20);
}

TEST(AdaptationLog, CellsCoverTheStarBeforeAndAfter) {
  for (const Placement placement : {Placement::half, Placement::full}) {
    std::size_t n_adapted = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      SCOPED_TRACE(seed);
      BuildOptions options;
      options.metric = seed % 2 ? MetricKind::mapping : MetricKind::qem5;
      options.placement = placement;
      expect_stars_covered(build_progressive_mesh(make_relief(seed), options), n_adapted);
    }
    EXPECT_GT(n_adapted, 150u);
  }
}

// On a plane whose texture is an affine map of it every point keeps its place.
TEST(AdaptationLog, FlatTexturesStay) {
  BuildOptions options;
  options.metric = MetricKind::mapping;
  options.target_faces = 8;
  const AdaptationLog log =
      make_adaptation_log(build_progressive_mesh(make_uneven_grid(), options).record);
  EXPECT_GT(log.n_collapses(), 40u);
  EXPECT_EQ(log.n_folded, 0u);
  EXPECT_GT(log.triangles.size(), 4 * log.n_collapses());
  for (const AdaptationPoint& point : log.points)
    EXPECT_LT(glm::distance(point.before, point.after), 1e-4f);
}

}  // namespace
}  // namespace viewcell

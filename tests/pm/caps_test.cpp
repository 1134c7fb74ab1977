// Solids with plane caps of many corners, as CAD programs write them: fans of long triangles.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pm/build.h"
#include "pm/measure.h"
#include "pm/ways.h"

namespace viewcell {
namespace {

// A cylinder of radius and height 1 and n sides, its caps fans around their first corners.
TriMesh make_capped_cylinder(std::uint32_t n) {
  TriMesh mesh;
  for (const int z : {0, 1})
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n;
      mesh.positions.emplace_back(std::cos(angle), std::sin(angle), z);
    }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.triangles.insert(mesh.triangles.end(), {{i, j, n + j}, {i, n + j, n + i}});
  }
  for (std::uint32_t i = 1; i + 1 < n; ++i)
    mesh.triangles.insert(mesh.triangles.end(), {{0, i + 1, i}, {n, n + i, n + i + 1}});
  return mesh;
}

void expect_rims(const TriMesh& mesh, const BuildOptions& options) {
  SCOPED_TRACE(metric_name(options.metric));
  ProgressiveMesh pm(build_progressive_mesh(mesh, options).record);
  for (const std::size_t n : {600, 400, 240}) {
    pm.set_faces(n);
    EXPECT_LT(measure_farthest(mesh, pm.extract(), 20000), 0.01) << n;
  }
}

// Full-edge collapses along the rims are good ones whatever the caps' triangles look like: each
// metric stays within a hundredth of the radius (0.24 where long triangles had their way).
TEST(Caps, RimsAreFollowed) {
  const TriMesh mesh = make_capped_cylinder(500);
  for (const MetricKind metric : {MetricKind::qem3, MetricKind::lt, MetricKind::mapping})
    expect_rims(mesh, options_of({metric, Placement::full}));
  BuildOptions mean = options_of({MetricKind::mapping, Placement::full});
  mean.measure = Measure::mean;
  expect_rims(mesh, mean);
}

}  // namespace
}  // namespace viewcell

#include "pm/chart_guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "image/image.h"
#include "pm/build.h"
#include "pm/shapes.h"

namespace viewcell {
namespace {

// Two charts side by side on one plane in space: the right border of the left one is an arc bent
// inwards, and the right chart's left border follows it closely.
TriMesh make_nested_charts() {
  TriMesh out;
  for (int side = 0; side < 2; ++side) {
    TriMesh grid = make_flat_grid(12);
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    for (const glm::vec3& p : grid.positions)
      out.positions.push_back(p + glm::vec3(20.0f * side, 0, 0));
    for (const Triangle& t : grid.triangles) {
      out.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
      for (const std::uint32_t v : t) {
        const float x = grid.positions[v].x / 12, y = grid.positions[v].y / 12;
        const float bend = 0.2f * std::sin(3.14159f * y);  // of the gap, to the left
        out.texcoords.emplace_back(
            side == 0 ? 0.05f + x * (0.5f - bend) : 0.57f - bend + x * (0.38f + bend),
            0.05f + 0.9f * y);
      }
    }
  }
  return out;
}

// Texels that two charts of the base hold.
std::size_t count_shared(const TriMesh& mesh, int size_px) {
  Image<int> owners(size_px, size_px);
  std::size_t n = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const int chart = mesh.positions[mesh.triangles[t][0]].x < 15 ? 1 : 2;
    TexelTriangle face;
    for (std::size_t k = 0; k < 3; ++k)
      face[k] = to_texels(mesh.texcoords[3 * t + k], size_px, size_px);
    for_each_span(face, size_px, size_px, [&](int x0, int x1, int y) {
      for (int x = x0; x < x1; ++x) {
        n += owners.at(x, y) != 0 && owners.at(x, y) != chart;
        owners.at(x, y) = chart;
      }
    });
  }
  return n;
}

// The most of all levels.
std::size_t most_shared(const BuildResult& built, int size_px) {
  ProgressiveMesh mesh(built.record);
  std::size_t most = count_shared(mesh.extract(), size_px);
  while (mesh.level() < mesh.n_splits()) {
    mesh.refine();
    most = std::max(most, count_shared(mesh.extract(), size_px));
  }
  return most;
}

TEST(ChartGuard, KeepsChartsApart) {
  for (const Placement placement : {Placement::half, Placement::full}) {
    BuildOptions options;
    options.metric = MetricKind::qem3;
    options.placement = placement;
    options.refuse_folds = true;
    options.target_faces = 8;
    const TriMesh input = make_nested_charts();
    ASSERT_EQ(count_shared(input, 256), 0u);
    const BuildResult free = build_progressive_mesh(input, options);
    options.charts_apart_px = 256;
    const BuildResult apart = build_progressive_mesh(input, options);
    EXPECT_GT(most_shared(free, 256), 100u);
    EXPECT_EQ(most_shared(apart, 256), 0u);
    EXPECT_GT(apart.counts.n_refused[static_cast<std::size_t>(Refusal::overlap)], 0u);
    EXPECT_EQ(free.counts.n_refused[static_cast<std::size_t>(Refusal::overlap)], 0u);
  }
}

// Of one chart alone nothing is refused.
TEST(ChartGuard, OneChartIsFree) {
  BuildOptions options;
  options.metric = MetricKind::mapping;
  const TriMesh input = make_relief(3);
  const BuildResult plain = build_progressive_mesh(input, options);
  options.charts_apart_px = 128;
  const BuildResult guarded = build_progressive_mesh(input, options);
  EXPECT_EQ(plain.counts.n_collapses, guarded.counts.n_collapses);
  EXPECT_EQ(ProgressiveMesh(plain.record).extract().positions,
            ProgressiveMesh(guarded.record).extract().positions);
}

}  // namespace
}  // namespace viewcell

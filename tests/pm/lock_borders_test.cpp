// Borders that stay.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "pm/border_edges.h"
#include "pm/build.h"
#include "pm/shapes.h"
#include "pm/ways.h"

namespace viewcell {
namespace {

// The n x n squares of a landscape from x on.
TriMesh make_tile(std::uint32_t n, float x) {
  TriMesh tile = make_flat_grid(n);
  for (glm::vec3& p : tile.positions) {
    p.x += x;
    p.z = std::sin(0.7f * p.x) * std::cos(0.9f * p.y) + 0.2f * std::sin(3 * p.x + p.y);
  }
  for (const Triangle& t : tile.triangles)
    for (const std::uint32_t v : t)
      tile.texcoords.emplace_back(0.01f * tile.positions[v].x, 0.01f * tile.positions[v].y);
  return tile;
}

using Ends = std::array<std::array<float, 3>, 2>;

std::vector<Ends> borders_of(const TriMesh& mesh) {
  std::vector<Ends> out;
  for (const BorderEdge& edge : find_border_edges(mesh.triangles, mesh.positions.size())) {
    const auto at = [&](std::uint32_t v) {
      const glm::vec3& p = mesh.positions[v];
      return std::array<float, 3>{p.x, p.y, p.z};
    };
    out.push_back({std::min(at(edge.a), at(edge.b)), std::max(at(edge.a), at(edge.b))});
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(LockBorders, TilesStillFitToTheBit) {
  for (const Way& way : kWays) {
    SCOPED_TRACE(testing::Message() << metric_name(way.metric) << placement_name(way.placement));
    for (const float x : {0.0f, 12.0f}) {
      const TriMesh tile = make_tile(12, x);
      BuildOptions options = options_of(way);
      options.lock_borders = true;
      const BuildResult built = build_progressive_mesh(tile, options);
      EXPECT_EQ(built.n_locked, 48u);
      ProgressiveMesh pm(built.record);
      EXPECT_LT(pm.n_faces(), 100u);
      for (std::size_t level = 0; level <= pm.n_splits(); level += 10) {
        pm.set_level(level);
        ASSERT_EQ(borders_of(pm.extract()), borders_of(tile)) << level;
      }
    }
  }
}

// A hole and a second piece have borders too; what is closed has none.
TEST(LockBorders, EveryBorderIsLocked) {
  BuildOptions options;
  options.lock_borders = true;
  EXPECT_EQ(build_progressive_mesh(make_noisy_sphere(3, 0.1, 1), options).n_locked, 0u);
  TriMesh holed = make_flat_grid(9);
  std::erase(holed.triangles, Triangle{44, 45, 55});  // inside: 36 vertices around, and 3
  EXPECT_EQ(build_progressive_mesh(holed, options).n_locked, 39u);
  const auto n = static_cast<std::uint32_t>(holed.positions.size());
  holed.positions.insert(holed.positions.end(), {{20, 0, 0}, {21, 0, 0}, {20, 1, 0}});
  holed.triangles.push_back({n, n + 1, n + 2});
  const BuildResult built = build_progressive_mesh(holed, options);
  EXPECT_EQ(built.n_locked, 42u);
  EXPECT_EQ(borders_of(ProgressiveMesh(built.record).extract()), borders_of(holed));
}

}  // namespace
}  // namespace viewcell

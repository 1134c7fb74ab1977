#include "pm/chart_guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "image/image.h"
#include "pm/build.h"
#include "pm/parts.h"

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

// ---- By hand -----------------------------------------------------------------------------------

constexpr int kSize = 32;

//  3---u---2   A chart of three triangles, whose border bends at u, and another chart; rows go down
//  | / | \ |   in texels, and so do these. u collapses into 2.
//  0-------1
struct Bend {
  TriMesh mesh;

  Bend(const glm::vec2& u, const std::vector<glm::vec2>& other) {
    add({{2, 20}, {18, 20}, {18, 10}, {2, 10}, u}, {{0, 1, 4}, {0, 4, 3}, {1, 2, 4}});
    std::vector<Triangle> fan;
    for (std::uint32_t i = 2; i < other.size(); ++i) fan.push_back({0, i - 1, i});
    add(other, fan);
  }
  void add(const std::vector<glm::vec2>& places, const std::vector<Triangle>& triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec2& p : places)
      mesh.positions.emplace_back(p, static_cast<float>(mesh.triangles.size()));
    for (const Triangle& t : triangles) {
      mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      for (const std::uint32_t v : t)
        mesh.texcoords.emplace_back((places[v].x + 0.5f) / kSize, 1 - (places[v].y + 0.5f) / kSize);
    }
  }
};

glm::vec2 uv_of(const glm::vec2& p) {
  return {(p.x + 0.5f) / kSize, 1 - (p.y + 0.5f) / kSize};
}

// Whether u -> v is refused; makes it known if asked to.
struct Guarded {
  Parts parts;
  ChartGuard guard;

  explicit Guarded(const TriMesh& mesh) : parts(mesh), guard(parts.wedges, kSize) {}
  bool overlaps(std::uint32_t u, std::uint32_t v) {
    EXPECT_TRUE(parts.table.match(parts.mesh, u, v));
    std::vector<glm::vec2> merged;
    for (const auto& pair : parts.table.pairs()) merged.push_back(parts.wedges.texcoords[pair.to]);
    return guard.overlaps(parts.mesh, parts.table, parts.wedges.texcoords, u, v, merged, false);
  }
  bool overlaps_at(std::uint32_t u, std::uint32_t v, const glm::vec2& place) {
    EXPECT_TRUE(parts.table.match(parts.mesh, u, v) && parts.table.match_both(parts.mesh, v));
    const std::vector<glm::vec2> merged(parts.table.pairs().size(), uv_of(place));
    return guard.overlaps(parts.mesh, parts.table, parts.wedges.texcoords, u, v, merged, true);
  }
};

std::vector<glm::vec2> box(float x0, float y0, float x1, float y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

// The border becomes a straight line at row 10, whose bend was at row 14.
TEST(ChartGuard, LooksAtTexelsAndTheirNeighbours) {
  const glm::vec2 u(10.1f, 14.2f);
  const auto refused = [&](const std::vector<glm::vec2>& other) {
    return Guarded(Bend(u, other).mesh).overlaps(4, 2);
  };
  EXPECT_TRUE(refused(box(9.5f, 4.5f, 11.5f, 11.5f)));   // in the bend
  EXPECT_TRUE(refused(box(9.5f, 4.5f, 11.5f, 9.5f)));    // row 9 touches row 10
  EXPECT_FALSE(refused(box(9.5f, 4.5f, 11.5f, 8.5f)));   // row 8 does not
  EXPECT_TRUE(refused(box(17.5f, 4.5f, 22.5f, 9.5f)));   // texel 18, 9 touches 17, 10
  EXPECT_FALSE(refused(box(18.5f, 4.5f, 22.5f, 9.5f)));  // 19, 9 does not
}

// A border that draws back is let, though what is left of the chart touches another.
TEST(ChartGuard, LetsBordersDrawBack) {
  Guarded guarded(Bend({6.1f, 6.2f}, box(17.5f, 4.5f, 22.5f, 19.5f)).mesh);
  EXPECT_FALSE(guarded.overlaps(4, 2));
}

// Shallow bends, of less than a hundredth and of 5 millionths of the star, that hold a texel of
// another chart.
TEST(ChartGuard, SeesShallowBends) {
  for (const float depth : {0.15f, 0.0001f}) {
    Guarded guarded(Bend({10.1f, 10 + depth}, {{6, 9.5f}, {14, 9.5f}, {10, 10.1f}}).mesh);
    EXPECT_TRUE(guarded.overlaps(4, 2)) << depth;
  }
}

// What a collapse has given up is free, and what it has taken is not, for both charts.
TEST(ChartGuard, RemembersWhatWasTaken) {
  constexpr std::uint32_t first = 5;
  // Where the first chart has a bulge up to row 6.2 the other must not come down to row 8, until
  // the first has drawn back to row 10.
  Bend bulge({10.1f, 6.6f}, {});
  bulge.add({{2, 1}, {2, 8}, {10, 4.2f}, {18, 8}, {18, 1}}, {{0, 1, 2}, {0, 2, 4}, {2, 3, 4}});
  {
    Guarded guarded(bulge.mesh);
    EXPECT_TRUE(guarded.overlaps(first + 2, first + 3));
    EXPECT_FALSE(guarded.overlaps(4, 2));
    EXPECT_TRUE(guarded.overlaps(first + 2, first + 3));  // asked, not made
    EXPECT_FALSE(guarded.overlaps(4, 2));
    guarded.guard.accept();
    EXPECT_FALSE(guarded.overlaps(first + 2, first + 3));
  }
  // Where the other has come down to row 8 the first may not rise.
  Bend bend({10.1f, 14.2f}, {});
  bend.add({{2, 1}, {2, 8}, {10, 4.2f}, {18, 8}, {18, 1}}, {{0, 1, 2}, {0, 2, 4}, {2, 3, 4}});
  {
    Guarded guarded(bend.mesh);
    EXPECT_FALSE(guarded.overlaps_at(4, 2, {10, 7.4f}));
    EXPECT_FALSE(guarded.overlaps(first + 2, first + 3));
    guarded.guard.accept();
    EXPECT_TRUE(guarded.overlaps_at(4, 2, {10, 7.4f}));
    EXPECT_FALSE(guarded.overlaps(4, 2));
  }
}

// Of a full-edge collapse both stars follow to the new place.
TEST(ChartGuard, FollowsBothStarsOfAFullEdge) {
  const Bend bend({10.1f, 10}, box(16.5f, 2.5f, 20.5f, 6.5f));
  {
    Guarded guarded(bend.mesh);
    EXPECT_FALSE(guarded.overlaps_at(4, 2, {17, 12}));
    EXPECT_TRUE(guarded.overlaps_at(4, 2, {17.5f, 5}));
  }
  // The parent's own faces: 3 goes to u, which then moves to the right.
  {
    Guarded guarded(Bend({10.1f, 10}, box(9.5f, 2.5f, 20.5f, 6.5f)).mesh);
    EXPECT_TRUE(guarded.overlaps_at(3, 4, {14, 5}));
    EXPECT_FALSE(guarded.overlaps_at(3, 4, {9, 10}));
  }
  // As much is gained as the faces have that go, which both stars hold.
  {
    Guarded guarded(Bend({10.1f, 10}, box(19.5f, 9.5f, 20.5f, 10.5f)).mesh);
    EXPECT_TRUE(guarded.overlaps_at(4, 2, {24.3f, 9}));
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

// Collapses where texture charts meet.
#include <gtest/gtest.h>

#include <cmath>

#include "adapt/adaptation.h"
#include "pm/build.h"
#include "pm/shapes.h"
#include "pm/ways.h"

namespace viewcell {
namespace {

// A noisy sphere cut into two charts near the plane x = 0.
TriMesh make_two_charts(std::uint64_t seed) {
  TriMesh mesh = make_noisy_sphere(3, 0.05, seed);
  for (const Triangle& t : mesh.triangles) {
    float x = 0;
    for (const std::uint32_t v : t) x += mesh.positions[v].x;
    for (const std::uint32_t v : t) {
      const glm::vec3 p = glm::normalize(mesh.positions[v]);
      mesh.texcoords.emplace_back(0.25f + 0.2f * p.y + (x > 0 ? 0.5f : 0.0f), 0.5f + 0.4f * p.z);
    }
  }
  return mesh;
}

// The same, each triangle with vertices and a normal of its own, as flat shading has it.
TriMesh split_everywhere(const TriMesh& mesh) {
  TriMesh out;
  out.texcoords = mesh.texcoords;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    out.triangles.push_back({first, first + 1, first + 2});
    for (const std::uint32_t v : t) out.positions.push_back(mesh.positions[v]);
    out.normals.insert(out.normals.end(), 3, glm::vec3(glm::normalize(area_normal(mesh, t))));
  }
  return out;
}

// Where vertices meet with equal texture coordinates no chart ends, whatever their normals.
TEST(Charts, VerticesOfOneTriangleEachCollapseAsOthers) {
  for (const Way& way : kWays) {
    SCOPED_TRACE(metric_name(way.metric) + std::string(placement_name(way.placement)));
    const TriMesh whole = make_two_charts(16), split = split_everywhere(whole);
    const BuildResult a = build_progressive_mesh(whole, options_of(way));
    const BuildResult b = build_progressive_mesh(split, options_of(way));
    EXPECT_EQ(check_record(b.record), "");
    ProgressiveMesh pm(b.record);
    EXPECT_EQ(pm.n_base_faces(), ProgressiveMesh(a.record).n_base_faces());
    EXPECT_LT(pm.n_base_faces(), 40u);
    const TriMesh base = pm.extract();
    pm.set_level(pm.n_splits());
    EXPECT_EQ(pm.extract().positions, split.positions);
    EXPECT_EQ(pm.extract().texcoords, split.texcoords);
    EXPECT_EQ(pm.extract().normals, split.normals);
    pm.set_level(0);
    EXPECT_EQ(pm.extract().texcoords, base.texcoords);
    EXPECT_EQ(find_joined_charts(make_wedges(split)).of, find_joined_charts(make_wedges(whole)).of);
  }
}

// A vertex joined to more than 256 triangles' own vertices stays, and nothing breaks.
TEST(Charts, VerticesSplitTooOftenStay) {
  constexpr int kSides = 300;
  TriMesh cone;
  cone.positions.emplace_back(0, 0, 1);
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * M_PI * i / kSides;
    cone.positions.emplace_back(std::cos(angle), std::sin(angle), 0);
    const auto a = static_cast<std::uint32_t>(i + 1);
    cone.triangles.push_back({0, a, a % kSides + 1});
  }
  for (const bool has_texture : {false, true}) {
    if (has_texture)
      for (const Triangle& t : cone.triangles)
        for (const std::uint32_t v : t)
          cone.texcoords.emplace_back(cone.positions[v].x, cone.positions[v].y);
    const BuildResult built = build_progressive_mesh(split_everywhere(cone), options_of(kWays[0]));
    EXPECT_EQ(check_record(built.record), "");
    EXPECT_GT(built.record.splits.size(), 200u);
  }
}

// Full-edge collapses go where half-edge ones may: into a chart's border, whose vertex then stays.
TEST(Charts, WhatIsInsideMayGoToTheBorder) {
  for (const Way& way : kWays) {
    if (way.placement == Placement::half) continue;
    SCOPED_TRACE(metric_name(way.metric));
    ProgressiveMesh pm(build_progressive_mesh(make_two_charts(4), options_of(way)).record);
    EXPECT_LT(pm.n_base_faces(), 24u);
    std::size_t n_into_border = 0;
    while (pm.level() < pm.n_splits()) {
      const std::size_t first = pm.first_pair();
      const VertexSplit split = pm.record().splits[pm.level()];
      const glm::vec3 after = pm.record().attributes.positions[split.parent];
      const glm::vec2 texcoord = pm.record().texcoords[pm.record().pairs[first].parent];
      pm.refine();
      if (pm.record().attributes.positions[split.parent] != after) continue;
      EXPECT_EQ(pm.record().texcoords[pm.record().pairs[first].parent], texcoord);
      ++n_into_border;
    }
    EXPECT_GT(n_into_border, 5u);
    EXPECT_LT(n_into_border, pm.n_splits() / 2);
  }
}

// Adaptation then has one step only.
TEST(Charts, WhatStaysIsNotAdapted) {
  const BuildResult built = build_progressive_mesh(make_two_charts(4), options_of(kWays[7]));
  const AdaptationLog log = make_adaptation_log(built.record);
  ASSERT_EQ(log.steps_per_collapse, 2u);
  ProgressiveMesh pm(built.record);
  pm.set_level(pm.n_splits());
  std::size_t n_stay = 0;
  for (std::size_t i = 0; i < log.n_collapses(); ++i) {
    const std::uint32_t v = pm.record().splits[pm.level() - 1].parent;
    const glm::vec3 before = pm.record().attributes.positions[v];
    pm.coarsen();
    const bool stays = pm.record().attributes.positions[v] == before;
    EXPECT_EQ(log.of(2 * i + 1).triangles.empty(), stays) << i;
    n_stay += stays;
  }
  EXPECT_GT(n_stay, 10u);
  EXPECT_EQ(log.n_folded + log.n_unmapped, 0u);
}

// In a plane only the charts can be harmed: a border that turns corners is off by their height when
// it is cut short, and `mapping` knows.
//
//   +---+--+       the border is at x = 6, a step aside in every second row of two
//   |   +-+|
//   |   +--+
TEST(Charts, BordersCostWhatTheyAreOff) {
  TriMesh grid = make_flat_grid(12);
  const auto is_right = [](const glm::vec3& p) { return p.x > (std::fmod(p.y, 4) < 2 ? 6 : 7); };
  for (const Triangle& t : grid.triangles) {
    const glm::vec3 middle =
        (grid.positions[t[0]] + grid.positions[t[1]] + grid.positions[t[2]]) / 3.0f;
    for (const std::uint32_t v : t)
      grid.texcoords.emplace_back(grid.positions[v].x + (is_right(middle) ? 20.0f : 0.0f),
                                  grid.positions[v].y);
  }
  const auto left_area = [](const TriMesh& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if (mesh.texcoords[3 * t].x < 15) sum += area_normal(mesh, mesh.triangles[t]).z / 2;
    return sum;
  };
  for (const Measure measure : {Measure::max, Measure::mean}) {
    BuildOptions options = options_of(kWays[7]);
    options.measure = measure;
    options.max_cost = 1e-3f;
    const BuildResult built = build_progressive_mesh(grid, options);
    const TriMesh kept = ProgressiveMesh(built.record).extract();
    EXPECT_LT(kept.triangles.size(), 60u);
    EXPECT_NEAR(left_area(kept), left_area(grid), 0.05);
    options.max_cost = 2;
    const TriMesh cut = ProgressiveMesh(build_progressive_mesh(grid, options).record).extract();
    EXPECT_LT(cut.triangles.size(), kept.triangles.size() / 2);
  }
}

}  // namespace
}  // namespace viewcell

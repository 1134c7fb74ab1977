#include "uv/chart_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>

#include "base/random.h"
#include "common/models.h"
#include "formats/mesh_file.h"
#include "image/texel_spans.h"
#include "mesh/surfaces.h"
#include "uv/atlas_cube.h"
#include "uv/chart_checks.h"

namespace viewcell {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A square of two triangles for each (corner, size): texture coordinates on a plane of its own.
//   3-2
//   |/|
//   0-1
struct Square {
  glm::vec2 at;
  glm::vec2 size;
};

TriMesh make_squares(const std::vector<Square>& squares) {
  TriMesh mesh;
  for (const Square& s : squares) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const float z = static_cast<float>(first);
    for (const glm::vec2 p : {glm::vec2(0), {1, 0}, {1, 1}, {0, 1}})
      mesh.positions.emplace_back(p, z);
    for (const Triangle t : {Triangle{0, 1, 2}, Triangle{0, 2, 3}}) {
      mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      for (const std::uint32_t v : t)
        mesh.texcoords.push_back(s.at + s.size * glm::vec2(mesh.positions[first + v]));
    }
  }
  return mesh;
}

std::vector<std::string> lines(const ChartFindings& findings) {
  std::vector<std::string> out(1);
  for (const char c : describe(findings))
    if (c == '\n')
      out.emplace_back();
    else
      out.back() += c;
  return out;
}

// ---- Spans -------------------------------------------------------------------------------------

// A jittered grid over the whole image: every texel's centre lies in just one triangle.
TEST(TexelSpans, NeitherGapsNorOverlaps) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    const TriMesh grid = make_grid(8, 0.24, seed);
    // Odd seeds: edges run through texel centres.
    const int size = seed % 2 ? 32 : 41;
    const double from = seed % 2 ? 0 : -0.5, scale = seed % 2 ? size : size + 0.3;
    Image<int> n_times(size, size, 0);
    for (const Triangle& t : grid.triangles) {
      std::array<glm::dvec2, 3> p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = from + scale * glm::dvec2(grid.positions[t[k]]);
      for_each_span(p, size, size, [&](int x0, int x1, int y) {
        for (int x = x0; x < x1; ++x) ++n_times.at(x, y);
      });
    }
    for (const int n : n_times.pixels) ASSERT_EQ(n, 1);
  }
}

TEST(TexelSpans, HugeAndBrokenTriangles) {
  std::size_t n = 0;
  const auto visit = [&](int x0, int x1, int) { n += static_cast<std::size_t>(x1 - x0); };
  for_each_span(TexelTriangleOf<double>{{{-1e30, -1e30}, {1e30, -1e30}, {0, 1e30}}}, 8, 4, visit);
  EXPECT_EQ(n, 32u);
  for_each_span(TexelTriangleOf<double>{{{kNan, 0}, {8, 0}, {0, 8}}}, 8, 4, visit);
  for_each_span(TexelTriangleOf<double>{{{0, HUGE_VAL}, {8, 0}, {0, 8}}}, 8, 4, visit);
  for_each_span(TexelTriangleOf<double>{{{1e30, 1}, {2e30, 1}, {1e30, 9e30}}}, 8, 4, visit);
  EXPECT_EQ(n, 32u);
}

// ---- Charts ------------------------------------------------------------------------------------

TEST(Charts, ACubeHasSix) {
  const TriMesh cube = make_atlas_cube(3);
  const Charts charts = find_charts(cube);
  EXPECT_EQ(charts.size(), 6u);
  for (std::uint32_t t = 0; t < cube.triangles.size(); ++t) EXPECT_EQ(charts.of[t], t / 18);
  EXPECT_EQ(charts.first, (std::vector<std::uint32_t>{0, 18, 36, 54, 72, 90}));
}

// Two squares that share an edge of positions, by vertices of their own.
TEST(Charts, BothEndsMustAgree) {
  TriMesh mesh = make_squares({{{0, 0}, {0.25f, 0.25f}}, {{0.25f, 0}, {0.25f, 0.25f}}});
  for (std::size_t v = 4; v < 8; ++v) mesh.positions[v] += glm::vec3(1, 0, -4);
  EXPECT_EQ(find_charts(mesh).size(), 1u);
  TriMesh low = mesh, high = mesh;  // one end of the edge is elsewhere
  low.texcoords[3 * 2].y = low.texcoords[3 * 3].y = 0.01f;
  EXPECT_EQ(find_charts(low).size(), 2u);
  high.texcoords[3 * 3 + 2].y = 0.24f;
  EXPECT_EQ(find_charts(high).size(), 2u);
}

TEST(Charts, SkipsWhatHasNoPlace) {
  TriMesh mesh = make_squares({{{0, 0}, {0.5f, 0.5f}}, {{0.5f, 0.5f}, {0.4f, 0.4f}}});
  mesh.texcoords[0].x = kNan;
  mesh.positions[6] = mesh.positions[5];  // triangle 2
  const Charts charts = find_charts(mesh);
  EXPECT_EQ(charts.of, (std::vector<std::uint32_t>{kNoChart, 0, kNoChart, 1}));
  EXPECT_EQ(charts.first, (std::vector<std::uint32_t>{1, 3}));
}

//  v = 1  . . . .
//         2 2 . .     the second square lies over a part of the first: the lower chart owns
//         1 1 1 .
//  v = 0  1 1 1 .
TEST(ChartMap, ByHand) {
  const TriMesh mesh = make_squares({{{0, 0}, {0.75f, 0.5f}}, {{0, 0.25f}, {0.5f, 0.5f}}});
  const Image<std::uint32_t> map = make_chart_map(mesh, find_charts(mesh), 4, 4);
  EXPECT_EQ(map.pixels,
            (std::vector<std::uint32_t>{0, 0, 0, 0, 2, 2, 0, 0, 1, 1, 1, 0, 1, 1, 1, 0}));
}

// As many texels as there is area, but for those at borders.
TEST(ChartMap, OwnsItsArea) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriMesh mesh = make_grid(1 + random.below(6), 0.2, seed);
    const double turn = random.uniform(0, 6.283), size = random.uniform(0.1, 0.6);
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t) {
        const glm::dvec2 p = size * (glm::dvec2(mesh.positions[v]) - 0.5);
        mesh.texcoords.emplace_back(0.5 + std::cos(turn) * p.x - std::sin(turn) * p.y,
                                    0.5 + std::sin(turn) * p.x + std::cos(turn) * p.y);
      }
    const auto map = make_chart_map(mesh, find_charts(mesh), 200, 150);
    const auto n = static_cast<double>(std::accumulate(map.pixels.begin(), map.pixels.end(), 0u));
    EXPECT_NEAR(n, 200 * 150 * size * size, 4 * 200 * size * 0.75 + 4);
    EXPECT_TRUE(check_charts(mesh, 200, 150).is_one_to_one());
  }
}

// ---- Findings ----------------------------------------------------------------------------------

TEST(ChartChecks, NothingToSay) {
  const ChartFindings f = check_charts(make_atlas_cube(4), 256, 256);
  EXPECT_TRUE(f.is_one_to_one());
  EXPECT_EQ(describe(f), "6 charts");
  EXPECT_EQ(f.n_crowded, 0u);
}

// 64 texels a unit: charts of 16 x 16 texels, the second over 4 columns of the first.
TEST(ChartChecks, TwoChartsOverlap) {
  TriMesh mesh = make_squares({{{0.5f, 0.5f}, {0.25f, 0.25f}}, {{0.6875f, 0.5f}, {0.25f, 0.25f}}});
  const ChartFindings f = check_charts(mesh, 64, 64);
  EXPECT_FALSE(f.is_one_to_one());
  ASSERT_EQ(f.overlaps.size(), 1u);
  EXPECT_EQ(f.overlaps[0].first, 0u);
  EXPECT_EQ(f.overlaps[0].second, 2u);
  EXPECT_EQ(f.overlaps[0].n_texels, 64u);
  EXPECT_TRUE(f.overlaps[0].x >= 44 && f.overlaps[0].x < 48) << f.overlaps[0].x;
  EXPECT_TRUE(f.overlaps[0].y >= 16 && f.overlaps[0].y < 32) << f.overlaps[0].y;
  EXPECT_EQ(f.n_overlapped, 2u);
  EXPECT_EQ(f.n_across_materials, 0u);
  mesh.materials = {0, 0, 1, 1};
  EXPECT_EQ(check_charts(mesh, 64, 64).n_across_materials, 1u);
  EXPECT_EQ(lines(f)[1].find("the charts of triangle 0 and triangle 2 lie over one another on 64 "
                             "texels around x 4"),
            0u);
}

// A strip of 0.9 texels width along a border, in any direction, is no overlap; one of 3 texels is.
TEST(ChartChecks, NarrowOverlapsAreNone) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double turn = random.uniform(0, 6.283);
    for (const double width : {0.9, 3.0}) {
      TriMesh mesh = make_squares(
          {{{-0.3f, -0.3f}, {0.3f, 0.6f}}, {{-float(width / 100), -0.3f}, {0.3f, 0.6f}}});
      for (glm::vec2& uv : mesh.texcoords)
        uv = {0.5 + std::cos(turn) * uv.x - std::sin(turn) * uv.y,
              0.5 + std::sin(turn) * uv.x + std::cos(turn) * uv.y};
      EXPECT_EQ(check_charts(mesh, 100, 100).overlaps.size(), width > 1 ? 1u : 0u);
    }
  }
}

// One chart lies over another in the first and in the last column: neighbours in memory only.
//  +------------+
//  ||          ||    a bar with two legs, one texel wide, over a square
TEST(ChartChecks, RowsDoNotGoOn) {
  constexpr float kTexel = 1.0f / 16;
  TriMesh mesh = make_squares({{{0, 0}, {1, 0.5f}},
                               {{0, 0}, {kTexel, 0.5f}},
                               {{1 - kTexel, 0}, {kTexel, 0.5f}},
                               {{0, 0.5f}, {kTexel, 0.25f}},
                               {{kTexel, 0.5f}, {1 - 2 * kTexel, 0.25f}},
                               {{1 - kTexel, 0.5f}, {kTexel, 0.25f}}});
  for (std::size_t c = 0; c < mesh.texcoords.size(); ++c)
    mesh.positions[mesh.triangles[c / 3][c % 3]] = glm::vec3(mesh.texcoords[c], c < 6 ? 0 : 1);
  const ChartFindings f = check_charts(mesh, 16, 16);
  EXPECT_EQ(f.n_charts, 2u);
  EXPECT_EQ(f.overlaps.size(), 0u);
  EXPECT_EQ(check_charts(mesh, 32, 32).overlaps.size(), 1u);
}

// Two squares at an edge; the second folded back over the first.
TEST(ChartChecks, FoldsAndMirrors) {
  TriMesh mesh = make_squares({{{0.25f, 0.25f}, {0.5f, 0.5f}}, {{0.75f, 0.25f}, {-0.25f, 0.5f}}});
  for (std::size_t v = 4; v < 8; ++v) mesh.positions[v] += glm::vec3(1, 0, -4);
  const ChartFindings f = check_charts(mesh, 32, 32);
  EXPECT_EQ(f.n_charts, 1u);
  EXPECT_EQ(f.n_turned, 2u);
  EXPECT_EQ(f.first_turned, 2u);
  ASSERT_EQ(f.overlaps.size(), 1u);
  EXPECT_EQ(f.overlaps[0].first, f.overlaps[0].second);
  EXPECT_EQ(f.overlaps[0].n_texels, 8u * 16);
  EXPECT_FALSE(f.is_one_to_one());
  ASSERT_EQ(lines(f).size(), 3u);
  EXPECT_EQ(lines(f)[1].find("the chart of triangle 0 lies over itself on 128 texels"), 0u);
  // All of it mirrored is nothing to speak of.
  TriMesh mirrored = make_squares({{{0.75f, 0.25f}, {-0.5f, 0.5f}}});
  EXPECT_EQ(describe(check_charts(mirrored, 32, 32)), "1 chart");
}

TEST(ChartChecks, TellsOvershootFromRepeat) {
  const glm::vec2 half(0.5f);
  const auto check = [](const Square& s) {
    return check_charts(make_squares({{{0.6f, 0.6f}, {0.3f, 0.3f}}, s}), 64, 64);
  };
  const ChartFindings over = check({{-0.05f, 0}, half});
  EXPECT_EQ(over.n_outside, 3u);  // of 6 corners
  EXPECT_EQ(over.n_repeating, 0u);
  EXPECT_TRUE(over.is_one_to_one());
  EXPECT_FLOAT_EQ(static_cast<float>(over.uv_lo.x), -0.05f);
  EXPECT_NE(lines(over)[1].find("a little outside the picture (u -0.05 to 0.9, v 0 to 0.9)"),
            std::string::npos);
  for (const Square& s : {Square{{0, 0}, {1.05f, 0.5f}},  // wider than the picture
                          Square{{-0.2f, 0}, half},       // far out
                          Square{{0, 0.65f}, half},       // far out above
                          Square{{3.7f, 0}, half},        // in two other tiles
                          Square{{-7, 0.3f}, {0.5f, 1.2f}}}) {
    const ChartFindings f = check(s);
    EXPECT_EQ(f.n_repeating, 1u) << s.at.x;
    EXPECT_EQ(f.first_repeating, 2u);
    EXPECT_EQ(f.n_tiny, 0u);
    EXPECT_FALSE(f.is_one_to_one());
  }
  EXPECT_EQ(check({{0, 0}, {1, 0.5f}}).n_outside, 0u);
  EXPECT_EQ(check({{-0.004f, 0}, {1.008f, 0.5f}}).n_repeating, 0u);  // half a texel too wide
  EXPECT_NE(find_obstacle(check({{-0.2f, 0}, half})).find("crosses a side"), std::string::npos);
  EXPECT_NE(find_obstacle(check({{0, 0}, {1.2f, 0.5f}})).find("several places"), std::string::npos);
}

// Each chart alone: in which tile, and that it may be moved there. A tenth may reach out of it.
TEST(ChartChecks, ChartsInOtherTiles) {
  const Square first{{0.6f, 0.6f}, {0.3f, 0.3f}};
  const auto tile = [&](const Square& s) {
    const ChartFindings f = check_charts(make_squares({first, s}), 64, 64);
    EXPECT_EQ(f.n_repeating, 0u);
    EXPECT_EQ(f.n_elsewhere, f.tiles.empty() ? 0u : 1u);
    EXPECT_EQ(f.is_one_to_one(), f.tiles.empty());
    EXPECT_EQ(f.tile, glm::ivec2(0));
    return f.tiles.empty() ? glm::ivec2(0) : f.tiles[2];
  };
  const glm::vec2 half(0.5f);
  EXPECT_EQ(tile({{3.2f, 0}, half}), glm::ivec2(3, 0));
  EXPECT_EQ(tile({{-2, -1}, half}), glm::ivec2(-2, -1));
  EXPECT_EQ(tile({{-2, 5}, {0.5f, 1}}), glm::ivec2(-2, 5));  // from side to side
  EXPECT_EQ(tile({{0, -0.04f}, {0.03f, 0.03f}}), glm::ivec2(0, -1));
  EXPECT_EQ(tile({{1.01f, 0}, {0.03f, 0.03f}}), glm::ivec2(1, 0));
  EXPECT_EQ(tile({{2.95f, 0}, half}), glm::ivec2(3, 0));  // out of it by 0.05
  EXPECT_EQ(tile({{0.55f, 0}, half}), glm::ivec2(0));
  EXPECT_EQ(tile({{0, 0}, half}), glm::ivec2(0));
  // What lies on the same texels once it is moved lies over the other, too.
  const ChartFindings over =
      check_charts(make_squares({first, {{2.6f, 0.6f}, {0.3f, 0.3f}}}), 64, 64);
  EXPECT_EQ(over.overlaps.size(), 1u);
  EXPECT_EQ(over.n_elsewhere, 1u);
  EXPECT_EQ(over.first_elsewhere, 2u);
  EXPECT_NE(find_obstacle(over, true)
                .find("1 chart lies in another tile of the picture, the first "
                      "at triangle 2 in 2, 0"),
            std::string::npos);
}

// The range that is named is that of the chart that repeats, not of all.
TEST(ChartChecks, NamesTheRangeOfTheChartThatRepeats) {
  const ChartFindings f = check_charts(
      make_squares(
          {{{0.6f, 0.6f}, {0.3f, 0.3f}}, {{5, 0}, {0.5f, 0.5f}}, {{0.25f, 0.5f}, {2.5f, 0.25f}}}),
      64, 64);
  EXPECT_NE(find_obstacle(f).find("1 chart wants a picture that repeats, the first at triangle 4 "
                                  "(u 0.25 to 2.75, v 0.5 to 0.75)"),
            std::string::npos)
      << find_obstacle(f);
}

TEST(ChartChecks, AllInAnotherTile) {
  TriMesh cube = make_atlas_cube(3);
  for (glm::vec2& uv : cube.texcoords) uv += glm::vec2(2, -1);
  const ChartFindings f = check_charts(cube, 64, 64);
  EXPECT_EQ(f.tile, glm::ivec2(2, -1));
  EXPECT_EQ(f.n_repeating, 0u);
  EXPECT_EQ(f.n_tiny, 0u);
  EXPECT_TRUE(f.overlaps.empty());
  EXPECT_FALSE(f.is_one_to_one());
  ASSERT_EQ(lines(f).size(), 2u);
  EXPECT_NE(lines(f)[1].find("subtract 2 from u and -1 from v"), std::string::npos);
}

TEST(ChartChecks, FlatTinyAndNotFinite) {
  TriMesh mesh = make_squares({{{0.1f, 0.1f}, {0.5f, 0.5f}},
                               {{0.8f, 0.8f}, {0.1f, 0}},
                               {{0.9f, 0.9f}, {0.001f, 0.001f}},
                               {{0.7f, 0.1f}, {0.2f, 0.2f}}});
  mesh.texcoords[3 * 7 + 1].y = kNan;
  const ChartFindings f = check_charts(mesh, 100, 100);
  EXPECT_EQ(f.n_charts, 4u);
  EXPECT_EQ(f.n_flat, 1u);
  EXPECT_EQ(f.first_flat, 2u);
  EXPECT_EQ(f.n_tiny, 1u);
  EXPECT_EQ(f.n_not_finite, 1u);
  EXPECT_EQ(f.first_not_finite, 7u);
  EXPECT_FALSE(f.is_one_to_one());
  EXPECT_EQ(lines(f).size(), 4u);
}

// Squares of 20 x 20 texels with free columns between them: 1 is crowded, 2 are not.
TEST(ChartChecks, CountsCrowdedTexels) {
  for (const int gap : {0, 1, 2}) {
    const float right = 0.3f + static_cast<float>(gap) / 100;
    const TriMesh mesh =
        make_squares({{{0.1f, 0.1f}, {0.2f, 0.2f}}, {{right, 0.1f}, {0.2f, 0.2f}}});
    const ChartFindings f = check_charts(mesh, 100, 100);
    EXPECT_EQ(f.n_crowded, gap == 0 ? 80u : gap == 1 ? 40u : 0u) << gap;
    TriMesh upright = mesh;
    for (glm::vec2& uv : upright.texcoords) std::swap(uv.x, uv.y);
    EXPECT_EQ(check_charts(upright, 100, 100).n_crowded, f.n_crowded) << gap;
    EXPECT_TRUE(f.is_one_to_one());
  }
}

// Least areas and overshoots that count, from both sides: a ten-thousandth of a texel, 1e-5 of the
// picture.
TEST(ChartChecks, CountFromTheirThresholdsOn) {
  const Square large{{0.2f, 0.2f}, {0.5f, 0.5f}};
  const auto check = [&](const Square& s) {
    return check_charts(make_squares({large, s}), 100, 100);
  };
  EXPECT_EQ(check({{0.8f, 0}, {0.1f, 5e-8f}}).n_flat, 1u);
  EXPECT_EQ(check({{0.8f, 0}, {0.1f, 2e-7f}}).n_flat, 0u);
  EXPECT_EQ(check({{0.8f, 0}, {0.1f, 2e-7f}}).n_tiny, 1u);
  EXPECT_EQ(check({{-5e-6f, 0.75f}, {0.1f, 0.1f}}).n_outside, 0u);
  EXPECT_EQ(check({{-3e-5f, 0.75f}, {0.1f, 0.1f}}).n_outside, 3u);
  EXPECT_EQ(check({{0.9f, 0.75f}, {0.10003f, 0.1f}}).n_outside, 3u);
  EXPECT_EQ(check({{0.9f, 0.75f}, {0.100005f, 0.1f}}).n_outside, 0u);
}

// Of several the first one is named, the largest overlap leads, and texels are summed.
TEST(ChartChecks, SeveralOfAKind) {
  const TriMesh mesh = make_squares({{{0, 0}, {0.25f, 0.25f}},
                                     {{0.8f, 0.8f}, {0.1f, 0}},
                                     {{0.8f, 0.9f}, {0.1f, 0}},
                                     {{0.125f, 0}, {0.25f, 0.25f}},
                                     {{0, 0.5f}, {0.25f, 0.25f}},
                                     {{0.1875f, 0.5f}, {0.25f, 0.25f}},
                                     {{1.9f, 0}, {0.25f, 0.25f}},
                                     {{2.5f, 0}, {2.25f, 0.25f}}});
  const ChartFindings f = check_charts(mesh, 64, 64);
  EXPECT_EQ(f.n_flat, 2u);
  EXPECT_EQ(f.first_flat, 2u);
  EXPECT_EQ(f.n_repeating, 2u);
  EXPECT_EQ(f.first_repeating, 12u);
  ASSERT_EQ(f.overlaps.size(), 2u);
  EXPECT_EQ(f.overlaps[0].n_texels, 8u * 16);
  EXPECT_EQ(f.overlaps[1].n_texels, 4u * 16);
  EXPECT_EQ(f.n_shared, 12u * 16);
  EXPECT_EQ(f.n_overlapped, 4u);
  EXPECT_EQ(f.overlaps[0].first, 0u);
  EXPECT_EQ(f.overlaps[0].second, 6u);
}

// A chart folded into halves has an area, though none is left when turns are counted.
TEST(ChartChecks, FoldedHalvesAreNotFlat) {
  TriMesh mesh = make_squares({{{0.25f, 0.25f}, {0.5f, 0.5f}}, {{0.75f, 0.25f}, {-0.5f, 0.5f}}});
  for (std::size_t v = 4; v < 8; ++v) mesh.positions[v] += glm::vec3(1, 0, -4);
  const ChartFindings f = check_charts(mesh, 32, 32);
  EXPECT_EQ(f.n_charts, 1u);
  EXPECT_EQ(f.n_flat, 0u);
  EXPECT_EQ(f.n_turned, 2u);
}

// Single precision has no texels that far out: such a mesh is not moved back, and repeats.
TEST(ChartChecks, FarTilesAreNone) {
  for (const float tile : {1000.0f, 4e6f}) {
    const ChartFindings f = check_charts(make_squares({{{tile, 0}, {0.5f, 0.5f}}}), 64, 64);
    EXPECT_EQ(f.tile.x, tile < 1e6f ? 1000 : 0);
    EXPECT_EQ(f.n_repeating, tile < 1e6f ? 0u : 1u);
  }
}

// What no texture can follow, and what it can though it is not as it should be.
TEST(ChartChecks, Obstacles) {
  const auto obstacle = [](const TriMesh& mesh, bool allows_overlap = false) {
    return find_obstacle(check_charts(mesh, 64, 64), allows_overlap);
  };
  const Square good{{0.1f, 0.1f}, {0.3f, 0.3f}};
  TriMesh mesh = make_squares({good});
  EXPECT_EQ(obstacle(mesh), "");
  mesh.texcoords[1].y = kNan;
  EXPECT_NE(obstacle(mesh, true).find("no numbers, the first is triangle 0"), std::string::npos);
  EXPECT_NE(obstacle(make_squares({{{2, 3}, {0.5f, 0.5f}}}), true).find("subtract 2 from u and 3"),
            std::string::npos);
  EXPECT_NE(obstacle(make_squares({good, {{0.5f, 0.5f}, {0.3f, 2}}}), true).find("repeats"),
            std::string::npos);
  const TriMesh two = make_squares({good, {{0.2f, 0.1f}, {0.3f, 0.3f}}});
  EXPECT_NE(obstacle(two).find("lie over one another"), std::string::npos);
  EXPECT_EQ(obstacle(two, true), "");
  TriMesh fold = make_squares({{{0.25f, 0.25f}, {0.5f, 0.5f}}, {{0.75f, 0.25f}, {-0.25f, 0.5f}}});
  for (std::size_t v = 4; v < 8; ++v) fold.positions[v] += glm::vec3(1, 0, -4);
  EXPECT_EQ(obstacle(fold), "");
  EXPECT_EQ(obstacle(make_squares({good, {{-0.05f, 0.5f}, {0.3f, 0.3f}}})), "");
}

void expect_charts(const TriMesh& mesh, std::size_t n_charts, bool is_one_to_one) {
  const ChartFindings f = check_charts(mesh, 1024, 1024);
  EXPECT_EQ(f.n_charts, n_charts);
  EXPECT_EQ(f.is_one_to_one(), is_one_to_one) << describe(f);
}

// A figure in six gores, and each thing that makes a picture unfit, with what is found: two gores
// on one place, one gore folded, another tile, a picture that repeats. What lies a little outside
// does not.
TEST(ChartChecks, FiguresInGores) {
  const auto changed = [](const auto& change) {
    TriMesh mesh = make_gored_figure(30, 6);
    for (glm::vec2& uv : mesh.texcoords) change(uv);
    return mesh;
  };
  expect_charts(make_gored_figure(30, 1), 1, true);
  expect_charts(changed([](glm::vec2&) {}), 6, true);
  expect_charts(changed([](glm::vec2& uv) { uv.y += 0.07f; }), 6, true);
  const auto found = [&changed](const auto& change) {
    const TriMesh mesh = changed(change);
    expect_charts(mesh, 6, false);
    return check_charts(mesh, 1024, 1024);
  };
  constexpr std::size_t kPerGore = 2 * 29 * 10;  // triangles
  const ChartFindings twice = found([](glm::vec2& uv) { uv.x -= uv.x > 5 / 6.0f ? 2 / 6.0f : 0; });
  ASSERT_EQ(twice.overlaps.size(), 1u);
  EXPECT_EQ(twice.overlaps[0].first, 3 * kPerGore);
  EXPECT_EQ(twice.overlaps[0].second, 5 * kPerGore);
  const ChartFindings folded = found([](glm::vec2& uv) { uv.x = std::max(uv.x, 1 / 6.0f - uv.x); });
  ASSERT_EQ(folded.overlaps.size(), 1u);
  EXPECT_EQ(folded.overlaps[0].first, 0u);
  EXPECT_EQ(folded.overlaps[0].second, 0u);
  EXPECT_EQ(folded.n_turned, kPerGore / 2);
  EXPECT_EQ(found([](glm::vec2& uv) { uv += glm::vec2(3, -2); }).tile, glm::ivec2(3, -2));
  EXPECT_EQ(found([](glm::vec2& uv) { uv.y *= 3; }).n_repeating, 6u);
}

// What is known of real models: their charts, and what looking at their charts' map shows.
TEST(OutsideChartChecks, RealModels) {
  struct Expected {
    const char* file;
    std::size_t n_charts;
    bool is_one_to_one;
  };
  constexpr Expected kModels[] = {
      {"cyberhead-josie/josie.obj", 1, true},
      {"spot-6k/spot_triangulated.obj", 13, true},  // a little outside
      {"blub-14k/blub_triangulated.obj", 5, true},
      {"head-leeperrysmith-18k/LeePerrySmith.glb", 11, false},  // eyes folded
      {"egyptian-cat-5k/cat.glb", 29, true},
      {"horse-7k/horse.3ds", 1, false},                     // both sides on one picture
      {"damagedhelmet-15k/DamagedHelmet.glb", 478, false},  // another tile, two layers
      {"texturedknot-3k/texturedknot.obj", 1, false},       // repeats
  };
  const std::filesystem::path folder = VIEWCELL_SHARED_DATA;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  for (const Expected& expected : kModels) {
    SCOPED_TRACE(expected.file);
    expect_charts(read_mesh(folder / expected.file), expected.n_charts, expected.is_one_to_one);
  }
}

}  // namespace
}  // namespace viewcell

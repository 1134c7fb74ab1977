#include "adapt/gl_texture_adapt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "adapt/bump.h"
#include "adapt/texel_owners.h"
#include "gl/context.h"
#include "image/chart_reach.h"
#include "pm/build.h"
#include "pm/shapes.h"

namespace viewcell {
namespace {

constexpr int kGlSize = 256;

const Gl& gl() {
  static GlContext context(GlEngine::kOsmesa);
  context.make_current();
  return context.gl();
}

// A bump over the unit square, with a texture that is the view from above, in waves so that borders
// move with collapses; or with two charts that split it at x = 1/2 and lie a few texels apart.
TriMesh make_wavy_bump(bool is_split, float half_gap) {
  TriMesh grid = make_bare_bump(0.4f);
  for (const Triangle& t : grid.triangles) {
    float middle = 0;
    for (const std::uint32_t v : t) middle += grid.positions[v].x / 3;
    const float gap = is_split ? (middle < 0.5f ? -half_gap : half_gap) : 0;
    for (const std::uint32_t v : t) {
      const float x = grid.positions[v].x, y = grid.positions[v].y;
      grid.texcoords.emplace_back(0.1f + 0.8f * x + 0.01f * std::sin(14 * y) + gap,
                                  0.1f + 0.8f * y + 0.01f * std::sin(14 * x));
    }
  }
  return grid;
}

// A progressive mesh of the bump, and its log.
struct Levels {
  ProgressiveMesh mesh;
  AdaptationLog log;

  // half_gap: of the texture, between the charts.
  explicit Levels(bool is_split, float half_gap = 0.01f)
      : Levels(build(make_wavy_bump(is_split, half_gap), 40)) {}
  explicit Levels(const TriMesh& input) : Levels(build(input, 2)) {}
  LevelCharts charts(std::size_t n_collapsed) {
    mesh.set_level(mesh.n_splits() - n_collapsed);
    return make_level_charts(mesh, log);
  }

 private:
  explicit Levels(const BuildResult& built)
      : mesh(built.record), log(make_adaptation_log(built.record)) {}
  static BuildResult build(const TriMesh& input, std::size_t n_faces) {
    BuildOptions options;
    options.metric = MetricKind::mapping;
    options.target_faces = n_faces;
    return build_progressive_mesh(input, options);
  }
};

double distance_texels(const glm::vec2& a, const glm::vec2& b) {
  return kGlSize * glm::distance(a, b);
}

// How far two maps are apart: charts, gutters and what no one touched.
struct Difference {
  std::size_t n = 0, n_over_hundredth = 0, n_over_half = 0;
  double worst = 0;

  void add(const IndexMap& a, const IndexMap& b) {
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
      const double d = distance_texels(a.pixels[i], b.pixels[i]);
      ++n, n_over_hundredth += d > 0.01, n_over_half += d > 0.5;
      worst = std::max(worst, d);
    }
  }
};

template <typename Texel>
std::size_t n_other_owners(const TextureAdapter<Texel>& cpu, const GlTextureAdapter<Texel>& drawn) {
  const Image<std::uint16_t> owners = drawn.owners();
  std::size_t n = 0;
  for (std::size_t i = 0; i < owners.pixels.size(); ++i)
    n += cpu.is_inside(i) != ((owners.pixels[i] & kInsideChart) != 0);
  return n;
}

IndexMap start_map() {
  return make_index_map<glm::vec2>(kGlSize, kGlSize);
}

class GlTextureAdapterOf : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Charts, GlTextureAdapterOf, testing::Values(false, true),
                         [](const auto& charts) { return charts.param ? "Two" : "One"; });

// Single collapses and splits, each from the same map and charts. 1/255 of the map's range would be
// a texel; 0.013 were found.
TEST_P(GlTextureAdapterOf, EachAdaptationIsTheEngines) {
  Levels bump(GetParam(), 0.004f);  // two texels: samples must tell charts apart
  const std::size_t n = bump.log.n_collapses();
  TextureAdapter<glm::vec2> walk(bump.log, start_map(), bump.charts(0));
  for (std::size_t i = 5; i + 1 < n; i += n / 12)
    for (const std::size_t to : {i + 1, i - 1}) {
      walk.go_to(i);
      TextureAdapter<glm::vec2> cpu(bump.log, walk.image(), bump.charts(i), i);
      GlTextureAdapter<glm::vec2> drawn(gl(), bump.log, walk.image(), bump.charts(i), i);
      cpu.go_to(to), drawn.go_to(to);
      EXPECT_EQ(drawn.n_collapsed(), to);
      EXPECT_EQ(drawn.counts().n_adaptations, cpu.counts().n_adaptations);
      // Gutters of charts so near to one another are either's.
      const IndexMap a = cpu.image(), b = drawn.image();
      for (std::size_t k = 0; k < a.pixels.size(); ++k)
        ASSERT_LT(distance_texels(a.pixels[k], b.pixels[k]), cpu.is_inside(k) ? 0.05 : 1.0)
            << i << " to " << to << ": " << k;
      EXPECT_EQ(n_other_owners(cpu, drawn), 0u) << i << " to " << to;
    }
}

// Texels on edges between cells may differ a little, and what is made of them later.
TEST_P(GlTextureAdapterOf, WholeRunsAgree) {
  Levels bump(GetParam());
  const std::size_t n = bump.log.n_collapses();
  TextureAdapter<glm::vec2> cpu(bump.log, start_map(), bump.charts(0));
  GlTextureAdapter<glm::vec2> drawn(gl(), bump.log, start_map(), bump.charts(0));
  for (const std::size_t to : {n, n / 3, std::size_t(0)}) {
    cpu.go_to(to), drawn.go_to(to);
    Difference difference;
    difference.add(cpu.image(), drawn.image());
    EXPECT_LT(1000 * difference.n_over_hundredth, difference.n) << to;
    EXPECT_LT(10000 * difference.n_over_half, difference.n) << to;
    EXPECT_LT(10000 * n_other_owners(cpu, drawn), difference.n) << to;
  }
  // The whole way back is exact but for texels on borders, which one engine may take for gutters.
  const IndexMap start = start_map(), back = drawn.image();
  std::size_t n_inside = 0, n_off = 0;
  for (std::size_t i = 0; i < start.pixels.size(); ++i) {
    if (!cpu.is_inside(i)) continue;
    ++n_inside, n_off += start.pixels[i] != back.pixels[i];
    ASSERT_LT(distance_texels(start.pixels[i], back.pixels[i]), 0.5) << i;
  }
  EXPECT_LT(10000 * n_off, n_inside);
  EXPECT_EQ(cpu.counts().n_conflicts, 0u);
  EXPECT_LT(3 * drawn.counts().n_packs, drawn.counts().n_adaptations);
}

// One by one, in steps, in small uploads, copied as boxes and by drawing: the same bits.
TEST_P(GlTextureAdapterOf, PacksStepsAndUploadsChangeNothing) {
  Levels bump(GetParam());
  const std::size_t n = bump.log.n_collapses();
  const LevelCharts charts = bump.charts(0);
  const auto make = [&](const GlAdaptOptions& options) {
    return GlTextureAdapter<glm::vec2>(gl(), bump.log, start_map(), charts, 0, options);
  };
  auto packed = make({.copies_boxes = true}), drawn = make({.copies_boxes = false});
  auto one = make({.pack = false, .copies_boxes = true});
  auto steps = make({.copies_boxes = false, .batch_bytes = 5000});
  for (const std::size_t level : {n, n / 3}) {
    packed.go_to(level), drawn.go_to(level), one.go_to(level);
    steps.go_to(n / 2), steps.go_to(level), steps.go_to(level);
    EXPECT_EQ(packed.image().pixels, drawn.image().pixels);
    EXPECT_EQ(packed.owners().pixels, drawn.owners().pixels);
    EXPECT_EQ(packed.image().pixels, one.image().pixels);
    EXPECT_EQ(packed.image().pixels, steps.image().pixels);
    EXPECT_EQ(packed.owners().pixels, one.owners().pixels);
    EXPECT_EQ(packed.owners().pixels, steps.owners().pixels);
  }
  EXPECT_EQ(one.counts().n_packs, one.counts().n_adaptations);
  EXPECT_EQ(packed.counts().n_adaptations, one.counts().n_adaptations);
  EXPECT_LT(packed.counts().n_bytes, drawn.counts().n_bytes);
}

// Both engines over whole runs; the parts of channels that differ by more than `near`.
template <typename Texel, typename Channels>
void expect_near(const Image<Texel>& start, Channels&& channels, double near) {
  Levels bump(true);
  const std::size_t n = bump.log.n_collapses();
  TextureAdapter<Texel> cpu(bump.log, start, bump.charts(0));
  GlTextureAdapter<Texel> drawn(gl(), bump.log, start, bump.charts(0));
  for (const std::size_t to : {n, n / 3}) {
    cpu.go_to(to), drawn.go_to(to);
    const Image<Texel> a = cpu.image(), b = drawn.image();
    std::size_t n_far = 0, n_changed = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
      const auto p = channels(a.pixels[i]), q = channels(b.pixels[i]),
                 s = channels(start.pixels[i]);
      for (std::size_t k = 0; k < p.size(); ++k)
        n_far += std::abs(double(p[k]) - double(q[k])) > near, n_changed += p[k] != s[k];
    }
    EXPECT_GT(n_changed, to == n ? a.pixels.size() / 10 : 100);
    EXPECT_LT(1000 * n_far, a.pixels.size()) << to;
  }
}

TEST(GlTextureAdapter, WholeNumbersAgree) {
  const auto uv = [](const auto& texel) { return texel.uv; };
  expect_near(make_index_map<Unorm16Texel>(kGlSize, kGlSize), uv, 2);
  expect_near(make_index_map<Unorm8Texel>(kGlSize, kGlSize), uv, 1);
}

TEST(GlTextureAdapter, HalfFloatsAgree) {
  expect_near(
      make_index_map<HalfTexel>(kGlSize, kGlSize), [](const HalfTexel& texel) { return texel.uv; },
      2);
}

TEST(GlTextureAdapter, ColoursAgree) {
  ImageRgba8 texture(kGlSize, kGlSize);
  for (int y = 0; y < kGlSize; ++y)
    for (int x = 0; x < kGlSize; ++x)
      for (std::size_t k = 0; k < 4; ++k) {
        const double wave = std::sin(0.11 * x + double(k)) * std::cos(0.07 * y - double(k));
        texture.at(x, y)[k] = static_cast<std::uint8_t>(127 + 120 * wave);
      }
  expect_near(
      texture, [](const Rgba8& texel) { return texel; }, 1);
}

// Drawers rely on the state that a context starts with.
TEST(GlTextureAdapter, LeavesGlAsItWas) {
  Levels bump(false);
  GlTextureAdapter<glm::vec2> drawn(gl(), bump.log, start_map(), bump.charts(0));
  drawn.go_to(40);
  for (const GLenum state : {GL_DEPTH_TEST, GL_CULL_FACE}) {
    GLint value = 0;
    gl().GetIntegerv(state, &value);
    EXPECT_EQ(value, 1) << state;
  }
  std::array<GLint, 4> writes{};
  gl().GetIntegerv(GL_COLOR_WRITEMASK, writes.data());
  EXPECT_EQ(writes, (std::array<GLint, 4>{1, 1, 1, 1}));
}

// A chart of a square, from 4 to 12 texels, whose corners lie between texels.
TEST(TexelOwners, AreChartsAndGuttersAround) {
  const auto uv = [](float x, float y) { return glm::vec2(x / 16, 1 - y / 16); };
  LevelCharts charts;
  charts.faces = {{uv(4, 4), uv(12, 4), uv(12, 12)}, {uv(4, 4), uv(12, 12), uv(4, 12)}};
  charts.charts = {6, 6};
  const Image<std::uint16_t> owners = make_texel_owners(charts, 16, 16);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const int out = std::max({4 - x, x - 11, 4 - y, y - 11});
      ASSERT_EQ(owners.at(x, y), out <= 0 ? kInsideChart | 7 : (out <= kGutter ? 7 : 0))
          << x << "," << y;
    }
}

TEST(OwnerTiles, TellOthersNearby) {
  Image<std::uint16_t> owners(32, 32);
  owners.at(3, 3) = kInsideChart | 2;
  OwnerTiles tiles(owners);
  EXPECT_FALSE(tiles.has_others({0, 0}, {31, 31}, 2));
  EXPECT_TRUE(tiles.has_others({0, 0}, {31, 31}, 1));
  EXPECT_FALSE(tiles.has_others({8, 8}, {31, 31}, 1));
  tiles.mark({-5, 20}, {3, 40}, 1);
  EXPECT_TRUE(tiles.has_others({-9, -9}, {90, 90}, 2));
  EXPECT_FALSE(tiles.has_others({8, 8}, {90, 90}, 2));
}

// A grid of squares with waves, all over a texture, to half of its collapses; in turn, best of
// four, for other tests may run beside.
void print_times(int n_squares) {
  TriMesh grid = make_flat_grid(n_squares);
  for (glm::vec3& p : grid.positions) {
    p /= static_cast<float>(n_squares);
    p.z = 0.1f * std::sin(12.566f * p.x) * std::sin(18.85f * p.y);
  }
  for (const Triangle& t : grid.triangles)
    for (const std::uint32_t v : t)
      grid.texcoords.emplace_back(0.01f + 0.98f * grid.positions[v].x,
                                  0.01f + 0.98f * grid.positions[v].y);
  Levels levels(grid);
  const std::size_t n = levels.log.n_collapses() / 2;
  const LevelCharts charts = levels.charts(0);
  const IndexMap start = make_index_map<glm::vec2>(1024, 1024);
  TextureAdapter<glm::vec2> cpu(levels.log, start, charts);
  GlTextureAdapter<glm::vec2> packed(gl(), levels.log, start, charts);
  GlTextureAdapter<glm::vec2> one(gl(), levels.log, start, charts, 0, {.pack = false});
  double cpu_us = 1e30, packed_us = 1e30, one_us = 1e30;
  const auto time = [&](auto& adapter, double& best_us) {
    const auto begin = std::chrono::steady_clock::now();
    adapter.go_to(n);
    gl().Finish();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    best_us = std::min(best_us, 1e6 * taken.count() / static_cast<double>(n));
    adapter.go_to(0);
    gl().Finish();
  };
  for (int k = 0; k < 4; ++k) time(cpu, cpu_us), time(packed, packed_us), time(one, one_us);
  std::printf("%d x %d: us an adaptation: %.2f by GL, %.2f one by one, %.2f by the processor\n",
              n_squares, n_squares, packed_us, one_us, cpu_us);
  EXPECT_LT(packed_us, one_us);
}

TEST(SlowGlTextureAdapter, Times) {
  print_times(62);
  print_times(187);
}

}  // namespace
}  // namespace viewcell

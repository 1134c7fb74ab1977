#include "adapt/adapt_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adapt/resolve_index_map.h"
#include "base/error.h"
#include "pm/build.h"
#include "pm/shapes.h"

namespace viewcell {
namespace {

constexpr int kLevelWidth = 96, kLevelHeight = 64;

// A progressive mesh of a bump that fills most of the texture, and its log.
struct Bump {
  ProgressiveRecord record;
  AdaptationLog log;
  ImageRgba8 texture;

  Bump() : texture(kLevelWidth, kLevelHeight) {
    TriMesh grid = make_flat_grid(12);
    for (glm::vec3& p : grid.positions) {
      const float x = p.x / 12 - 0.5f, y = p.y / 12 - 0.5f;
      p = {p.x / 12, p.y / 12, 0.4f * std::exp(-12 * (x * x + y * y))};
    }
    for (const Triangle& t : grid.triangles)
      for (const std::uint32_t v : t) grid.texcoords.push_back(wavy(grid.positions[v]));
    BuildOptions options;
    options.metric = MetricKind::mapping;
    record = build_progressive_mesh(grid, options).record;
    log = make_adaptation_log(record);
    for (int y = 0; y < kLevelHeight; ++y)
      for (int x = 0; x < kLevelWidth; ++x)
        texture.at(x, y) = {static_cast<std::uint8_t>(2 * x), static_cast<std::uint8_t>(3 * y),
                            static_cast<std::uint8_t>((x / 8 + y / 8) % 2 * 200), 255};
  }
  // A border that collapses straighten.
  static glm::vec2 wavy(const glm::vec3& p) {
    return {0.1f + 0.8f * p.x + 0.02f * std::sin(14 * p.y),
            0.1f + 0.8f * p.y + 0.02f * std::sin(14 * p.x)};
  }
  AdaptLevels levels(const AdaptLevelsOptions& options = {}) const {
    return {record, log, texture, options};
  }
};

// Root of the mean squared distance, texels.
double distance(const IndexMap& a, const IndexMap& b) {
  EXPECT_EQ(a.width_px, b.width_px);
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::vec2 apart = (a.pixels[i] - b.pixels[i]) * glm::vec2(a.width_px, a.height_px);
    sum += glm::dot(apart, apart);
  }
  return std::sqrt(sum / double(a.pixels.size()));
}

TEST(AdaptLevels, GoThereAndBack) {
  const Bump bump;
  AdaptLevels levels = bump.levels();
  EXPECT_EQ(levels.n_collapsed(), 0u);
  EXPECT_EQ(levels.bake().pixels, bump.texture.pixels);
  levels.set_faces(60);
  EXPECT_LE(levels.mesh().n_faces(), 60u);
  EXPECT_EQ(levels.n_collapsed(), levels.mesh().n_splits() - levels.mesh().level());
  EXPECT_EQ(levels.charts().faces.size(), levels.mesh().n_faces());
  EXPECT_EQ(levels.finest().faces.size(), 288u);
  EXPECT_LE(levels.counts().n_adaptations, levels.n_collapsed());
  EXPECT_GT(10 * levels.counts().n_adaptations, 9 * levels.n_collapsed());
  const IndexMap map = levels.map();
  EXPECT_EQ(map.width_px, kLevelWidth);
  EXPECT_EQ(map.height_px, kLevelHeight);
  EXPECT_NE(levels.bake().pixels, bump.texture.pixels);
  EXPECT_EQ(levels.bake().pixels, levels.bake(bump.texture).pixels);
  EXPECT_EQ(levels.bake().pixels,
            resolve_index_map(map, bump.texture, levels.finest(), levels.charts()).pixels);
  levels.set_faces(1000);
  EXPECT_EQ(levels.n_collapsed(), 0u);
  EXPECT_EQ(levels.bake().pixels, bump.texture.pixels);
}

// Of the last level the map may be taken; what made it is gone then.
TEST(AdaptLevels, TheLastMapMayBeTaken) {
  const Bump bump;
  AdaptLevels levels = bump.levels();
  levels.set_faces(60);
  const IndexMap map = levels.map();
  const ImageRgba8 picture = levels.bake();
  const std::size_t n_adaptations = levels.counts().n_adaptations;
  const IndexMap taken = levels.take_map();
  EXPECT_EQ(taken.pixels, map.pixels);
  EXPECT_EQ(levels.bake(bump.texture, taken).pixels, picture.pixels);
  EXPECT_EQ(levels.counts().n_adaptations, n_adaptations);
  EXPECT_THROW(levels.set_faces(100), BugError);
}

// A map that another run has left off at goes on as if it had been one run.
TEST(AdaptLevels, StartWhereAnotherStopped) {
  const Bump bump;
  AdaptLevels whole = bump.levels();
  whole.set_faces(120);
  AdaptLevelsOptions options;
  options.start = whole.map(), options.start_faces = 120;
  AdaptLevels rest = bump.levels(options);
  EXPECT_EQ(rest.n_collapsed(), whole.n_collapsed());
  EXPECT_EQ(rest.map().pixels, whole.map().pixels);
  whole.set_faces(100), rest.set_faces(100);
  EXPECT_LT(distance(whole.map(), rest.map()), 0.1);
  EXPECT_EQ(whole.charts().faces, rest.charts().faces);
  options.width_px = kLevelWidth / 2;
  EXPECT_THROW(bump.levels(options), UsageError);
  options.width_px = 0, options.height_px = kLevelHeight + 1;
  EXPECT_THROW(bump.levels(options), UsageError);
}

// A small pyramid with a chart beside the bump's vanishes, stays in the map, and comes back, also
// where the map starts without it.
TEST(AdaptLevels, PiecesVanishAndComeBack) {
  Bump bump;
  TriMesh grid = make_finest(bump.record).extract();
  for (glm::vec2& uv : grid.texcoords) uv.x *= 0.8f;
  const auto n = static_cast<std::uint32_t>(grid.positions.size());
  const std::vector<glm::vec2> places{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}};
  for (const glm::vec2& p : places)
    grid.positions.emplace_back(0.01f * p, p == glm::vec2(1) ? 0.61f : 0.6f);
  for (std::uint32_t k = 0; k < 4; ++k) {
    grid.triangles.push_back({n + k, n + (k + 1) % 4, n + 4});
    for (const std::uint32_t v : grid.triangles.back())
      if (v >= n) grid.texcoords.push_back(glm::vec2(0.84f, 0.2f) + 0.07f * places[v - n]);
  }
  for (const MetricKind metric : {MetricKind::mapping, MetricKind::qem3})
    for (const Placement placement : {Placement::half, Placement::full}) {
      BuildOptions options;
      options.metric = metric, options.placement = placement;
      bump.record = build_progressive_mesh(grid, options).record;
      bump.log = make_adaptation_log(bump.record);
      ASSERT_EQ(count_vanishing_pieces(bump.record), 1u);
      AdaptLevels levels = bump.levels();
      const auto has_piece = [](const AdaptLevels& at) { return at.mesh().n_vanished() == 0; };
      const ImageRgba8 whole = levels.bake();
      levels.set_faces(1);
      ASSERT_FALSE(has_piece(levels));
      AdaptLevelsOptions from;
      from.start = levels.map(), from.start_faces = levels.mesh().n_faces();
      AdaptLevels rest = bump.levels(from);
      std::size_t n_faces = 1;
      while (!has_piece(rest)) rest.set_faces(++n_faces);
      levels.set_faces(100000);
      // All texels of its chart, which no others come near, show themselves as at the input.
      for (const ImageRgba8& picture : {rest.bake(), levels.bake()})
        for (int y = 15; y < 20; ++y)
          for (int x = 84; x < 90; ++x)
            EXPECT_EQ(picture.at(x, y), whole.at(x, y)) << x << " " << y;
    }
}

// Maps of less precision are near, each as near as it can be, and none is another.
TEST(AdaptLevels, KindsOfTexelsDiffer) {
  const Bump bump;
  const auto map_of = [&](const char* name) {
    AdaptLevelsOptions options;
    options.texel = parse_texel_kind(name);
    AdaptLevels levels = bump.levels(options);
    levels.set_faces(80);
    return levels.map();
  };
  const IndexMap exact = map_of("float");
  const double half = distance(map_of("half"), exact), bits16 = distance(map_of("16"), exact),
               bits8 = distance(map_of("8"), exact);
  EXPECT_GT(bits16, 1e-6);
  EXPECT_GT(half, 3 * bits16);
  EXPECT_GT(bits8, 3 * half);
  EXPECT_LT(bits8, 1);
  EXPECT_THROW(parse_texel_kind("float16"), UsageError);
  AdaptLevelsOptions options;
  options.texel = parse_texel_kind("texture");
  AdaptLevels levels = bump.levels(options);
  levels.set_faces(80);
  const ImageRgba8 texture = levels.bake();
  EXPECT_EQ(texture.width_px, kLevelWidth);
  EXPECT_NE(texture.pixels, bump.texture.pixels);
}

TEST(AdaptLevels, OptionsReachTheAdapter) {
  const Bump bump;
  AdaptLevelsOptions options;
  options.adapt.pack = false, options.width_px = 40, options.height_px = 30;
  AdaptLevels one = bump.levels(options), packed = bump.levels();
  one.set_faces(60), packed.set_faces(60);
  EXPECT_EQ(one.counts().n_packs, one.counts().n_adaptations);
  EXPECT_LT(packed.counts().n_packs, packed.counts().n_adaptations);
  EXPECT_GT(packed.counts().n_texels, 1000u);
  EXPECT_EQ(one.map().width_px, 40);
  EXPECT_EQ(one.bake().height_px, 30);
}

}  // namespace
}  // namespace viewcell

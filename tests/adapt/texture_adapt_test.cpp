#include "adapt/texture_adapt.h"

#include <gtest/gtest.h>

#include <cmath>

#include "adapt/bump.h"
#include "adapt/resolve_index_map.h"
#include "common/same_every_time.h"
#include "mesh/closest_point.h"
#include "pm/build.h"

namespace viewcell {
namespace {

// A progressive mesh, its log, and a map that follows it from the finest level on.
struct Adapted {
  ProgressiveMesh mesh;
  AdaptationLog log;
  TextureAdapter<glm::vec2> adapter;

  Adapted(const BuildResult& built, int size_px, const AdaptOptions& options = {})
      : mesh(at_finest(built)),
        log(make_adaptation_log(built.record)),
        adapter(log, make_index_map<glm::vec2>(size_px, size_px), make_level_charts(mesh, log), 0,
                options) {}
  static ProgressiveMesh at_finest(const BuildResult& built) {
    ProgressiveMesh out(built.record);
    out.set_level(out.n_splits());
    return out;
  }
};

BuildResult build(const TriMesh& mesh, std::size_t n_faces) {
  BuildOptions options;
  options.metric = MetricKind::mapping;
  options.target_faces = n_faces;
  return build_progressive_mesh(mesh, options);
}

TEST(IndexMap, HoldsItsOwnPlaces) {
  const IndexMap map = make_index_map<glm::vec2>(4, 2);
  EXPECT_EQ(map.at(0, 0), glm::vec2(0.125f, 0.75f));
  EXPECT_EQ(map.at(3, 1), glm::vec2(0.875f, 0.25f));
}

TEST(TextureAdapter, FlatMeshesKeepEveryTexel) {
  Adapted flat(build(make_bump(0), 6), 128);
  const IndexMap start = flat.adapter.image();
  flat.adapter.go_to(flat.log.n_collapses());
  EXPECT_GT(flat.adapter.counts().n_texels, 20000u);
  const IndexMap map = flat.adapter.image();
  for (std::size_t i = 0; i < map.pixels.size(); ++i)
    ASSERT_LT(128 * glm::distance(map.pixels[i], start.pixels[i]), 0.01f) << i;
}

// On a plane every point shows what it showed before, though full-edge collapses move vertices and
// give them texture coordinates that are no affine map of the plane any more.
TEST(TextureAdapter, FlatMeshesShowTheSameUnderFullEdgeCollapses) {
  BuildOptions options;
  options.metric = MetricKind::mapping;
  options.placement = Placement::full;
  options.target_faces = 40;
  Adapted flat(build_progressive_mesh(make_bump(0), options), 256);
  flat.adapter.go_to(flat.log.n_collapses());
  EXPECT_EQ(flat.log.n_folded + flat.log.n_unmapped, 0u);
  flat.mesh.set_level(0);
  const TriMesh coarse = flat.mesh.extract();
  const IndexMap map = flat.adapter.image();
  double moved = 0;
  for (std::size_t t = 0; t < coarse.triangles.size(); ++t) {
    glm::vec3 p(0);
    glm::vec2 uv(0);
    for (std::size_t k = 0; k < 3; ++k) {
      p += coarse.positions[coarse.triangles[t][k]] / 3.0f;
      uv += coarse.texcoords[3 * t + k] / 3.0f;
    }
    const glm::vec2 wanted(0.1f + 0.8f * p.x, 0.1f + 0.8f * p.y);
    moved = std::max<double>(moved, 256 * glm::distance(uv, wanted));
    const auto x = static_cast<int>(uv.x * 256), y = static_cast<int>((1 - uv.y) * 256);
    EXPECT_LT(256 * glm::distance(map.at(x, y), wanted), 1.5) << t;  // nearest texel
  }
  EXPECT_GT(moved, 3);
}

// All the way back every texel of the chart is as it was, to the bit, and so is what no gutter
// touched.
TEST(TextureAdapter, TheWholeWayBackIsExact) {
  Adapted bump(build(make_bump(0.4f), 60), 256);
  const IndexMap start = bump.adapter.image();
  bump.adapter.go_to(bump.log.n_collapses());
  const IndexMap coarse = bump.adapter.image();
  bump.adapter.go_to(0);
  const IndexMap back = bump.adapter.image();
  std::size_t n_moved = 0;
  for (std::size_t i = 0; i < start.pixels.size(); ++i) {
    n_moved += 256 * glm::distance(coarse.pixels[i], start.pixels[i]) > 1;
    if (bump.adapter.is_inside(i)) {
      ASSERT_EQ(back.pixels[i], start.pixels[i]) << i;
    }
    ASSERT_LT(256 * glm::distance(back.pixels[i], start.pixels[i]), 0.5f) << i;
  }
  EXPECT_GT(n_moved, 2000u);
  EXPECT_EQ(back.at(5, 5), start.at(5, 5));
}

// One collapse there and back, on a map that has come some way: untouched texels keep their bits,
// the others come back to within half a texel.
TEST(TextureAdapter, OneSplitUndoesOneCollapse) {
  Adapted bump(build(make_bump(0.4f), 60), 256);
  const std::size_t n = bump.log.n_collapses();
  std::size_t n_touched = 0;
  double worst = 0;
  for (std::size_t i = n / 2; i < n / 2 + 40; ++i) {
    bump.adapter.go_to(i);
    const IndexMap start = bump.adapter.image();
    bump.adapter.go_to(i + 1);
    const IndexMap there = bump.adapter.image();
    bump.adapter.go_to(i);
    const IndexMap back = bump.adapter.image();
    for (std::size_t k = 0; k < start.pixels.size(); ++k) {
      if (there.pixels[k] == start.pixels[k] && back.pixels[k] == start.pixels[k]) continue;
      ++n_touched;
      if (bump.adapter.is_inside(k))
        worst = std::max<double>(worst, 256 * glm::distance(back.pixels[k], start.pixels[k]));
    }
    EXPECT_LT(n_touched, (i + 1 - n / 2) * start.pixels.size() / 8);
  }
  EXPECT_GT(n_touched, 1000u);
  EXPECT_LT(worst, 0.5);
}

// The same bytes for any number of threads, side by side or one by one.
TEST(TextureAdapter, ThreadsAndPacksChangeNothing) {
  const BuildResult built = build(make_bump(0.4f), 60);
  for (const int n_threads : kThreadCounts) {
    SCOPED_TRACE(n_threads);
    Adapted one(built, 256, {.n_threads = 1, .pack = false});
    Adapted packed(built, 256, {.n_threads = n_threads});
    for (const std::size_t level : {one.log.n_collapses(), one.log.n_collapses() / 3}) {
      one.adapter.go_to(level), packed.adapter.go_to(level);
      EXPECT_EQ(one.adapter.image().pixels, packed.adapter.image().pixels);
    }
    EXPECT_GT(one.adapter.counts().n_adaptations, 0u);
    EXPECT_EQ(one.adapter.counts().n_adaptations, packed.adapter.counts().n_adaptations);
    EXPECT_EQ(one.adapter.counts().n_texels, packed.adapter.counts().n_texels);
    EXPECT_EQ(one.adapter.counts().n_packs, one.adapter.counts().n_adaptations);
    EXPECT_LT(3 * packed.adapter.counts().n_packs, one.adapter.counts().n_packs);
  }
}

// With the adapted map a point of the coarse mesh shows what is nearest to it on the input better
// than without. The texture's u and v are x and y, so the map tells directly.
TEST(TextureAdapter, TextureStaysWhereItWas) {
  const TriMesh bump = make_bump(0.4f);
  const BuildResult built = build(bump, 60);
  const AdaptationLog log = make_adaptation_log(built.record);
  Adapted adapted(built, 512);
  adapted.adapter.go_to(log.n_collapses());
  const IndexMap map = adapted.adapter.image();
  const ProgressiveMesh pm(built.record);
  const TriMesh coarse = pm.extract();
  const ClosestPointFinder finder(bump, {glm::dvec3(-1), glm::dvec3(2)}, 1);
  double with = 0, without = 0;
  std::size_t n = 0;
  for (std::size_t t = 0; t < coarse.triangles.size(); ++t)
    for (int i = 1; i < 12; ++i)
      for (int j = 1; i + j < 12; ++j, ++n) {
        const float b = i / 12.0f, c = j / 12.0f, a = 1 - b - c;
        glm::vec3 p(0);
        glm::vec2 uv(0);
        for (std::size_t k = 0; k < 3; ++k) {
          const float w = k == 0 ? a : (k == 1 ? b : c);
          p += w * coarse.positions[coarse.triangles[t][k]];
          uv += w * coarse.texcoords[3 * t + k];
        }
        const glm::dvec3 nearest = finder.find(glm::dvec3(p)).point;
        const glm::vec2 wanted(0.1 + 0.8 * nearest.x, 0.1 + 0.8 * nearest.y);
        const auto x = static_cast<int>(uv.x * 512), y = static_cast<int>((1 - uv.y) * 512);
        with += std::pow(glm::distance(map.at(x, y), wanted), 2);
        without += std::pow(glm::distance(uv, wanted), 2);
      }
  EXPECT_LT(std::sqrt(with / n), 0.6 * std::sqrt(without / n));
}

TEST(BakeTexture, ShowsTheTextureThroughTheMap) {
  ImageRgba8 texture(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      texture.at(x, y) = {static_cast<std::uint8_t>(4 * x), static_cast<std::uint8_t>(4 * y), 7,
                          255};
  const LevelCharts all{{{{{0, 0}, {2, 0}, {0, 2}}}}, {0}};
  EXPECT_EQ(resolve_index_map(make_index_map<glm::vec2>(64, 64), texture, all, all).pixels,
            texture.pixels);
  IndexMap map(2, 1, glm::vec2(0.5f, 0.5f));
  const ImageRgba8 out = resolve_index_map(map, texture, all, all);
  EXPECT_EQ(out.at(0, 0), (Rgba8{126, 126, 7, 255}));
}

// A chart that shrinks: nothing of the ground gets into what it covers, and what it has left takes
// its colour; what it never covered stays.
TEST(BakeTexture, KeepsTheGroundOut) {
  const Rgba8 ground{255, 0, 255, 255}, skin{10, 200, 30, 255};
  ImageRgba8 texture(32, 32, ground);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 16; ++x) texture.at(x, y) = skin;
  const LevelCharts finest{{{{{0, 0}, {0.5f, 0}, {0.5f, 1}}}, {{{0, 0}, {0.5f, 1}, {0, 1}}}},
                           {0, 0}};
  const LevelCharts level{{{{{0, 0}, {0.25f, 0}, {0.25f, 1}}}, {{{0, 0}, {0.25f, 1}, {0, 1}}}},
                          {0, 0}};
  IndexMap map(32, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      map.at(x, y) = own_texcoords(x, y, 32, 32);
      map.at(x, y).x = x < 8 ? 2 * map.at(x, y).x : 0.1f;  // stale beyond
    }
  const ImageRgba8 out = resolve_index_map(map, texture, finest, level);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 16; ++x) ASSERT_EQ(out.at(x, y), skin) << x << ' ' << y;
    for (int x = 20; x < 32; ++x) ASSERT_EQ(out.at(x, y), ground) << x << ' ' << y;
  }
}

}  // namespace
}  // namespace viewcell

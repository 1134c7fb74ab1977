#include "bake/texture_adapt.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/closest_point.h"
#include "pm/build.h"
#include "pm/shapes.h"

namespace viewcell {
namespace {

// A bump over the unit square, with a texture that is the view from above.
TriMesh make_bump(float height) {
  TriMesh grid = make_flat_grid(16);
  for (glm::vec3& p : grid.positions) {
    const float x = p.x / 16 - 0.5f, y = p.y / 16 - 0.5f;
    p = {p.x / 16, p.y / 16, height * std::exp(-12 * (x * x + y * y))};
  }
  for (const Triangle& t : grid.triangles)
    for (const std::uint32_t v : t)
      grid.texcoords.emplace_back(0.1f + 0.8f * grid.positions[v].x,
                                  0.1f + 0.8f * grid.positions[v].y);
  return grid;
}

BuildResult build(const TriMesh& mesh, std::size_t n_faces) {
  BuildOptions options;
  options.metric = MetricKind::mapping;
  options.target_faces = n_faces;
  return build_progressive_mesh(mesh, options);
}

TEST(IndexMap, HoldsItsOwnPlaces) {
  const IndexMap map = make_index_map(4, 2);
  EXPECT_EQ(map.at(0, 0), glm::vec2(0.125f, 0.75f));
  EXPECT_EQ(map.at(3, 1), glm::vec2(0.875f, 0.25f));
}

TEST(TextureAdapter, FlatMeshesKeepEveryTexel) {
  const BuildResult built = build(make_bump(0), 6);
  const AdaptationLog log = make_adaptation_log(built.record);
  IndexMap map = make_index_map(128, 128);
  const IndexMap start = map;
  TextureAdapter adapter;
  for (std::size_t i = 0; i < log.n_collapses(); ++i) adapter.collapse(map, log.of(i));
  EXPECT_GT(adapter.counts().n_texels, 20000u);
  for (std::size_t i = 0; i < map.pixels.size(); ++i)
    ASSERT_LT(128 * glm::distance(map.pixels[i], start.pixels[i]), 0.01f) << i;
}

// There and back: what no cell touched is as it was to the bit, the rest within half a texel.
TEST(TextureAdapter, SplitsUndoCollapses) {
  const BuildResult built = build(make_bump(0.4f), 60);
  const AdaptationLog log = make_adaptation_log(built.record);
  IndexMap map = make_index_map(256, 256);
  const IndexMap start = map;
  TextureAdapter adapter;
  for (std::size_t i = 0; i < log.n_collapses(); ++i) adapter.collapse(map, log.of(i));
  const IndexMap coarse = map;
  for (std::size_t i = log.n_collapses(); i-- > 0;) adapter.split(map, log.of(i));
  std::size_t n_moved = 0, n_off = 0;
  double sum = 0;
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      const double off = 256 * glm::distance(map.at(x, y), start.at(x, y));
      const bool is_outside = x < 25 || y < 25 || x >= 231 || y >= 231;
      if (is_outside) {
        ASSERT_EQ(map.at(x, y), start.at(x, y));
      }
      n_moved += 256 * glm::distance(coarse.at(x, y), start.at(x, y)) > 1;
      n_off += off > 0.5;
      sum += off * off;
    }
  EXPECT_GT(n_moved, 2000u);
  EXPECT_LT(n_off, 256u * 256u / 100);
  EXPECT_LT(std::sqrt(sum / (256 * 256)), 0.25);
}

// With the adapted map a point of the coarse mesh shows what is nearest to it on the input better
// than without. The texture's u and v are x and y, so the map tells directly.
TEST(TextureAdapter, TextureStaysWhereItWas) {
  const TriMesh bump = make_bump(0.4f);
  const BuildResult built = build(bump, 60);
  const AdaptationLog log = make_adaptation_log(built.record);
  IndexMap map = make_index_map(512, 512);
  TextureAdapter adapter;
  for (std::size_t i = 0; i < log.n_collapses(); ++i) adapter.collapse(map, log.of(i));
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
  EXPECT_EQ(bake_texture(make_index_map(64, 64), texture).pixels, texture.pixels);
  IndexMap map(2, 1, glm::vec2(0.5f, 0.5f));
  const ImageRgba8 out = bake_texture(map, texture);
  EXPECT_EQ(out.at(0, 0), (Rgba8{126, 126, 7, 255}));
}

}  // namespace
}  // namespace viewcell

#include "adapt/normal_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "adapt/bump.h"
#include "adapt/texture_adapt.h"
#include "base/random.h"
#include "common/same_every_time.h"
#include "mesh/tangents.h"
#include "pm/build.h"
#include "uv/triangle_grid.h"

namespace viewcell {
namespace {

constexpr double kRelief = 0.3;

// A mesh of the finest level, and of one of n faces with its indexing map.
struct NormalLevels {
  TriMesh finest, level;
  LevelCharts finest_charts, charts;
  IndexMap map;

  NormalLevels(const TriMesh& mesh, std::size_t n, int size_px,
               Placement placement = Placement::half) {
    BuildOptions options;
    options.metric = MetricKind::mapping;
    options.target_faces = 40;
    options.placement = placement;
    const BuildResult built = build_progressive_mesh(mesh, options);
    ProgressiveMesh at(built.record);
    at.set_level(at.n_splits());
    const AdaptationLog log = make_adaptation_log(built.record);
    finest = at.extract(), finest_charts = make_level_charts(at, log);
    TextureAdapter<glm::vec2> adapter(log, make_index_map<glm::vec2>(size_px, size_px),
                                      finest_charts, 0);
    at.set_faces(n);
    adapter.go_to(at.n_splits() - at.level());
    level = at.extract(), charts = make_level_charts(at, log), map = adapter.image();
  }
  BakedNormalMap bake(const ImageRgba8* normal_map, const NormalMapOptions& options = {}) const {
    return bake_normal_map(map, normal_map, {finest, finest_charts.charts}, {level, charts.charts},
                           options);
  }
};

// Smooth, seeded, tilted by at most 20 degrees or so.
ImageRgba8 make_relief_map(int size_px, std::uint64_t seed) {
  Random random(seed);
  const double a = random.uniform(0.03, 0.1), b = random.uniform(0.03, 0.1);
  ImageRgba8 image(size_px, size_px);
  for (int y = 0; y < size_px; ++y)
    for (int x = 0; x < size_px; ++x)
      image.at(x, y) = encode_normal(glm::normalize(
          glm::dvec3(0.3 * std::sin(a * x + b * y), 0.3 * std::cos(b * x - a * y), 1)));
  return image;
}

// --- twins: all triangles are tried, and the frame is written out ---

struct Surface {
  const TriMesh& mesh;
  std::vector<glm::vec3> normals = make_corner_normals(mesh);
  std::vector<glm::vec4> tangents = make_corner_tangents(mesh, normals);

  // Of the triangle that uv lies in; false: in none, by `within`.
  bool find(const glm::dvec2& uv, double within, glm::dmat3& frame) const {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const glm::dvec2 a(mesh.texcoords[3 * t]), b(mesh.texcoords[3 * t + 1]),
          c(mesh.texcoords[3 * t + 2]);
      const glm::dvec2 st = glm::inverse(glm::dmat2(b - a, c - a)) * (uv - a);
      const glm::dvec3 w(1 - st.x - st.y, st.x, st.y);
      if (std::min({w.x, w.y, w.z}) < -within) continue;
      glm::dvec3 n(0), tangent(0);
      for (int k = 0; k < 3; ++k) {
        n += w[k] * glm::dvec3(normals[3 * t + std::size_t(k)]);
        tangent += w[k] * glm::dvec3(tangents[3 * t + std::size_t(k)]);
      }
      frame = {tangent, double(tangents[3 * t].w) * glm::cross(n, tangent), n};
      return true;
    }
    return false;
  }
};

glm::dvec3 decode_at(const ImageRgba8& image, const glm::dvec2& uv) {
  const BilinearTexels at = bilinear_texels(image, to_texels(uv, image.width_px, image.height_px));
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < 4; ++i)
    sum += double(at.weights[i]) * decode_normal(image.pixels[at.offsets[i]]);
  return sum;
}

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

// -------------------------------------------------------------------------------------------------

TEST(NormalCode, EveryCodeComesBack) {
  for (int code = 0; code < 256; ++code) {
    const auto c = static_cast<std::uint8_t>(code);
    const Rgba8 p{c, static_cast<std::uint8_t>(255 - code), c, 255};
    EXPECT_EQ(encode_normal(decode_normal(p)), p);
    const Rgba8 turned{c, c, c, 255};  // y down is 255 - green
    EXPECT_EQ(encode_normal(decode_normal(p, NormalMapY::down)), turned);
  }
  EXPECT_EQ(encode_normal({0, 0, 1}), (Rgba8{128, 128, 255, 255}));
  EXPECT_EQ(encode_normal({-2, 2, 0}), (Rgba8{0, 255, 128, 255}));
  EXPECT_EQ(decode_normal({255, 0, 255, 255}), glm::dvec3(1, -1, 1));
}

// Against all triangles, inside, beside and far off. Seeded.
TEST(TriangleGrid, FindsWhatTryingAllFinds) {
  Random random(3);
  TriMesh mesh = make_bump(kRelief);
  std::vector<std::uint32_t> charts;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) charts.push_back(t % 3 == 0);
  for (glm::vec2& uv : mesh.texcoords) uv.y *= 0.3f;
  const TriangleGrid grid(mesh, charts);
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec2 uv(random.uniform(-0.4, 1.4), random.uniform(-0.4, 1.4));
    const std::uint32_t chart = random.below(2);
    double least = 1e300;
    for (std::size_t t = 0; t < charts.size(); ++t) {
      if (charts[t] != chart) continue;
      const Corners2 p{mesh.texcoords[3 * t], mesh.texcoords[3 * t + 1], mesh.texcoords[3 * t + 2]};
      least = std::min(least, glm::distance(mix(p, nearest_weights(p, uv)), uv));
    }
    const TriangleGrid::Nearest found = grid.find(uv, chart);
    ASSERT_NE(found.triangle, TriangleGrid::kNone);
    ASSERT_EQ(charts[found.triangle], chart);
    const std::size_t c = 3 * found.triangle;
    const Corners2 p{mesh.texcoords[c], mesh.texcoords[c + 1], mesh.texcoords[c + 2]};
    ASSERT_NEAR(glm::distance(mix(p, found.weights), uv), least, 1e-12) << i;
  }
  EXPECT_EQ(grid.find({0.5, 0.1}, 2).triangle, TriangleGrid::kNone);
}

// Codes need not be unit: at the finest level they stay as they are.
TEST(NormalMapBake, TheFinestLevelKeepsEveryCode) {
  Random random(7);
  ImageRgba8 noise(128, 128);
  for (Rgba8& p : noise.pixels)
    p = {std::uint8_t(60 + random.below(136)), std::uint8_t(60 + random.below(136)),
         std::uint8_t(160 + random.below(90)), 255};
  for (const bool is_mirrored : {false, true}) {
    const NormalLevels levels(make_bump(kRelief, is_mirrored), 1000000, 128);
    const BakedNormalMap baked = levels.bake(&noise);
    EXPECT_EQ(baked.n_clamped, 0u);
    EXPECT_NEAR(double(baked.n_texels), 105 * 105, 250);
    for (int y = 14; y < 114; ++y)
      for (int x = 14; x < 114; ++x)
        ASSERT_EQ(baked.image.at(x, y), noise.at(x, y)) << x << " " << y;
    EXPECT_EQ(baked.image.at(0, 64), baked.image.at(11, 64));  // far out: the nearest of the rim
  }
}

// What the level shows with the baked map is what the finest mesh shows with its own.
TEST(NormalMapBake, LevelsShowTheNormalsOfTheFinest) {
  constexpr int kSize = 160;
  std::size_t n_merely_wrong = 0;
  for (const auto& [n, is_mirrored, placement] :
       {std::tuple{300, false, Placement::half}, std::tuple{110, true, Placement::half},
        std::tuple{60, false, Placement::half}, std::tuple{150, true, Placement::full}}) {
    const NormalLevels levels(make_bump(kRelief, is_mirrored), std::size_t(n), kSize, placement);
    const ImageRgba8 relief = make_relief_map(96, std::uint64_t(n));  // of another size
    const BakedNormalMap baked = levels.bake(&relief);
    const Surface finest{levels.finest}, level{levels.level};
    std::size_t n_texels = 0;
    for (int y = 0; y < kSize; y += 3)
      for (int x = 0; x < kSize; x += 3) {
        glm::dmat3 from, to;
        const glm::vec2& uv = levels.map.at(x, y);
        if (!level.find(own_texcoords(x, y, kSize, kSize), -1e-9, to)) continue;
        if (!finest.find(uv, -1e-6, from)) continue;
        if (std::min({uv.x, uv.y, 1 - uv.x, 1 - uv.y}) < 0.12f) continue;  // fetches past the chart
        const glm::dvec3 meant = from * decode_at(relief, uv);
        if (glm::normalize(glm::inverse(to) * meant).z < 0.1) continue;
        ++n_texels;
        ASSERT_LT(angle_deg(meant, to * decode_normal(baked.image.at(x, y))), 1.2)
            << n << ": " << x << " " << y;
        n_merely_wrong += angle_deg(meant, to * decode_at(relief, uv)) > 6;
      }
    EXPECT_GT(n_texels, 1200u) << n;
  }
  EXPECT_GT(n_merely_wrong, 500u);  // as they would be, merely fetched
}

// Without a map, the normals of the bump itself, by its formula, at the places that the map holds.
TEST(NormalMapBake, FlatOnesHoldTheShadingOfTheFinest) {
  constexpr int kSize = 128;
  const NormalLevels levels(make_bump(kRelief), 80, kSize);
  const BakedNormalMap baked = levels.bake(nullptr);
  const Surface level{levels.level};
  double sum = 0, of_level = 0, n = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      glm::dmat3 frame;
      if (!level.find(own_texcoords(x, y, kSize, kSize), 0, frame)) continue;
      const glm::dvec2 at = (glm::dvec2(levels.map.at(x, y)) - 0.1) / 0.8 - 0.5;
      const double slope = 24 * kRelief * std::exp(-12 * glm::dot(at, at));
      const glm::dvec3 normal(slope * at.x, slope * at.y, 1);
      sum += angle_deg(normal, frame * decode_normal(baked.image.at(x, y)));
      of_level += angle_deg(normal, frame[2]);
      ++n;
    }
  EXPECT_LT(sum / n, 1.5);  // the grid's own normals are that near
  EXPECT_GT(of_level / n, 3);
}

TEST(NormalMapBake, GreenMayPointDown) {
  const NormalLevels levels(make_bump(kRelief), 100, 96);
  const ImageRgba8 up = make_relief_map(96, 4);
  ImageRgba8 down = up;
  for (Rgba8& p : down.pixels) p[1] = static_cast<std::uint8_t>(255 - p[1]);
  EXPECT_EQ(levels.bake(&down, {.y = NormalMapY::down}).image.pixels,
            levels.bake(&up).image.pixels);
  EXPECT_NE(levels.bake(&down).image.pixels, levels.bake(&up).image.pixels);
}

TEST(NormalMapBake, TheSameBytesForAnyNumberOfThreads) {
  const NormalLevels levels(make_bump(kRelief), 100, 96);
  const ImageRgba8 relief = make_relief_map(64, 5);
  const auto baked = same_for_any_threads([&](int n_threads) {
    const BakedNormalMap map = levels.bake(&relief, {.n_threads = n_threads});
    return std::pair(map.image.pixels, map.n_clamped);
  });
  EXPECT_GT(std::set<Rgba8>(baked.first.begin(), baked.first.end()).size(), 100u);
}

// A square whose normals lean away: those of the finest mesh lie below its surface.
//   level: normal (-sin 100, 0, cos 100) to finest: (0, 0, 1)
TEST(NormalMapBake, NormalsBelowTheSurfaceAreLaidIntoIt) {
  TriMesh finest;
  finest.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  finest.normals.assign(4, glm::vec3(0, 0, 1));
  finest.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const Triangle& t : finest.triangles)
    for (const std::uint32_t v : t) finest.texcoords.emplace_back(finest.positions[v]);
  TriMesh level = finest;
  const double a = glm::radians(100.0);
  level.normals.assign(4, glm::vec3(-std::sin(a), 0, std::cos(a)));
  const std::vector<std::uint32_t> charts{0, 0};
  const IndexMap map = make_index_map<glm::vec2>(8, 8);
  const BakedNormalMap baked = bake_normal_map(map, nullptr, {finest, charts}, {level, charts});
  EXPECT_EQ(baked.n_texels, 64u);
  EXPECT_EQ(baked.n_clamped, 64u);
  for (const Rgba8& p : baked.image.pixels) EXPECT_EQ(p, (Rgba8{0, 128, 128, 255}));
  // At 80 degrees it can be expressed: (-sin 80, 0, cos 80) by the level's tangent and normal.
  const double b = glm::radians(80.0);
  level.normals.assign(4, glm::vec3(-std::sin(b), 0, std::cos(b)));
  const BakedNormalMap above = bake_normal_map(map, nullptr, {finest, charts}, {level, charts});
  EXPECT_EQ(above.n_clamped, 0u);
  const Rgba8 expected = encode_normal({std::sin(b), 0, std::cos(b)});
  for (const Rgba8& p : above.image.pixels)
    for (std::size_t k = 0; k < 4; ++k) ASSERT_NEAR(p[k], expected[k], 1);
}

}  // namespace
}  // namespace viewcell

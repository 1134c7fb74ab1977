#include "adapt/rebake.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "adapt/bump.h"
#include "base/random.h"
#include "common/same_every_time.h"
#include "image/pixels.h"
#include "image/random_image.h"
#include "image/texel_spans.h"
#include "mesh/closest_point.h"
#include "pm/build.h"
#include "uv/atlas_cube.h"
#include "uv/chart_map.h"

namespace viewcell {
namespace {

ImageRgba8 make_noise(int width_px, int height_px, std::uint64_t seed) {
  Random random(seed);
  return random_image(width_px, height_px, random);
}

// The number of texels whose centre lies in a chart; each must be the same in both, to 1.
std::size_t expect_same_inside(const TriMesh& mesh, const ImageRgba8& a, const ImageRgba8& b) {
  const auto owner = make_chart_map(mesh, find_charts(mesh), a.width_px, a.height_px);
  std::size_t n = 0;
  for (std::size_t i = 0; i < owner.pixels.size(); ++i) {
    if (owner.pixels[i] == 0) continue;
    ++n;
    EXPECT_LE(most_difference(a.pixels[i], b.pixels[i]), 1) << i;
  }
  return n;
}

TriMesh simplify(const TriMesh& mesh, std::size_t n_faces) {
  BuildOptions options;
  options.metric = MetricKind::qem5;
  options.target_faces = n_faces;
  return ProgressiveMesh(build_progressive_mesh(mesh, options).record).extract();
}

TEST(Rebake, TheOriginalGetsItsTextureBack) {
  const TriMesh cube = make_atlas_cube(5);
  const ImageRgba8 noise = make_noise(97, 83, 1);
  EXPECT_GT(expect_same_inside(cube, rebake_texture(cube, cube, noise), noise), 3000u);
  const TriMesh bump = make_bump(0.4f);
  const ImageRgba8 square = make_noise(128, 128, 2);
  EXPECT_GT(expect_same_inside(bump, rebake_texture(bump, bump, square), square), 10000u);
}

TEST(Rebake, FlatMeshesKeepEveryTexel) {
  const TriMesh flat = make_bump(0);
  const ImageRgba8 noise = make_noise(128, 128, 3);
  for (const std::size_t n_faces : {2u, 20u, 200u}) {
    const TriMesh level = simplify(flat, n_faces);
    ASSERT_LE(level.triangles.size(), n_faces + 1);
    const ImageRgba8 out = rebake_texture(level, flat, noise);
    EXPECT_GT(expect_same_inside(flat, out, noise), 10000u);
  }
}

// The picture tells x and y of the surface: each texel must tell those of the nearest point, which
// is found here by trying all triangles.
TEST(Rebake, ShowsTheNearestPoint) {
  const TriMesh bump = make_bump(0.4f), level = simplify(bump, 40);
  constexpr int kSize = 128;
  ImageRgba8 texture(kSize, kSize);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      texture.at(x, y) = {static_cast<std::uint8_t>(2 * x), static_cast<std::uint8_t>(2 * y), 7, 9};
  const ImageRgba8 out = rebake_texture(level, bump, texture);
  std::size_t n = 0;
  for (std::size_t t = 0; t < level.triangles.size(); ++t) {
    std::array<glm::dvec2, 3> uv;
    std::array<glm::dvec3, 3> at;
    for (std::size_t k = 0; k < 3; ++k) {
      uv[k] = to_texels(level.texcoords[3 * t + k], kSize, kSize);
      at[k] = level.positions[level.triangles[t][k]];
    }
    const glm::dmat2 frame(uv[1] - uv[0], uv[2] - uv[0]);
    for_each_span(uv, kSize, kSize, [&](int x0, int x1, int y) {
      for (int x = x0; x < x1; x += 9, ++n) {
        const glm::dvec2 w = glm::inverse(frame) * (glm::dvec2(x, y) - uv[0]);
        const glm::dvec3 p = at[0] + w.x * (at[1] - at[0]) + w.y * (at[2] - at[0]);
        glm::dvec3 nearest(1e9);
        for (const auto& [a, b, c] : bump.triangles) {
          const glm::dvec3 q =
              closest_point_on_triangle(p, bump.positions[a], bump.positions[b], bump.positions[c]);
          if (glm::distance(p, q) < glm::distance(p, nearest)) nearest = q;
        }
        const glm::dvec2 place =
            2.0 * to_texels(glm::vec2(0.1 + 0.8 * nearest.x, 0.1 + 0.8 * nearest.y), kSize, kSize);
        ASSERT_NEAR(out.at(x, y)[0], place.x, 0.6) << x << " " << y;
        ASSERT_NEAR(out.at(x, y)[1], place.y, 0.6) << x << " " << y;
      }
    });
  }
  EXPECT_GT(n, 1000u);
}

// Charts of one colour each on magenta, without a gutter: what a bilinear fetch shows anywhere on
// the surface is the colour of its chart, and nothing else.
TEST(Rebake, NothingBleedsIntoCharts) {
  const TriMesh fine = make_atlas_cube(6), coarse = make_atlas_cube(1);
  constexpr Rgba8 kMagenta{255, 0, 255, 255};
  const auto color_of = [](std::uint32_t chart) {
    return Rgba8{static_cast<std::uint8_t>(20 * chart), static_cast<std::uint8_t>(250 - 30 * chart),
                 static_cast<std::uint8_t>(chart % 2 * 90), 255};
  };
  for (const int size : {64, 101}) {
    ImageRgba8 texture(size, size, kMagenta);
    const auto owner = make_chart_map(fine, find_charts(fine), size, size);
    for (std::size_t i = 0; i < owner.pixels.size(); ++i)
      if (owner.pixels[i]) texture.pixels[i] = color_of(owner.pixels[i] - 1);
    const ImageRgba8 out = rebake_texture(coarse, fine, texture);
    EXPECT_EQ(std::count(out.pixels.begin(), out.pixels.end(), kMagenta), 0);
    Random random(4);
    for (int i = 0; i < 20000; ++i) {
      const std::uint32_t t = random.below(12);
      double b = random.uniform(), c = random.uniform();
      if (i % 2) b = 0;  // along an edge
      if (b + c > 1) b = 1 - b, c = 1 - c;
      const glm::vec2* uv = &coarse.texcoords[3 * t];
      const glm::dvec2 at =
          (1 - b - c) * glm::dvec2(uv[0]) + b * glm::dvec2(uv[1]) + c * glm::dvec2(uv[2]);
      const BilinearTexels texels = bilinear_texels(out, to_texels(glm::vec2(at), size, size));
      for (std::size_t k = 0; k < 4; ++k)
        if (texels.weights[k] > 0) {
          ASSERT_EQ(out.pixels[texels.offsets[k]], color_of(t / 2)) << size << " " << i;
        }
    }
  }
}

// Two charts side by side without a gap: at a finer resolution their texels do not mix.
TEST(Rebake, FetchesFromOneChart) {
  TriMesh mesh;
  for (const float z : {0.0f, 5.0f})
    for (const glm::vec2 p : {glm::vec2(0), {1, 0}, {1, 1}, {0, 1}})
      mesh.positions.emplace_back(p, z);
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      mesh.texcoords.emplace_back(0.5f * mesh.positions[v].x + (v < 4 ? 0 : 0.5f),
                                  mesh.positions[v].y);
  constexpr Rgba8 kRed{200, 0, 0, 255}, kGreen{0, 200, 0, 255};
  ImageRgba8 texture(8, 8, kRed);
  for (int y = 0; y < 8; ++y)
    for (int x = 4; x < 8; ++x) texture.at(x, y) = kGreen;
  RebakeOptions options;
  options.width_px = 40;
  const ImageRgba8 out = rebake_texture(mesh, mesh, texture, options);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 40; ++x) ASSERT_EQ(out.at(x, y), x < 20 ? kRed : kGreen) << x << " " << y;
}

// Texels beyond a chart's border show the border, not the last texel inside it.
TEST(Rebake, RimsShowTheBorder) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      mesh.texcoords.emplace_back(0.1f + 0.4f * mesh.positions[v].x,
                                  0.1f + 0.8f * mesh.positions[v].y);
  // At 10 texels the chart holds columns 1 to 4; at 20, its border lies between 9 and 10.
  ImageRgba8 texture(20, 20);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x)
      texture.at(x, y) = {static_cast<std::uint8_t>(20 * std::min(x, 9)), 0, 0, 255};
  RebakeOptions options;
  options.width_px = options.height_px = 10;
  const ImageRgba8 out = rebake_texture(mesh, mesh, texture, options);
  EXPECT_EQ(out.at(3, 5)[0], 130);  // between columns 6 and 7
  EXPECT_EQ(out.at(4, 5)[0], 170);
  EXPECT_EQ(out.at(5, 5)[0], 180);  // column 9, where the chart's texels end
  EXPECT_EQ(out.at(9, 5)[0], 180);
}

//  z = 0.02  ------ up, red         level: z = 0.005 ------ up, z = 0.015 ------ down: each nearer
//  z = 0     ------ down, green            to the side that it is not
TEST(Rebake, TellsTheSidesOfASheet) {
  const auto make_sheet = [](float up, float down) {
    TriMesh mesh;
    mesh.positions = {{0, 0, up},   {1, 0, up},   {1, 1, up},   {0, 1, up},
                      {0, 0, down}, {1, 0, down}, {1, 1, down}, {0, 1, down}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}};
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t) {
        const glm::vec3& p = mesh.positions[v];
        mesh.texcoords.emplace_back(0.05f + 0.4f * p.x + (v < 4 ? 0 : 0.5f), 0.1f + 0.8f * p.y);
      }
    return mesh;
  };
  constexpr Rgba8 kRed{200, 0, 0, 255}, kGreen{0, 200, 0, 255};
  ImageRgba8 texture(64, 32, kRed);
  for (int y = 0; y < 32; ++y)
    for (int x = 32; x < 64; ++x) texture.at(x, y) = kGreen;
  const ImageRgba8 out = rebake_texture(make_sheet(0.005f, 0.015f), make_sheet(0.02f, 0), texture);
  EXPECT_EQ(out.pixels, texture.pixels);
  // A side that is much farther is not the same sheet's: what is near counts.
  const ImageRgba8 far = rebake_texture(make_sheet(0.1f, 1), make_sheet(1, 0), texture);
  EXPECT_EQ(far.at(16, 16), kGreen);
  EXPECT_EQ(far.at(48, 16), kRed);
}

TEST(Rebake, SameBytesForAnyNumberOfThreadsAndAnySize) {
  const TriMesh bump = make_bump(0.3f), level = simplify(bump, 50);
  const ImageRgba8 noise = make_noise(100, 60, 5);
  RebakeOptions options;
  options.width_px = 75, options.height_px = 150;
  const auto pixels = same_for_any_threads([&](int n_threads) {
    options.n_threads = n_threads;
    const ImageRgba8 out = rebake_texture(level, bump, noise, options);
    EXPECT_EQ(out.width_px, 75);
    EXPECT_EQ(out.height_px, 150);
    return out.pixels;
  });
  EXPECT_GT(std::set<Rgba8>(pixels.begin(), pixels.end()).size(), 1000u);
}

// A triangle too small to hold a texel's centre still shows its colour around it.
TEST(Rebake, SmallTrianglesHaveRims) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {1, 0, 5}, {0, 1, 5}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.texcoords = {{0.26f, 0.26f}, {0.27f, 0.26f}, {0.26f, 0.27f},
                    {0.6f, 0.6f},   {0.9f, 0.6f},   {0.6f, 0.9f}};
  ImageRgba8 texture(10, 10, {0, 0, 90, 255});
  for (int y = 5; y < 10; ++y)
    for (int x = 0; x < 5; ++x) texture.at(x, y) = {90, 0, 0, 255};
  const ImageRgba8 out = rebake_texture(mesh, mesh, texture);
  EXPECT_EQ(out.at(2, 7), (Rgba8{90, 0, 0, 255}));
  EXPECT_EQ(out.at(7, 3), (Rgba8{0, 0, 90, 255}));
}

TEST(Rebake, MeshesOutsideThePictureShowNothing) {
  TriMesh mesh = make_bump(0);
  for (glm::vec2& uv : mesh.texcoords) uv.x += 3;
  const ImageRgba8 out = rebake_texture(mesh, mesh, make_noise(16, 16, 6));
  EXPECT_EQ(out.pixels, ImageRgba8(16, 16).pixels);
}

}  // namespace
}  // namespace viewcell

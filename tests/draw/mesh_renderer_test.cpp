#include "draw/mesh_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/error.h"
#include "base/srgb.h"
#include "draw/front_square.h"
#include "draw/gl_fixture.h"
#include "draw/small_scene.h"
#include "image/pixels.h"

namespace viewcell {
namespace {

constexpr int kShotSize = 128;

MeshFrame own_frame(const TriMesh& mesh, const char* up = "z") {
  return make_frame(box_of_triangles(mesh), up, "mesh");
}

ImageRgba8 draw(const TriMesh& mesh, const Camera& view, const MeshStyle& style,
                const ImageRgba8* texture = nullptr, const MeshFrame* frame = nullptr) {
  const MeshFrame own = frame ? *frame : own_frame(mesh);
  return MeshRenderer(shared_context().gl(), mesh, own, texture, style).draw(view);
}

std::size_t count_covered(const ImageRgba8& image) {
  std::size_t n = 0;
  for (const Rgba8& p : image.pixels) n += p[3] > 0;
  return n;
}

// Of radius 1, with the frame of that radius.
const MeshFrame kUnitFrame{};
TriMesh make_sphere(int n) {
  TriMesh mesh;
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(i * 2 * n + j % (2 * n)); };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const double a = glm::pi<double>() * i / n, b = glm::pi<double>() * j / n;
      mesh.positions.emplace_back(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b),
                                  std::cos(a));
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      if (i > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + 1 < n) mesh.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  mesh.normals = mesh.positions;
  return mesh;
}

// In a frame that it fills to 0.7; (repeats, repeats) at the upper right corner.
TriMesh make_square(float repeats = 1) {
  return make_front_square([&](const glm::vec2& uv) { return repeats * uv; });
}

// The pixel that shows (u, v) of the square with one repeat.
Rgba8 at_uv(const ImageRgba8& image, double u, double v) {
  return at_square(image, 2 * u - 1, 2 * v - 1);
}

constexpr Rgba8 kRed{200, 10, 20, 255}, kGreen{10, 180, 30, 255}, kBlue{20, 40, 220, 255},
    kYellow{230, 210, 0, 255};

// Row 0 is the top: red, green above blue, yellow.
ImageRgba8 make_quadrants(int width, int height) {
  ImageRgba8 image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.at(x, y) =
          y < height / 2 ? (x < width / 2 ? kRed : kGreen) : (x < width / 2 ? kBlue : kYellow);
  return image;
}

TEST(MeshRenderer, SphereCoversAsManyPixelsInEveryView) {
  const TriMesh sphere = make_sphere(64);
  const MeshRenderer renderer(shared_context().gl(), sphere, kUnitFrame, nullptr,
                              plain_style(kShotSize));
  // The rim is seen under asin(1 / distance).
  const double distance = glm::length(make_views(1)[0].eye);
  const double radius_px =
      0.5 * kShotSize * std::tan(std::asin(1 / distance)) / std::tan(glm::radians(kViewFovDeg / 2));
  const double rim_px = glm::two_pi<double>() * radius_px;
  for (const Camera& view : make_views(12)) {
    const ImageRgba8 image = renderer.draw(view);
    EXPECT_NEAR(static_cast<double>(count_covered(image)), 0.5 * rim_px * radius_px, 0.25 * rim_px);
    for (int i = 0; i < kShotSize; ++i)  // nothing is cut off
      for (const Rgba8& p :
           {image.at(i, 0), image.at(i, kShotSize - 1), image.at(0, i), image.at(kShotSize - 1, i)})
        ASSERT_EQ(p[3], 0);
  }
}

// Where the ray through a pixel meets the unit sphere, if well inside the rim.
bool hit_sphere(const Camera& view, int x, int y, glm::dvec3& normal) {
  const glm::dmat4 frame_from_clip = glm::inverse(clip_from_world(view));
  const glm::dvec4 p = frame_from_clip * glm::dvec4(2 * (x + 0.5) / kShotSize - 1,
                                                    1 - 2 * (y + 0.5) / kShotSize, 0.01, 1);
  const glm::dvec3 ray = glm::normalize(glm::dvec3(p) / p.w - view.eye);
  const double b = glm::dot(ray, view.eye), c = glm::dot(view.eye, view.eye) - 1;
  if (b * b - c < 0.05) return false;
  normal = view.eye + (-b - std::sqrt(b * b - c)) * ray;
  return true;
}

TEST(MeshRenderer, LitSphereHasTheColoursOfTheLightingFunction) {
  const TriMesh sphere = make_sphere(96);
  for (const bool light_follows : {false, true}) {
    MeshStyle style = plain_style(kShotSize);
    style.light_follows = light_follows;
    style.base_color = {0.7f, 0.4f, 0.2f};
    const MeshRenderer renderer(shared_context().gl(), sphere, kUnitFrame, nullptr, style);
    for (const Camera& view : make_views(5)) {
      const ImageRgba8 image = renderer.draw(view);
      const glm::dmat3 turn = light_follows ? turn_eye_to_front(view) : glm::dmat3(1);
      std::size_t n = 0;
      glm::dvec3 normal;
      for (int y = 0; y < kShotSize; ++y)
        for (int x = 0; x < kShotSize; ++x) {
          if (!hit_sphere(view, x, y, normal)) continue;
          const Rgba8 expected =
              encoded(shade(style.lighting, style.base_color, glm::vec3(turn * normal)));
          ASSERT_LE(most_difference(image.at(x, y), expected), 2) << x << "," << y;
          ++n;
        }
      EXPECT_GT(n, 5000u);
    }
  }
}

// The square's side is sqrt(2) of a radius.
TEST(MeshRenderer, SquareCoversItsPixels) {
  const MeshStyle style = plain_style(kShotSize);
  const double side_px = kShotSize * glm::one_over_root_two<double>() /
                         (glm::length(front_view().eye) * std::tan(glm::radians(kViewFovDeg / 2)));
  const ImageRgba8 image = draw(make_square(), front_view(), style);
  EXPECT_NEAR(static_cast<double>(count_covered(image)), side_px * side_px, 2 * side_px);
}

// Pixels at the rim are part sky, and yet covered.
TEST(MeshRenderer, BackgroundIsTheSkyWithoutAlpha) {
  MeshStyle style = plain_style(kShotSize);
  style.samples = 3;
  style.lit = false;
  const ImageRgba8 image = draw(make_square(), make_views(1)[0], style);
  ASSERT_EQ(image.width_px, kShotSize);
  ASSERT_EQ(image.height_px, kShotSize);
  const Rgba8 sky = encoded(style.lighting.sky_color, 0), plain = encoded(style.base_color);
  std::size_t n_sky = 0, n_plain = 0, n_rim = 0;
  for (const Rgba8& p : image.pixels) {
    const bool is_rim = p[3] == 255 && most_difference(p, plain) > 1;
    n_sky += p == sky;
    n_plain += most_difference(p, plain) <= 1;
    n_rim += is_rim && p[2] > plain[2] - 2 && p[2] < sky[2] + 2;
  }
  EXPECT_EQ(n_sky + n_plain + n_rim, image.pixels.size());
  EXPECT_GT(n_sky, 5000u);
  EXPECT_GT(n_plain, 3000u);
  EXPECT_GT(n_rim, 100u);
}

TEST(MeshRenderer, TextureStandsUpright) {
  MeshStyle style = plain_style(kShotSize);
  style.lit = false;
  const ImageRgba8 texture = make_quadrants(64, 32);
  for (const bool flip_v : {false, true}) {
    style.flip_v = flip_v;
    const ImageRgba8 image = draw(make_square(), front_view(), style, &texture);
    EXPECT_LE(most_difference(at_uv(image, 0.25, 0.75), flip_v ? kBlue : kRed), 1);
    EXPECT_LE(most_difference(at_uv(image, 0.75, 0.75), flip_v ? kYellow : kGreen), 1);
    EXPECT_LE(most_difference(at_uv(image, 0.25, 0.25), flip_v ? kRed : kBlue), 1);
    EXPECT_LE(most_difference(at_uv(image, 0.75, 0.25), flip_v ? kGreen : kYellow), 1);
  }
}

// The square's two triangles with textures of their own: one above the diagonal, one below.
TEST(MeshRenderer, RunsOfTrianglesShowTheirOwnTextures) {
  MeshStyle style = plain_style(kShotSize);
  style.lit = false;
  const TriMesh square = make_square();
  ASSERT_EQ(square.triangles.size(), 2u);
  const auto at_middle = [&](std::size_t t) {
    return (square.texcoords[3 * t] + square.texcoords[3 * t + 1] + square.texcoords[3 * t + 2]) /
           3.0f;
  };
  const auto draw_runs = [&](const std::vector<TexturedRun>& runs) {
    return MeshRenderer(shared_context().gl(), square, own_frame(square), runs, style)
        .draw(front_view());
  };
  const ImageRgba8 red(2, 2, kRed), blue(1, 1, kBlue);
  const ImageRgba8 one = draw_runs({{red, 1}, {blue, 1}}), other = draw_runs({{blue, 1}, {red, 1}});
  const glm::vec2 a = at_middle(0), b = at_middle(1);
  EXPECT_LE(most_difference(at_uv(one, a.x, a.y), kRed), 1);
  EXPECT_LE(most_difference(at_uv(one, b.x, b.y), kBlue), 1);
  EXPECT_LE(most_difference(at_uv(other, a.x, a.y), kBlue), 1);
  EXPECT_LE(most_difference(at_uv(other, b.x, b.y), kRed), 1);
  const ImageRgba8 quadrants = make_quadrants(16, 16);
  EXPECT_EQ(draw_runs({{quadrants, 1}, {quadrants, 1}}).pixels,
            draw(square, front_view(), style, &quadrants).pixels);
  EXPECT_EQ(draw_runs({{quadrants, 2}}).pixels,
            draw(square, front_view(), style, &quadrants).pixels);
}

TEST(MeshRenderer, TextureRepeats) {
  MeshStyle style = plain_style(kShotSize);
  style.lit = false;
  TriMesh square = make_square(2);
  for (glm::vec2& uv : square.texcoords) uv -= glm::vec2(3, 1);  // below 0, too
  const ImageRgba8 texture = make_quadrants(32, 32);
  const ImageRgba8 image = draw(square, front_view(), style, &texture);
  for (const double u : {0.0, 0.5})
    for (const double v : {0.0, 0.5}) {
      EXPECT_LE(most_difference(at_uv(image, u + 0.125, v + 0.375), kRed), 1);
      EXPECT_LE(most_difference(at_uv(image, u + 0.375, v + 0.375), kGreen), 1);
      EXPECT_LE(most_difference(at_uv(image, u + 0.125, v + 0.125), kBlue), 1);
      EXPECT_LE(most_difference(at_uv(image, u + 0.375, v + 0.125), kYellow), 1);
    }
}

TEST(MeshRenderer, LitTextureIsShaded) {
  const ImageRgba8 texture(4, 4, kGreen);
  const MeshStyle style = plain_style(kShotSize);
  const ImageRgba8 image = draw(make_square(), front_view(), style, &texture);
  const glm::vec3 base(srgb_decode(10 / 255.f), srgb_decode(180 / 255.f), srgb_decode(30 / 255.f));
  EXPECT_LE(
      most_difference(at_uv(image, 0.4, 0.4), encoded(shade(style.lighting, base, {0, -1, 0}))), 1);
}

// Thirty texels a pixel: their mean, of light and not of code values.
TEST(MeshRenderer, FineTexturesAverageInLinearLight) {
  MeshStyle style = plain_style(kShotSize);
  style.lit = false;
  ImageRgba8 texture(256, 256, {0, 0, 0, 255});
  for (int y = 0; y < 256; ++y)
    for (int x = y % 2; x < 256; x += 2) texture.at(x, y) = {255, 255, 255, 255};
  const ImageRgba8 image = draw(make_square(8), front_view(), style, &texture);
  const Rgba8 gray = encoded(glm::vec3(0.5f));
  for (double u = 0.05; u < 1; u += 0.05)
    for (double v = 0.05; v < 1; v += 0.05)
      ASSERT_LE(most_difference(at_uv(image, u, v), gray), 3) << u << "," << v;
}

TEST(MeshRenderer, VertexColoursShowWhereThereIsNoTexture) {
  MeshStyle style = plain_style(kShotSize);
  style.lit = false;
  TriMesh square = make_square();
  square.colors = {{1, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, 1}};
  const ImageRgba8 image = draw(square, front_view(), style);
  for (const double v : {0.1, 0.5, 0.9}) {
    const auto t = static_cast<float>(v);
    EXPECT_LE(most_difference(at_uv(image, 0.3, v), encoded({1 - t, 0, t})), 4) << v;
  }
  const ImageRgba8 texture(4, 4, kGreen);
  EXPECT_LE(most_difference(at_uv(draw(square, front_view(), style, &texture), 0.3, 0.5), kGreen),
            1);
}

TEST(MeshRenderer, BacksAreLitAsFrontsThatFaceTheSameWay) {
  const MeshStyle style = plain_style(kShotSize);
  TriMesh square = make_square();
  const ImageRgba8 front = draw(square, front_view(), style);
  for (Triangle& t : square.triangles) std::swap(t[1], t[2]);
  const ImageRgba8 back = draw(square, front_view(), style);
  EXPECT_EQ(front.pixels, back.pixels);
  EXPECT_LE(most_difference(at_uv(front, 0.5, 0.4),
                            encoded(shade(style.lighting, style.base_color, {0, -1, 0}))),
            1);
}

// The square's own normals lie; two of the three sources do not heed them.
TEST(MeshRenderer, NormalsComeFromWhereTheyAreAsked) {
  MeshStyle style = plain_style(kShotSize);
  TriMesh square = make_square();
  const glm::vec3 own = glm::normalize(glm::vec3(1, -1, 1));
  square.normals.assign(4, own);
  for (const auto source : {NormalSource::mesh, NormalSource::computed, NormalSource::flat}) {
    style.normals = source;
    const glm::vec3 normal = source == NormalSource::mesh ? own : glm::vec3(0, -1, 0);
    EXPECT_LE(most_difference(at_uv(draw(square, front_view(), style), 0.6, 0.3),
                              encoded(shade(style.lighting, style.base_color, normal))),
              1)
        << name_of(source);
    EXPECT_EQ(parse_normal_source(name_of(source)), source);
  }
  EXPECT_THROW(parse_normal_source("file"), UsageError);
}

TEST(MeshRenderer, FlatAndComputedNormalsDifferOnACoarseSphere) {
  MeshStyle style = plain_style(kShotSize);
  const TriMesh sphere = make_sphere(6);
  style.normals = NormalSource::computed;
  const ImageRgba8 smooth = draw(sphere, front_view(), style);
  style.normals = NormalSource::flat;
  const ImageRgba8 flat = draw(sphere, front_view(), style);
  EXPECT_EQ(count_covered(smooth), count_covered(flat));
  EXPECT_LT(psnr_db(smooth, flat), 40);
}

// In the row of v = 0.7 that is the square's diagonal, sqrt(2) pixels wide at 45 degrees.
TEST(MeshRenderer, WireframeIsAPixelWide) {
  MeshStyle style = plain_style(kShotSize);
  style.lit = false;
  style.wireframe = true;
  const Rgba8 plain = encoded(style.base_color), line = encoded(glm::vec3(0.01f));
  for (const int samples : {1, 2, 4}) {
    style.samples = samples;
    const ImageRgba8 image = draw(make_square(), front_view(), style);
    double width_px = 0;
    for (int x = 0; x < kShotSize; ++x) {
      const Rgba8& p = image.at(x, static_cast<int>(0.4 * kShotSize));
      const bool is_inside = x > 0.25 * kShotSize && x < 0.75 * kShotSize;
      if (is_inside) width_px += double(plain[1] - p[1]) / (plain[1] - line[1]);
    }
    EXPECT_NEAR(width_px, glm::root_two<double>(), 0.6) << samples;
    EXPECT_LE(most_difference(at_uv(image, 0.3, 0.6), plain), 1);
  }
}

TEST(MeshRenderer, UpAxisTurnsTheMesh) {
  const TriMesh torus = make_torus(24, 12);  // around z
  const MeshStyle style = plain_style(kShotSize);
  const Camera view = make_views(5)[1];
  const ImageRgba8 expected = draw(torus, view, style);
  TriMesh turned = torus;  // so that y is up: (x, y, z) -> (x, z, -y)
  for (glm::vec3& p : turned.positions) p = {p.x, p.z, -p.y};
  for (glm::vec3& n : turned.normals) n = {n.x, n.z, -n.y};
  const MeshFrame frame = own_frame(turned, "y");
  EXPECT_EQ(draw(turned, view, style, nullptr, &frame).pixels, expected.pixels);
  EXPECT_NE(draw(turned, view, style).pixels, expected.pixels);
}

TEST(MeshRenderer, SizeAndPlaceDoNotMatterInTheOwnFrame) {
  const TriMesh torus = make_torus(40, 20);
  TriMesh moved = torus;
  for (glm::vec3& p : moved.positions) p = 7.3f * p + glm::vec3(100, -50, 30);
  MeshStyle style = plain_style(kShotSize);
  style.samples = 2;
  style.size_px = 256;  // rounding may move a sample across an edge: 68 dB each
  for (const Camera& view : make_views(4)) {
    const ImageRgba8 a = draw(torus, view, style), b = draw(moved, view, style);
    EXPECT_GT(psnr_db(a, b), 60);
    EXPECT_GT(count_covered(a), 1000u);
  }
}

TEST(MeshRenderer, AnothersFrameKeepsAMeshInItsPlace) {
  const TriMesh whole = make_sphere(32);
  TriMesh cap = whole;  // the lower half
  std::erase_if(cap.triangles, [&](const Triangle& t) { return whole.positions[t[0]].z > 0.05f; });
  const MeshFrame frame = own_frame(whole);
  const MeshStyle style = plain_style(kShotSize);
  const ImageRgba8 of_whole = draw(whole, front_view(), style);
  const ImageRgba8 of_cap = draw(cap, front_view(), style, nullptr, &frame);
  EXPECT_EQ(draw(whole, front_view(), style, nullptr, &frame).pixels, of_whole.pixels);
  for (int y = kShotSize / 2 + 8; y < kShotSize; ++y)
    for (int x = 0; x < kShotSize; ++x) ASSERT_EQ(of_cap.at(x, y), of_whole.at(x, y));
  EXPECT_NE(draw(cap, front_view(), style).pixels, of_cap.pixels);  // its own box is smaller
}

TEST(MeshRenderer, SameBytesAgainAndStateIsLeft) {
  const MeshStyle style = plain_style(kShotSize);
  const TriMesh torus = make_torus(24, 12);
  const MeshRenderer renderer(shared_context().gl(), torus, own_frame(torus), nullptr, style);
  const Camera view = make_views(3)[2];
  const ImageRgba8 first = renderer.draw(view);
  EXPECT_NE(renderer.draw(make_views(3)[1]).pixels, first.pixels);
  EXPECT_EQ(renderer.draw(view).pixels, first.pixels);
  check_gl(shared_context().gl(), "drawing a mesh");
  GLint culls = 0;
  shared_context().gl().GetIntegerv(GL_CULL_FACE, &culls);
  EXPECT_EQ(culls, 1);
}

TEST(MeshRenderer, TextureWithoutCoordinatesIsABug) {
  const ImageRgba8 texture(4, 4, kGreen);
  EXPECT_THROW(draw(make_sphere(6), front_view(), plain_style(kShotSize), &texture), BugError);
}

}  // namespace
}  // namespace viewcell

// Normal maps on GL, against what the lighting function says of the normals that they mean.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "base/srgb.h"
#include "draw/front_square.h"
#include "draw/gl_fixture.h"
#include "draw/mesh_renderer.h"

namespace viewcell {
namespace {

constexpr int kReliefSize = 128;

// Texture coordinates linear * (x, z) + offset.
TriMesh make_relief_square(const glm::mat2& linear, const glm::vec2& offset) {
  return make_front_square(
      [&](const glm::vec2& uv) { return linear * (2.0f * uv - 1.0f) + offset; });
}

const MeshFrame kFrame{{0, 0, 0}, std::sqrt(2.0), "z"};

ImageRgba8 draw_relief(const TriMesh& mesh, const ImageRgba8* normal_map,
                       const MeshStyle& style = plain_style(kReliefSize),
                       const IndexMap* map = nullptr, const ImageRgba8* texture = nullptr) {
  return MeshRenderer(shared_context().gl(), mesh, kFrame, texture, style, map, normal_map)
      .draw(front_view());
}

void expect_lit(const Rgba8& seen, const glm::dvec3& normal, const char* what) {
  const MeshStyle style = plain_style(kReliefSize);
  const glm::vec3 c = shade(style.lighting, style.base_color, glm::vec3(glm::normalize(normal)));
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(seen[static_cast<std::size_t>(k)], srgb8_from_linear(c[k]), 1) << what << " " << k;
}

constexpr Rgba8 kTilted{200, 150, 210, 255};

TEST(NormalMap, FlatOneChangesNothing) {
  const TriMesh square = make_relief_square(glm::mat2(0.5f), glm::vec2(0.5f));
  const ImageRgba8 flat(4, 4, encode_normal({0, 0, 1}));
  expect_lit(at_square(draw_relief(square, &flat), 0.3, 0.2), {0.004, -1, 0.004}, "flat");
}

// The tangent is where u grows, the bitangent where v grows, mirrored charts included: whatever the
// affine map, seeded, the normal is that of the closed form.
TEST(NormalMap, IsRelativeToWhereTheTextureRuns) {
  Random random(5);
  const ImageRgba8 map(4, 4, kTilted);
  int n_mirrored = 0;
  for (int round = 0; round < 24; ++round) {
    // Turned and mirrored: tangents and bitangents across each other, so both are known.
    const double angle = random.uniform(0, 6.28);
    const bool is_mirrored = round % 2 != 0;
    const glm::dvec2 t(std::cos(angle), std::sin(angle));
    const glm::dvec2 b = glm::dvec2(-t.y, t.x) * (is_mirrored ? -1.0 : 1.0);
    const glm::mat2 uv_from_xz = glm::mat2(glm::transpose(glm::dmat2(t, b)));
    const TriMesh square = make_relief_square(0.3f * uv_from_xz, {0.2f, 0.9f});
    n_mirrored += is_mirrored;
    for (const auto y : {NormalMapY::up, NormalMapY::down})
      for (const bool flip_v : {false, true}) {
        MeshStyle style = plain_style(kReliefSize);
        style.normal_map_y = y;
        style.flip_v = flip_v;
        const glm::dvec3 n = decode_normal(kTilted, y);
        const glm::dvec2 xz = n.x * t + (flip_v ? -n.y : n.y) * b;
        const Rgba8 seen = at_square(draw_relief(square, &map, style), 0.1, -0.2);
        expect_lit(seen, {xz.x, -n.z, xz.y}, is_mirrored ? "mirrored" : "straight");
      }
  }
  EXPECT_EQ(n_mirrored, 12);
}

TEST(NormalMap, FollowsTheVertexNormals) {
  TriMesh square = make_relief_square(glm::mat2(0.5f), glm::vec2(0.5f));
  square.normals.assign(4, glm::normalize(glm::vec3(1, -1, 0)));
  const ImageRgba8 map(4, 4, kTilted);
  const glm::dvec3 n = decode_normal(kTilted), along = glm::normalize(glm::dvec3(1, 1, 0));
  expect_lit(at_square(draw_relief(square, &map), 0.3, 0.2),
             n.x * along + n.y * glm::dvec3(0, 0, 1) + n.z * glm::dvec3(square.normals[0]),
             "tilted normals");
  MeshStyle style = plain_style(kReliefSize);
  style.normals = NormalSource::flat;
  expect_lit(at_square(draw_relief(square, &map, style), 0.3, 0.2), {n.x, -n.z, n.y},
             "flat normals");
}

// Codes are linear: the mean of two in the middle between texels; and rows run from the top.
TEST(NormalMap, IsFilteredAsNumbers) {
  const TriMesh square = make_relief_square(glm::mat2(0.5f), glm::vec2(0.5f));
  const Rgba8 low{128, 60, 220, 255}, high{128, 230, 200, 255};
  ImageRgba8 map(1, 4, high);
  map.at(0, 2) = map.at(0, 3) = low;
  const ImageRgba8 image = draw_relief(square, &map);
  const auto lit = [](const glm::dvec3& n) { return glm::dvec3(n.x, -n.z, n.y); };
  expect_lit(at_square(image, 0.3, 0.5), lit(decode_normal(high)), "above");
  expect_lit(at_square(image, 0.3, -0.5), lit(decode_normal(low)), "below");
  const glm::dvec3 middle = 0.5 * (decode_normal(low) + decode_normal(high));
  const Rgba8 seen = at_square(image, 0.3, 0);
  const Rgba8 a = at_square(image, 0.3, 0.5), b = at_square(image, 0.3, -0.5);
  EXPECT_LT(std::min(a[0], b[0]), seen[0]);
  const MeshStyle style = plain_style(kReliefSize);
  const glm::vec3 expected =
      shade(style.lighting, style.base_color, glm::vec3(glm::normalize(lit(middle))));
  EXPECT_NEAR(seen[0], srgb8_from_linear(expected.x), 8);  // within half a pixel of the middle
}

// The indexing map is looked up first, with a texture beside and without.
TEST(NormalMap, IsLookedUpThroughAnIndexingMap) {
  const TriMesh square = make_relief_square(glm::mat2(0.5f), glm::vec2(0.5f));
  ImageRgba8 map(8, 8, encode_normal({0, 0, 1}));
  for (int y = 0; y < 8; ++y)
    for (int x = 4; x < 8; ++x) map.at(x, y) = kTilted;
  const IndexMap right(4, 4, glm::vec2(0.75f, 0.5f)), left(4, 4, glm::vec2(0.25f, 0.5f));
  const ImageRgba8 white(2, 2, {255, 255, 255, 255});
  const glm::dvec3 n = decode_normal(kTilted);
  for (const ImageRgba8* texture : {static_cast<const ImageRgba8*>(nullptr), &white}) {
    const Rgba8 tilted =
        at_square(draw_relief(square, &map, plain_style(kReliefSize), &right, texture), -0.5, 0.3);
    const Rgba8 straight =
        at_square(draw_relief(square, &map, plain_style(kReliefSize), &left, texture), 0.5, 0.3);
    if (!texture) expect_lit(tilted, {n.x, -n.z, n.y}, "the right half, seen on the left");
    if (!texture) expect_lit(straight, {0.004, -1, 0.004}, "the left half, seen on the right");
    EXPECT_GT(std::abs(int{tilted[0]} - int{straight[0]}), 10);
  }
}

TEST(NormalMap, IsNotSeenUnlitAndWantsCoordinates) {
  TriMesh square = make_relief_square(glm::mat2(0.5f), glm::vec2(0.5f));
  const ImageRgba8 map(4, 4, kTilted);
  MeshStyle style = plain_style(kReliefSize);
  style.lit = false;
  EXPECT_EQ(draw_relief(square, &map, style).pixels, draw_relief(square, nullptr, style).pixels);
  square.texcoords.clear();
  EXPECT_THROW(draw_relief(square, &map), BugError);
}

}  // namespace
}  // namespace viewcell

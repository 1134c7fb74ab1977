// A texture through an indexing map on GL, against its twin here, and against the mesh without one.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/error.h"
#include "base/random.h"
#include "base/srgb.h"
#include "draw/front_square.h"
#include "draw/gl_fixture.h"
#include "draw/index_map_lookup.h"
#include "draw/mesh_renderer.h"
#include "image/pixels.h"

namespace viewcell {
namespace {

constexpr int kLookupSize = 192;

MeshStyle unlit_style() {
  MeshStyle style = plain_style(kLookupSize);
  style.lit = false;
  return style;
}

ImageRgba8 draw_through_map(const TriMesh& mesh, const ImageRgba8& texture, const IndexMap* map,
                            const Camera& view = front_view(),
                            const MeshStyle& style = unlit_style()) {
  const MeshFrame frame = make_frame(box_of_triangles(mesh), "z", "mesh");
  return MeshRenderer(shared_context().gl(), mesh, frame, &texture, style, map).draw(view);
}

// place(u, v) at every texel's centre.
template <typename Place>
IndexMap make_map(int width_px, int height_px, const Place& place) {
  IndexMap map(width_px, height_px);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x)
      map.at(x, y) = place(glm::vec2((x + 0.5) / width_px, 1 - (y + 0.5) / height_px));
  return map;
}

glm::vec2 same(const glm::vec2& uv) {
  return uv;
}

// Waves that no symmetry hides; with noise, colours differ from texel to texel.
ImageRgba8 make_waves(int width_px, int height_px, int noise, Random& random) {
  ImageRgba8 image(width_px, height_px);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) {
      const double u = glm::two_pi<double>() * x / width_px;
      const double v = glm::two_pi<double>() * y / height_px;
      const double waves[3] = {std::sin(2 * u + v), std::cos(u - 3 * v), std::sin(u) * std::cos(v)};
      for (std::size_t c = 0; c < 3; ++c)
        image.at(x, y)[c] =
            static_cast<std::uint8_t>(120 + 60 * waves[c] + random.below(std::uint32_t(noise) + 1));
      image.at(x, y)[3] = 255;
    }
  return image;
}

TEST(IndexMap, IdentityChangesNothing) {
  Random random(1);
  const ImageRgba8 texture = make_waves(96, 64, 60, random);
  for (const float repeats : {1.f, 3.f, 17.f})  // magnified and minified
    for (const bool flip_v : {false, true}) {
      const TriMesh mesh = make_front_square(
          [&](const glm::vec2& uv) { return repeats * uv - glm::vec2(1.3f, 0.4f); });
      MeshStyle style = unlit_style();
      style.flip_v = flip_v;
      for (const glm::ivec2 size : {glm::ivec2(96, 64), glm::ivec2(31, 50), glm::ivec2(1, 1)}) {
        const IndexMap map = make_map(size.x, size.y, same);
        for (const Camera& view : {front_view(), make_views(3)[0], make_views(3)[1]}) {
          const ImageRgba8 plain = draw_through_map(mesh, texture, nullptr, view, style);
          EXPECT_LE(most_difference(draw_through_map(mesh, texture, &map, view, style), plain), 1)
              << repeats << " " << flip_v << " " << size.x;
        }
      }
    }
}

// An affine map is the mesh with its texture coordinates sent through it: places, and derivatives
// for mipmaps too. Seeded.
TEST(IndexMap, AffineMapsAreAffineTextureCoordinates) {
  Random random(2);
  const ImageRgba8 texture = make_waves(128, 128, 80, random);
  for (int i = 0; i < 12; ++i) {
    const double scale = std::exp2(random.uniform(-1, 3));
    glm::mat2 linear;
    for (int c = 0; c < 2; ++c)
      for (int r = 0; r < 2; ++r) linear[c][r] = static_cast<float>(scale * random.uniform(-1, 1));
    const auto send = [&](const glm::vec2& uv) { return linear * uv + glm::vec2(0.2f, 0.7f); };
    const auto inner = [](const glm::vec2& uv) { return 0.1f + 0.8f * uv; };  // off the sides
    const IndexMap map = make_map(64, 48, send);
    for (const Camera& view : {front_view(), make_views(4)[1]}) {
      const ImageRgba8 seen = draw_through_map(make_front_square(inner), texture, &map, view);
      const ImageRgba8 expected =
          draw_through_map(make_front_square([&](const glm::vec2& uv) { return send(inner(uv)); }),
                           texture, nullptr, view);
      EXPECT_LE(most_difference(seen, expected), 2) << i;
    }
  }
}

// --- the twin ---

glm::dvec2 map_at(const IndexMap& map, int x, int y) {  // y up
  const int w = map.width_px, h = map.height_px;
  const int wrapped_x = (x % w + w) % w, wrapped_y = (y % h + h) % h;
  return glm::dvec2(map.at(wrapped_x, h - 1 - wrapped_y)) * glm::dvec2(w, h) +
         glm::dvec2(x - wrapped_x, y - wrapped_y);
}

bool jumps(const IndexMap& map, int x, int y, int dx, int dy) {
  const auto at = [&](int k) { return map_at(map, x + k * dx, y + k * dy); };
  const glm::dvec2 before = at(0) - at(-1), here = at(1) - at(0), after = at(2) - at(1);
  for (int k = 0; k < 2; ++k) {
    const double slack = kJumpTexels + 0.5 * std::max(std::abs(before[k]), std::abs(after[k]));
    if (here[k] < std::min({before[k], after[k], 0.0}) - slack ||
        here[k] > std::max({before[k], after[k], 0.0}) + slack)
      return true;
  }
  return false;
}

struct Place {
  glm::dvec2 uv;
  bool is_jump, is_near_tie;
};

Place look_up(const IndexMap& map, const glm::dvec2& uv) {
  const glm::dvec2 size(map.width_px, map.height_px), at = uv * size - 0.5;
  const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
  const glm::dvec2 f = at - glm::floor(at);
  const bool is_jump = jumps(map, x, y, 1, 0) || jumps(map, x, y + 1, 1, 0) ||
                       jumps(map, x, y, 0, 1) || jumps(map, x + 1, y, 0, 1);
  const double to_side = std::min({f.x, f.y, 1 - f.x, 1 - f.y});
  const double to_middle = std::min(std::abs(f.x - 0.5), std::abs(f.y - 0.5));
  if (is_jump)
    return {map_at(map, x + (f.x >= 0.5), y + (f.y >= 0.5)) / size, true,
            std::min(to_side, to_middle) < 1e-3};
  const glm::dvec2 low = glm::mix(map_at(map, x, y), map_at(map, x + 1, y), f.x);
  const glm::dvec2 high = glm::mix(map_at(map, x, y + 1), map_at(map, x + 1, y + 1), f.x);
  return {glm::mix(low, high, f.y) / size, false, to_side < 1e-3};
}

// The texture's finest level, bilinear, repeated, in linear light.
Rgba8 sample(const ImageRgba8& image, const glm::dvec2& uv) {
  const double x = uv.x * image.width_px - 0.5, y = (1 - uv.y) * image.height_px - 0.5;
  const auto wrap = [](int i, int n) { return (i % n + n) % n; };
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  Rgba8 out{0, 0, 0, 255};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto texel = [&](int i, int j) {
      return srgb_decode(image.at(wrap(x0 + i, image.width_px), wrap(y0 + j, image.height_px))[c] /
                         255.f);
    };
    const double low = glm::mix(double(texel(0, 0)), double(texel(1, 0)), x - x0);
    const double high = glm::mix(double(texel(0, 1)), double(texel(1, 1)), x - x0);
    out[c] = srgb8_from_linear(static_cast<float>(glm::mix(low, high, y - y0)));
  }
  return out;
}

// Where the ray through a pixel's centre meets the square.
glm::dvec2 uv_of_pixel(int x, int y) {
  const glm::dmat4 frame_from_clip = glm::inverse(clip_from_world(front_view()));
  const glm::dvec4 p = frame_from_clip * glm::dvec4(2 * (x + 0.5) / kLookupSize - 1,
                                                    1 - 2 * (y + 0.5) / kLookupSize, 0.01, 1);
  const glm::dvec3 eye = front_view().eye, ray = glm::dvec3(p) / p.w - eye;
  const glm::dvec3 hit = eye - eye.y / ray.y * ray;  // in radii of sqrt(2)
  return 0.5 + 0.5 * glm::root_two<double>() * glm::dvec2(hit.x, hit.z);
}

// Smooth bends, and charts that lie anywhere: seeded.
IndexMap make_charts(int width_px, int height_px, Random& random) {
  const auto phase = static_cast<float>(random.uniform(0, 6));
  IndexMap map = make_map(width_px, height_px, [&](const glm::vec2& uv) {
    return uv + 0.03f * glm::vec2(std::sin(9 * uv.y + phase), std::cos(7 * uv.x + phase));
  });
  for (int i = 0; i < 3; ++i) {
    const int x = static_cast<int>(random.below(std::uint32_t(width_px) - 8));
    const int y = static_cast<int>(random.below(std::uint32_t(height_px) - 8));
    const glm::vec2 shift(random.uniform(0.3, 0.6), random.uniform(0.3, 0.6));
    for (int dy = 0; dy < 8; ++dy)
      for (int dx = 0; dx < 8; ++dx) map.at(x + dx, y + dy) += shift;
  }
  return map;
}

TEST(IndexMap, DrawsWhatItsTwinComputes) {
  Random random(3);
  const ImageRgba8 texture = make_waves(24, 32, 40, random);
  std::size_t n_plain = 0, n_jumps = 0;
  for (int i = 0; i < 4; ++i) {
    const IndexMap map = make_charts(32, 40, random);
    const ImageRgba8 image = draw_through_map(make_front_square(same), texture, &map);
    for (int y = 0; y < kLookupSize; ++y)
      for (int x = 0; x < kLookupSize; ++x) {
        const glm::dvec2 uv = uv_of_pixel(x, y);
        if (std::min({uv.x, uv.y, 1 - uv.x, 1 - uv.y}) < 0.01) continue;
        const Place place = look_up(map, uv);
        if (place.is_near_tie) continue;
        const Rgba8 expected = sample(texture, place.uv);
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(image.at(x, y)[c], expected[c], 2)
              << "map " << i << " pixel " << x << "," << y << " jump " << place.is_jump;
        ++(place.is_jump ? n_jumps : n_plain);
      }
  }
  EXPECT_GT(n_plain, 20000u);
  EXPECT_GT(n_jumps, 1000u);
}

// Two charts, red and blue; halfway between them the texture is green, and nothing may be.
TEST(IndexMap, NothingForeignIsSeenBetweenCharts) {
  ImageRgba8 texture(60, 60, {10, 200, 10, 255});
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 20; ++x) {
      texture.at(x, y) = {200, 10, 10, 255};
      texture.at(40 + x, y) = {10, 10, 200, 255};
    }
  const IndexMap map = make_map(60, 60, [](const glm::vec2& uv) {
    return glm::vec2(uv.x < 0.5f ? 0.05f + 0.4f * uv.x : 0.55f + 0.4f * uv.x, uv.y);
  });
  for (const Camera& view : {front_view(), make_views(3)[1]}) {
    const ImageRgba8 image = draw_through_map(make_front_square(same), texture, &map, view);
    std::size_t n_red = 0, n_blue = 0;
    for (const Rgba8& p : image.pixels) {
      if (p[3] == 0) continue;
      EXPECT_LT(p[1], 100);
      n_red += p[0] > 150, n_blue += p[2] > 150;
    }
    EXPECT_GT(n_red, 1000u);
    EXPECT_GT(n_blue, 1000u);
  }
}

// At a jump the places of neighbouring pixels are far apart; the mipmap is still the mesh's own.
// Black and white stripes would go gray there. (A map of 32 texels has all jumps between quads.)
TEST(IndexMap, JumpsDoNotBlurTheTexture) {
  ImageRgba8 texture(32, 32, {0, 0, 0, 255});
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      if (y / 4 % 2 == 1) texture.at(x, y) = {255, 255, 255, 255};
  std::size_t n = 0;
  for (const float jump : {0.32f, 0.44f, 0.5f, 0.57f, 0.66f}) {
    const IndexMap map = make_map(27, 32, [jump](const glm::vec2& uv) {
      return glm::vec2(uv.x < jump ? uv.x : uv.x + 16, uv.y);
    });
    const ImageRgba8 image = draw_through_map(make_front_square(same), texture, &map);
    for (int y = 0; y < kLookupSize; ++y)
      for (int x = 0; x < kLookupSize; ++x) {
        const glm::dvec2 uv = uv_of_pixel(x, y);
        const double in_stripe = std::fmod(32 * uv.y, 4);  // its sides are at 0 and 4
        if (std::abs(uv.x - jump) > 0.05 || std::abs(uv.y - 0.5) > 0.45) continue;
        if (std::abs(in_stripe - 2) > 0.9) continue;
        const int red = image.at(x, y)[0];
        EXPECT_TRUE(red < 2 || red > 253) << red << " at " << x << "," << y;
        ++n;
      }
  }
  EXPECT_GT(n, 1000u);
}

TEST(IndexMap, WithoutATextureIsABug) {
  const TriMesh mesh = make_front_square(same);
  const IndexMap map = make_map(4, 4, same);
  EXPECT_THROW(MeshRenderer(shared_context().gl(), mesh, MeshFrame{}, nullptr, unlit_style(), &map),
               BugError);
}

}  // namespace
}  // namespace viewcell

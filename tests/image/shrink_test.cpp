#include "image/shrink.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "image/io.h"
#include "image/jpeg.h"
#include "image/metrics.h"
#include "image/random_image.h"

namespace viewcell {
namespace {

//  black white     half the light is sRGB 188, half the code is 128
//  white black
TEST(Shrink, ColoursMixAsLight) {
  ImageRgba8 image(2, 2, {0, 0, 0, 255});
  image.at(1, 0) = image.at(0, 1) = {255, 255, 255, 255};
  EXPECT_EQ(shrink(image, 1, 1, PixelKind::color).pixels[0], (Rgba8{188, 188, 188, 255}));
  EXPECT_EQ(shrink(image, 1, 1, PixelKind::data).pixels[0], (Rgba8{128, 128, 128, 255}));
}

// 3 pixels to 2: each new one has one and a half.
TEST(Shrink, PixelsAreDivided) {
  ImageRgba8 image(3, 1);
  image.pixels = {{30, 0, 0, 255}, {60, 0, 0, 0}, {240, 0, 0, 255}};
  const ImageRgba8 out = shrink(image, 2, 1, PixelKind::data);
  EXPECT_EQ(out.pixels[0], (Rgba8{40, 0, 0, 170}));
  EXPECT_EQ(out.pixels[1], (Rgba8{180, 0, 0, 170}));
}

TEST(Shrink, KeepsWhatIsSmallAndTheShape) {
  Random random(4);
  const ImageRgba8 image = random_image(60, 30, random);
  for (const PixelKind kind : {PixelKind::color, PixelKind::data}) {
    EXPECT_EQ(shrink(image, 60, 30, kind).pixels, image.pixels);
    EXPECT_EQ(shrink_to_side(image, 60, kind).pixels, image.pixels);
    const ImageRgba8 small = shrink_to_side(image, 20, kind, 1);
    EXPECT_EQ(small.width_px, 20);
    EXPECT_EQ(small.height_px, 10);
    EXPECT_EQ(shrink_to_side(image, 20, kind, 4).pixels, small.pixels);
  }
  EXPECT_EQ(shrink_to_side(ImageRgba8(300, 1, {1, 2, 3, 4}), 20, PixelKind::data).height_px, 1);
}

// A smooth picture comes back nearly as it was, worse and smaller with less quality.
TEST(Jpeg, ComesBackByItsQuality) {
  ImageRgba8 image(64, 48);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x)
      image.at(x, y) = {static_cast<std::uint8_t>(4 * x), static_cast<std::uint8_t>(5 * y),
                        static_cast<std::uint8_t>(2 * (x + y)), 255};
  const std::string good = encode_jpeg(image, {.quality = 95, .halves_hues = false}),
                    bad = encode_jpeg(image, {.quality = 10});
  EXPECT_LT(bad.size(), good.size());
  const ImageRgba8 back = decode_image_rgba8(good, "a.jpg");
  for (std::size_t i = 0; i < back.pixels.size(); ++i)
    for (std::size_t c = 0; c < 4; ++c)
      ASSERT_NEAR(back.pixels[i][c], image.pixels[i][c], c < 3 ? 6 : 0);
  EXPECT_EQ(encode_jpeg(image, {.quality = 10}), bad);
}

TEST(Jpeg, QualitiesAreFoundAgain) {
  const ImageRgba8 image(16, 16, {100, 150, 200, 255});
  for (const int quality : {1, 10, 30, 49, 50, 75, 90, 95, 99, 100}) {
    const std::string bytes = encode_jpeg(image, {.quality = quality});
    EXPECT_EQ(measure_jpeg_quality(bytes), quality);
    for (std::size_t n = 0; n < bytes.size(); ++n)  // cut short: the same, or none
      EXPECT_TRUE(measure_jpeg_quality(bytes.substr(0, n)) % quality == 0) << n;
  }
  EXPECT_EQ(measure_jpeg_quality(encode_png(image)), 0);
  EXPECT_EQ(measure_jpeg_quality(""), 0);
}

}  // namespace
}  // namespace viewcell

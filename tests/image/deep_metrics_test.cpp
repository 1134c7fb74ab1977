#include "image/deep_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/srgb.h"
#include "image/random_image.h"

namespace viewcell {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

DeepImage plain(SampleKind kind, float value, float alpha, int side = 12) {
  DeepImage image;
  image.kind = kind;
  image.samples = ImageRgbaFloat(side, side, {value, value, value, alpha});
  return image;
}
DeepImage plain16(float value) {
  return plain(SampleKind::code16, value, 65535);
}
DeepImage plain_linear(float value) {
  return plain(SampleKind::linear, value, 1);
}

DeepImage of_codes(const ImageRgba8& codes) {
  DeepImage image;
  image.codes = codes;
  return image;
}

// The same picture in 16 bits.
DeepImage widen(const ImageRgba8& codes) {
  DeepImage image;
  image.kind = SampleKind::code16;
  image.samples = ImageRgbaFloat(codes.width_px, codes.height_px);
  for (std::size_t p = 0; p < codes.pixels.size(); ++p)
    for (std::size_t c = 0; c < 4; ++c) image.samples.pixels[p][c] = 257.f * codes.pixels[p][c];
  return image;
}

TEST(DeepMetrics, AHundredOf65535Is56Point33Db) {
  const ImageDistance d = compare_deep_images(plain16(40000), plain16(40100));
  EXPECT_NEAR(d.psnr_db, 20 * std::log10(655.35), 1e-9);
  EXPECT_NEAR(d.psnr_db, 56.33, 5e-3);
  EXPECT_NEAR(d.psnr_rgb_db, d.psnr_db, 1e-9);
  EXPECT_DOUBLE_EQ(d.rms, 100);
  EXPECT_EQ(d.max_abs, 100);
  EXPECT_EQ(d.peak, 65535);
  EXPECT_EQ(d.compared_as, ComparedAs::codes16);
}

TEST(DeepMetrics, SixteenBitsOfEightAreAsFarApart) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    ImageRgba8 a = random_image(17, 13, random);
    const ImageRgba8 b = random_image(17, 13, random);
    for (Rgba8& p : a.pixels) p[3] = random.below(2) ? 255 : 0;
    const ImageDistance narrow = compare_images(a, b),
                        wide = compare_deep_images(widen(a), widen(b));
    EXPECT_NEAR(wide.psnr_db, narrow.psnr_db, 1e-9);
    EXPECT_NEAR(wide.psnr_rgb_db, narrow.psnr_rgb_db, 1e-9);
    EXPECT_NEAR(wide.psnr_covered_db, narrow.psnr_covered_db, 1e-9);
    EXPECT_NEAR(wide.psnr_rgb_covered_db, narrow.psnr_rgb_covered_db, 1e-9);
    EXPECT_NEAR(wide.ssim, narrow.ssim, 1e-9);
    EXPECT_NEAR(wide.snr_db, narrow.snr_db, 1e-9);
    EXPECT_EQ(wide.n_covered, narrow.n_covered);
    EXPECT_EQ(wide.n_alpha_differs, narrow.n_alpha_differs);
    EXPECT_NEAR(wide.max_abs, 257 * narrow.max_abs, 1e-6);
    // Of two depths: in [0, 1], and the same decibels again.
    const ImageDistance mixed = compare_deep_images(of_codes(a), widen(b));
    EXPECT_NEAR(mixed.psnr_db, narrow.psnr_db, 1e-6);
    EXPECT_NEAR(mixed.max_abs, narrow.max_abs / 255, 1e-9);
    EXPECT_EQ(mixed.compared_as, ComparedAs::unit);
    EXPECT_EQ(compare_deep_images(of_codes(a), widen(a)).psnr_db, 100);
  }
}

TEST(DeepMetrics, LinearLightIsNotClipped) {
  const DeepImage a = plain_linear(2), b = plain_linear(5);
  EXPECT_NEAR(compare_deep_images(a, b).psnr_db, -20 * std::log10(3), 1e-9);
  EXPECT_NEAR(compare_deep_images(a, b, {.peak = 30}).psnr_db, 20, 1e-9);
  EXPECT_EQ(compare_deep_images(a, b, {.peak = 30}).peak, 30);
  EXPECT_EQ(compare_deep_images(a, b).max_abs, 3);
  EXPECT_EQ(compare_deep_images(plain_linear(-1), plain_linear(-1)).psnr_db, 100);
  EXPECT_NEAR(compare_deep_images(plain_linear(-1), plain_linear(0)).psnr_db, 0, 1e-9);
}

// Linear beside encoded: clamped and encoded, as it would be shown.
TEST(DeepMetrics, LinearBesideEncodedIsEncoded) {
  const float half = srgb_decode(128 / 255.f);
  EXPECT_GT(
      compare_deep_images(of_codes({12, 12, {128, 128, 128, 255}}), plain_linear(half)).psnr_db,
      90);
  EXPECT_EQ(compare_deep_images(of_codes({12, 12, {255, 255, 255, 255}}), plain_linear(9)).psnr_db,
            100);
}

TEST(DeepMetrics, PixelsThatAreNotFiniteAreLeftOutAndCounted) {
  DeepImage a = plain_linear(0.5f), b = plain_linear(0.75f);
  a.samples.at(1, 1)[0] = b.samples.at(1, 1)[0] = kNan;
  b.samples.at(2, 2)[2] = kInfinite;
  b.samples.at(3, 3)[3] = -kInfinite;
  const ImageDistance d = compare_deep_images(a, b);
  EXPECT_EQ(d.n_not_finite, 3u);
  EXPECT_EQ(d.n_not_finite_in_one, 2u);
  EXPECT_NEAR(d.mse, 1.0 / 16, 1e-12);
  EXPECT_NEAR(d.mse_rgb, 1.0 / 16, 1e-12);
  EXPECT_TRUE(std::isfinite(d.ssim));
  EXPECT_TRUE(std::isnan(compare_deep_images(plain_linear(kNan), b).psnr_db));
  EXPECT_EQ(difference_of_deep_images(a, b, 1).at(1, 1), (Rgba8{255, 64, 64, 255}));
}

TEST(DeepMetrics, DifferencesAreSharesOfFullScale) {
  const ImageRgba8 d = difference_of_deep_images(plain16(1000), plain16(1000 + 257 * 3), 10);
  EXPECT_EQ(d.at(0, 0), (Rgba8{30, 30, 30, 255}));
}

// Luminance is blind to colours of one brightness: 0.299 * 200 is nearly 0.587 * 102.
TEST(Metrics, RgbSeesWhatLuminanceDoesNot) {
  const ImageDistance d = compare_images({8, 8, {200, 0, 0, 255}}, {8, 8, {0, 102, 0, 255}});
  EXPECT_GT(d.psnr_db, 70);
  EXPECT_NEAR(d.mse_rgb, (200.0 * 200 + 102 * 102) / 3, 1e-9);
  EXPECT_NEAR(d.psnr_rgb_db, 10 * std::log10(65025 / d.mse_rgb), 1e-9);
}

}  // namespace
}  // namespace viewcell

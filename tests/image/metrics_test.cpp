#include "image/metrics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "image/random_image.h"
#include "image/ssim.h"

namespace viewcell {
namespace {

ImageRgba8 opaque_gray(int width, int height, std::uint8_t value) {
  return {width, height, {value, value, value, 255}};
}

ImageRgba8 random_sized_image(Random& random) {
  const int width = 1 + static_cast<int>(random.below(30));
  return random_image(width, 1 + static_cast<int>(random.below(30)), random);
}

double luminance_of(const Rgba8& p) {
  return 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
}

TEST(Metrics, APictureIsAtNoDistanceFromItself) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const ImageRgba8 a = random_sized_image(random);
    const ImageDistance d = compare_images(a, a);
    EXPECT_EQ(d.psnr_db, 100);
    EXPECT_EQ(d.psnr_covered_db, 100);
    EXPECT_EQ(d.snr_db, 100);
    EXPECT_EQ(d.ssim, 1);
    EXPECT_EQ(d.mse, 0);
    EXPECT_EQ(d.rms, 0);
    EXPECT_EQ(d.max_abs, 0);
    EXPECT_EQ(d.width_px, a.width_px);
    EXPECT_EQ(d.height_px, a.height_px);
  }
}

TEST(Metrics, AnOffsetOfOneIs48Point13Db) {
  const ImageDistance d = compare_images(opaque_gray(40, 30, 100), opaque_gray(40, 30, 101));
  EXPECT_NEAR(d.psnr_db, 48.1308, 1e-4);
  EXPECT_NEAR(d.psnr_covered_db, 48.1308, 1e-4);
  EXPECT_DOUBLE_EQ(d.mse, 1);
  EXPECT_DOUBLE_EQ(d.rms, 1);
  EXPECT_EQ(d.max_abs, 1);
  EXPECT_NEAR(d.snr_db, 20 * std::log10(101.0), 1e-9);
}

TEST(Metrics, ConstantOffsetsHaveAClosedForm) {
  for (int offset = 1; offset <= 155; offset += 11) {
    const auto d = compare_images(opaque_gray(12, 12, 100),
                                  opaque_gray(12, 12, static_cast<std::uint8_t>(100 + offset)));
    EXPECT_DOUBLE_EQ(d.mse, offset * offset);
    EXPECT_NEAR(d.psnr_db, 20 * std::log10(255.0 / offset), 1e-9);
    // No structure: only the term of the means is left.
    const double b = 100 + offset, c1 = 6.5025;
    EXPECT_NEAR(d.ssim, (200 * b + c1) / (10000 + b * b + c1), 1e-9);
  }
  EXPECT_NEAR(compare_images(opaque_gray(4, 4, 0), opaque_gray(4, 4, 255)).psnr_db, 0, 1e-12);
}

TEST(Metrics, LuminanceWeighsChannelsAndMaxAbsDoesNot) {
  const std::array<double, 3> weights = {0.299, 0.587, 0.114};
  for (std::size_t c = 0; c < 3; ++c) {
    ImageRgba8 a = opaque_gray(10, 10, 50), b = a;
    b.at(3, 4)[c] = 150;
    const ImageDistance d = compare_images(a, b);
    EXPECT_NEAR(d.mse, std::pow(100 * weights[c], 2) / 100, 1e-9);
    EXPECT_EQ(d.max_abs, 100);
  }
}

TEST(Metrics, AgreesWithTheDefinitionOnRandomPictures) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    ImageRgba8 a = random_sized_image(random);
    ImageRgba8 b = random_image(a.width_px, a.height_px, random);
    double sum = 0, sum_covered = 0, signal = 0;
    std::size_t n_covered = 0;
    for (std::size_t p = 0; p < a.pixels.size(); ++p) {
      if (random.below(2)) a.pixels[p][3] = 0;
      if (random.below(2)) b.pixels[p][3] = 0;
      const double y = luminance_of(b.pixels[p]), e = y - luminance_of(a.pixels[p]);
      sum += e * e;
      signal += y * y;
      if (a.pixels[p][3] == 0 && b.pixels[p][3] == 0) continue;
      sum_covered += e * e;
      ++n_covered;
    }
    const ImageDistance d = compare_images(a, b, {.ssim = false});
    const auto n = static_cast<double>(a.pixels.size());
    EXPECT_NEAR(d.mse, sum / n, 1e-6);
    EXPECT_NEAR(d.rms, std::sqrt(sum / n), 1e-6);
    EXPECT_NEAR(d.psnr_db, 10 * std::log10(65025 * n / sum), 1e-6);
    EXPECT_NEAR(d.snr_db, 10 * std::log10(signal / sum), 1e-6);
    EXPECT_EQ(d.n_covered, n_covered);
    if (n_covered > 0) {
      EXPECT_NEAR(d.mse_covered, sum_covered / static_cast<double>(n_covered), 1e-6);
    }
    EXPECT_TRUE(std::isnan(d.ssim));
  }
}

TEST(Metrics, CoverageIsWhereEitherPictureHasAnObject) {
  ImageRgba8 a(10, 1, {100, 100, 100, 0}), b = a;
  b.at(0, 0) = {110, 110, 110, 0};  // an error on the ground
  ImageDistance d = compare_images(a, b);
  EXPECT_EQ(d.n_covered, 0u);
  EXPECT_EQ(d.psnr_covered_db, 100);
  EXPECT_DOUBLE_EQ(d.mse, 10);
  a.at(5, 0)[3] = 255;  // an object in the one, drawn right
  b.at(7, 0)[3] = 1;    // in the other, however faint
  d = compare_images(a, b);
  EXPECT_EQ(d.n_covered, 2u);
  EXPECT_EQ(d.psnr_covered_db, 100);
  b.at(7, 0)[0] = b.at(7, 0)[1] = b.at(7, 0)[2] = 102;
  d = compare_images(a, b);
  EXPECT_DOUBLE_EQ(d.mse_covered, 2);
  EXPECT_DOUBLE_EQ(d.mse, 10.4);
}

// SNR takes its signal from the tested picture, PSNR does not care which is which.
TEST(Metrics, SnrIsOfTheTestedPicture) {
  const ImageRgba8 dark = opaque_gray(5, 5, 50), bright = opaque_gray(5, 5, 100);
  EXPECT_NEAR(compare_images(dark, bright).snr_db, 20 * std::log10(2.0), 1e-9);
  EXPECT_NEAR(compare_images(bright, dark).snr_db, 0, 1e-9);
  EXPECT_EQ(compare_images(dark, bright).psnr_db, compare_images(bright, dark).psnr_db);
  EXPECT_EQ(compare_images(dark, opaque_gray(5, 5, 0)).snr_db, -100);
}

TEST(Metrics, BetterThanTheCapCountsAsTheCap) {
  EXPECT_EQ(psnr_db_of(0), 100);
  EXPECT_EQ(psnr_db_of(1e-12), 100);
  ImageRgba8 a(4096, 512, {0, 0, 0, 255}), b = a;
  b.at(7, 7)[2] = 1;  // 0.114^2 over two million pixels: 130 dB but for the cap
  EXPECT_EQ(compare_images(a, b, {.ssim = false}).psnr_db, 100);
  EXPECT_EQ(compare_images(a, b, {.ssim = false}).max_abs, 1);
}

TEST(Metrics, SumsOfTheLargestDifferencesDoNotOverflow) {
  const ImageDistance d =
      compare_images(opaque_gray(4096, 4096, 0), opaque_gray(4096, 4096, 255), {.ssim = false});
  EXPECT_DOUBLE_EQ(d.mse, 65025);
}

TEST(Metrics, DifferentSizesAreABug) {
  EXPECT_THROW(compare_images(ImageRgba8(2, 3), ImageRgba8(3, 2)), BugError);
  EXPECT_THROW(difference_image(ImageRgba8(2, 3), ImageRgba8(2, 2)), BugError);
}

TEST(Metrics, DifferencePictureIsAmplifiedClampedAndOpaque) {
  ImageRgba8 a(2, 1, {10, 20, 30, 0}), b = a;
  b.at(1, 0) = {13, 100, 29, 7};
  const ImageRgba8 d = difference_image(a, b, 8);
  EXPECT_EQ(d.at(0, 0), (Rgba8{0, 0, 0, 255}));
  EXPECT_EQ(d.at(1, 0), (Rgba8{24, 255, 8, 255}));
  EXPECT_EQ(difference_image(b, a, 8).pixels, d.pixels);
}

// The definition, window by window.
double ssim_by_definition(const ImageRgba8& a, const ImageRgba8& b) {
  const int nx = std::min(11, a.width_px), ny = std::min(11, a.height_px);
  const double c1 = 6.5025, c2 = 58.5225;
  double total = 0;
  int n = 0;
  for (int y = 0; y + ny <= a.height_px; ++y)
    for (int x = 0; x + nx <= a.width_px; ++x, ++n) {
      double w_sum = 0, ma = 0, mb = 0, va = 0, vb = 0, cov = 0;
      for (int pass = 0; pass < 2; ++pass) {
        for (int j = 0; j < ny; ++j)
          for (int i = 0; i < nx; ++i) {
            const double dx = i - (nx - 1) / 2.0, dy = j - (ny - 1) / 2.0;
            const double w = std::exp(-(dx * dx + dy * dy) / (2 * 1.5 * 1.5));
            const double ya = luminance_of(a.at(x + i, y + j)),
                         yb = luminance_of(b.at(x + i, y + j));
            if (pass == 0) {
              w_sum += w, ma += w * ya, mb += w * yb;
            } else {
              va += w / w_sum * (ya - ma) * (ya - ma);
              vb += w / w_sum * (yb - mb) * (yb - mb);
              cov += w / w_sum * (ya - ma) * (yb - mb);
            }
          }
        if (pass == 0) ma /= w_sum, mb /= w_sum;
      }
      total += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
    }
  return total / n;
}

TEST(Ssim, AgreesWithTheDefinition) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const ImageRgba8 a = random_sized_image(random);
    ImageRgba8 b = a;
    const std::uint32_t strength = 1 + random.below(255);
    for (Rgba8& p : b.pixels)
      for (std::size_t c = 0; c < 3; ++c)
        p[c] = static_cast<std::uint8_t>(p[c] ^ random.below(strength));
    const double ssim = mean_ssim(luminance(a), luminance(b));
    EXPECT_NEAR(ssim, ssim_by_definition(a, b), 1e-8);
    EXPECT_NEAR(ssim, mean_ssim(luminance(b), luminance(a)), 1e-12);
    EXPECT_LE(ssim, 1);
    EXPECT_GE(ssim, -1);
  }
}

TEST(Ssim, AnInvertedPictureIsDissimilar) {
  Random random(4);
  const ImageRgba8 a = random_image(40, 40, random);
  ImageRgba8 b = a;
  for (Rgba8& p : b.pixels)
    for (std::size_t c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>(255 - p[c]);
  EXPECT_LT(mean_ssim(luminance(a), luminance(b)), -0.8);
}

}  // namespace
}  // namespace viewcell

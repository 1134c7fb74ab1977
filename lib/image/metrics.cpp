#include "image/metrics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "base/error.h"
#include "image/ssim.h"

namespace viewcell {
namespace {

// In thousandths of a code value, so whole: the square of a difference is below 2^36, and sums over
// the largest picture (2^28 pixels) fit in 64 bits.
constexpr double kUnit = 1000;

std::int32_t luminance_thousandths(const Rgba8& p) {
  return 299 * p[0] + 587 * p[1] + 114 * p[2];
}

struct Sums {
  std::uint64_t error = 0, error_covered = 0, signal = 0;
  std::size_t n_covered = 0;
  int max_abs = 0;
};

Sums sum_differences(const ImageRgba8& reference, const ImageRgba8& tested) {
  Sums sums;
  for (std::size_t p = 0; p < reference.pixels.size(); ++p) {
    const Rgba8 &a = reference.pixels[p], &b = tested.pixels[p];
    const std::int64_t signal = luminance_thousandths(b);
    const std::int64_t error = signal - luminance_thousandths(a);
    const auto squared = static_cast<std::uint64_t>(error * error);
    const bool covered = (a[3] | b[3]) != 0;
    sums.error += squared;
    sums.error_covered += covered ? squared : 0;
    sums.signal += static_cast<std::uint64_t>(signal * signal);
    sums.n_covered += covered;
    const int largest =
        std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
    sums.max_abs = std::max(sums.max_abs, largest);
  }
  return sums;
}

double mean_square(std::uint64_t sum, std::size_t n) {
  return n == 0 ? 0 : static_cast<double>(sum) / (kUnit * kUnit) / static_cast<double>(n);
}

double snr_db_of(std::uint64_t signal, std::uint64_t error) {
  if (error == 0) return kIdenticalDb;
  if (signal == 0) return -kIdenticalDb;
  const double db = 10 * std::log10(static_cast<double>(signal) / static_cast<double>(error));
  return std::clamp(db, -kIdenticalDb, kIdenticalDb);
}

void check_sizes(const ImageRgba8& a, const ImageRgba8& b) {
  VIEWCELL_CHECK(a.width_px == b.width_px && a.height_px == b.height_px && !a.empty(), a.width_px,
                 a.height_px, b.width_px, b.height_px);
}

}  // namespace

double psnr_db_of(double mse) {
  return mse > 0 ? std::min(kIdenticalDb, 10 * std::log10(255.0 * 255.0 / mse)) : kIdenticalDb;
}

ImageDistance compare_images(const ImageRgba8& reference, const ImageRgba8& tested,
                             const CompareOptions& options) {
  check_sizes(reference, tested);
  const Sums sums = sum_differences(reference, tested);
  ImageDistance d;
  d.width_px = reference.width_px;
  d.height_px = reference.height_px;
  d.mse = mean_square(sums.error, reference.pixels.size());
  d.mse_covered = mean_square(sums.error_covered, sums.n_covered);
  d.n_covered = sums.n_covered;
  d.psnr_db = psnr_db_of(d.mse);
  d.psnr_covered_db = psnr_db_of(d.mse_covered);
  d.snr_db = snr_db_of(sums.signal, sums.error);
  d.rms = std::sqrt(d.mse);
  d.max_abs = sums.max_abs;
  d.ssim = options.ssim ? mean_ssim(luminance(reference), luminance(tested))
                        : std::numeric_limits<double>::quiet_NaN();
  return d;
}

ImageRgba8 difference_image(const ImageRgba8& a, const ImageRgba8& b, double gain) {
  check_sizes(a, b);
  ImageRgba8 out(a.width_px, a.height_px, {0, 0, 0, 255});
  for (std::size_t p = 0; p < out.pixels.size(); ++p)
    for (std::size_t c = 0; c < 3; ++c) {
      const double amplified = gain * std::abs(a.pixels[p][c] - b.pixels[p][c]);
      out.pixels[p][c] = static_cast<std::uint8_t>(std::min(255.0, amplified) + 0.5);
    }
  return out;
}

}  // namespace viewcell

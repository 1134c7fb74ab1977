#include "image/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "base/error.h"
#include "image/ssim.h"

namespace viewcell {
namespace {

// In thousandths of a code value, so whole: the square of a difference is below 2^36, and sums over
// a row (of 2^28 pixels at most) fit in 64 bits.
constexpr double kUnit = 1000;

std::int32_t luminance_thousandths(const Rgba8& p) {
  return 299 * p[0] + 587 * p[1] + 114 * p[2];
}

struct RowSums {
  std::uint64_t error = 0, error_covered = 0, signal = 0, rgb = 0, rgb_covered = 0;
};

struct Sums {
  double error = 0, error_covered = 0, signal = 0, rgb = 0, rgb_covered = 0;
  std::size_t n_covered = 0, n_alpha_differs = 0;
  int max_abs = 0;
  void add(const RowSums& row) {
    error += static_cast<double>(row.error);
    error_covered += static_cast<double>(row.error_covered);
    signal += static_cast<double>(row.signal);
    rgb += static_cast<double>(row.rgb);
    rgb_covered += static_cast<double>(row.rgb_covered);
  }
};

void add_pixel(const Rgba8& a, const Rgba8& b, RowSums& row, Sums& sums) {
  const std::int64_t signal = luminance_thousandths(b);
  const std::int64_t error = signal - luminance_thousandths(a);
  const auto squared = static_cast<std::uint64_t>(error * error);
  const std::array<int, 3> d{std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])};
  const auto rgb = static_cast<std::uint64_t>(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  const bool covered = (a[3] | b[3]) != 0;
  row.error += squared;
  row.error_covered += covered ? squared : 0;
  row.signal += static_cast<std::uint64_t>(signal * signal);
  row.rgb += rgb;
  row.rgb_covered += covered ? rgb : 0;
  sums.n_covered += covered;
  sums.n_alpha_differs += a[3] != b[3];
  sums.max_abs = std::max({sums.max_abs, d[0], d[1], d[2]});
}

Sums sum_differences(const ImageRgba8& reference, const ImageRgba8& tested) {
  Sums sums;
  const auto width = static_cast<std::size_t>(reference.width_px);
  for (std::size_t start = 0; start < reference.pixels.size(); start += width) {
    RowSums row;
    for (std::size_t p = start; p < start + width; ++p)
      add_pixel(reference.pixels[p], tested.pixels[p], row, sums);
    sums.add(row);
  }
  return sums;
}

double mean_square(double sum, std::size_t n) {
  return n == 0 ? 0 : sum / (kUnit * kUnit) / static_cast<double>(n);
}

double mean_of_channels(double sum, std::size_t n) {
  return n == 0 ? 0 : sum / 3 / static_cast<double>(n);
}

void check_sizes(const ImageRgba8& a, const ImageRgba8& b) {
  VIEWCELL_CHECK(a.width_px == b.width_px && a.height_px == b.height_px && !a.empty(), a.width_px,
                 a.height_px, b.width_px, b.height_px);
}

}  // namespace

double psnr_db_of(double mse, double peak) {
  if (std::isnan(mse)) return mse;
  return mse > 0 ? std::min(kIdenticalDb, 10 * std::log10(peak * peak / mse)) : kIdenticalDb;
}

double snr_db_of(double signal, double error) {
  if (error == 0) return kIdenticalDb;
  if (signal == 0) return -kIdenticalDb;
  return std::clamp(10 * std::log10(signal / error), -kIdenticalDb, kIdenticalDb);
}

void set_decibels(ImageDistance& d) {
  d.psnr_db = psnr_db_of(d.mse, d.peak);
  d.psnr_covered_db = psnr_db_of(d.mse_covered, d.peak);
  d.psnr_rgb_db = psnr_db_of(d.mse_rgb, d.peak);
  d.psnr_rgb_covered_db = psnr_db_of(d.mse_rgb_covered, d.peak);
  d.rms = std::sqrt(d.mse);
}

ImageDistance compare_images(const ImageRgba8& reference, const ImageRgba8& tested,
                             const CompareOptions& options) {
  check_sizes(reference, tested);
  const Sums sums = sum_differences(reference, tested);
  const std::size_t n = reference.pixels.size();
  ImageDistance d;
  d.width_px = reference.width_px;
  d.height_px = reference.height_px;
  d.peak = options.peak.value_or(255);
  d.mse = mean_square(sums.error, n);
  d.mse_covered = mean_square(sums.error_covered, sums.n_covered);
  d.mse_rgb = mean_of_channels(sums.rgb, n);
  d.mse_rgb_covered = mean_of_channels(sums.rgb_covered, sums.n_covered);
  d.n_covered = sums.n_covered;
  d.n_alpha_differs = sums.n_alpha_differs;
  set_decibels(d);
  d.snr_db = snr_db_of(sums.signal, sums.error);
  d.max_abs = sums.max_abs;
  d.ssim = options.ssim ? mean_ssim(luminance(reference), luminance(tested), d.peak)
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

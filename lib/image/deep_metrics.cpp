#include "image/deep_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/srgb.h"
#include "image/ssim.h"

namespace viewcell {
namespace {

ComparedAs choose_units(const DeepImage& a, const DeepImage& b) {
  if (a.kind != b.kind) return ComparedAs::unit;
  return a.kind == SampleKind::code8    ? ComparedAs::codes8
         : a.kind == SampleKind::code16 ? ComparedAs::codes16
                                        : ComparedAs::linear;
}

double full_scale(ComparedAs units) {
  return units == ComparedAs::codes8 ? 255 : units == ComparedAs::codes16 ? 65535 : 1;
}

using RgbaDouble = std::array<double, 4>;

double encode_unit(float x) {
  return std::isfinite(x) ? static_cast<double>(srgb_encode(x)) : static_cast<double>(x);
}

// Pixel p in the units of the comparison.
RgbaDouble pixel_of(const DeepImage& image, std::size_t p, ComparedAs units) {
  RgbaDouble out{};
  const bool is_unit = units == ComparedAs::unit;
  for (std::size_t c = 0; c < 4; ++c) {
    if (image.kind == SampleKind::code8) {
      out[c] = image.codes.pixels[p][c] / (is_unit ? 255.0 : 1.0);
      continue;
    }
    const float x = image.samples.pixels[p][c];
    out[c] = static_cast<double>(x);
    if (is_unit && image.kind == SampleKind::code16) out[c] /= 65535;
    if (is_unit && image.kind == SampleKind::linear && c < 3) out[c] = encode_unit(x);
  }
  return out;
}

bool is_finite_pixel(const RgbaDouble& p) {
  return std::all_of(p.begin(), p.end(), [](double x) { return std::isfinite(x); });
}

double luminance_of_pixel(const RgbaDouble& p) {
  return (299 * p[0] + 587 * p[1] + 114 * p[2]) / 1000;
}

struct DeepSums {
  double error = 0, error_covered = 0, signal = 0, rgb = 0, rgb_covered = 0, max_abs = 0;
  std::size_t n = 0, n_covered = 0, n_alpha_differs = 0, n_not_finite = 0, n_not_finite_in_one = 0;
};

void add_deep_pixel(const RgbaDouble& a, const RgbaDouble& b, DeepSums& row, DeepSums& all) {
  const double signal = luminance_of_pixel(b), error = signal - luminance_of_pixel(a);
  const bool covered = a[3] > 0 || b[3] > 0;
  double rgb = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    rgb += (a[c] - b[c]) * (a[c] - b[c]);
    all.max_abs = std::max(all.max_abs, std::abs(a[c] - b[c]));
  }
  row.error += error * error;
  row.error_covered += covered ? error * error : 0;
  row.signal += signal * signal;
  row.rgb += rgb;
  row.rgb_covered += covered ? rgb : 0;
  ++all.n;
  all.n_covered += covered;
}

// Half a code value of 8 bits, where depths differ.
double alpha_tolerance(ComparedAs units) {
  return units == ComparedAs::unit ? 0.5 / 255 : 0;
}

// Sums, and luminance for SSIM, which is 0 in both where a pixel is not finite.
struct DeepComparison {
  DeepSums sums;
  Image<double> luminance_a, luminance_b;
};

DeepComparison sum_pixels(const DeepImage& a, const DeepImage& b, ComparedAs units) {
  DeepComparison out;
  out.luminance_a = out.luminance_b = Image<double>(a.width_px(), a.height_px());
  DeepSums& all = out.sums;
  const auto width = static_cast<std::size_t>(a.width_px());
  for (std::size_t start = 0; start < out.luminance_a.pixels.size(); start += width) {
    DeepSums row;
    for (std::size_t p = start; p < start + width; ++p) {
      const RgbaDouble pa = pixel_of(a, p, units), pb = pixel_of(b, p, units);
      const bool is_a = is_finite_pixel(pa), is_b = is_finite_pixel(pb);
      all.n_not_finite += !is_a || !is_b;
      all.n_not_finite_in_one += is_a != is_b;
      if (!is_a || !is_b) continue;
      all.n_alpha_differs += std::abs(pa[3] - pb[3]) > alpha_tolerance(units);
      add_deep_pixel(pa, pb, row, all);
      out.luminance_a.pixels[p] = luminance_of_pixel(pa);
      out.luminance_b.pixels[p] = luminance_of_pixel(pb);
    }
    all.error += row.error, all.error_covered += row.error_covered, all.signal += row.signal;
    all.rgb += row.rgb, all.rgb_covered += row.rgb_covered;
  }
  return out;
}

double mean_or_nan(double sum, std::size_t n) {
  return n == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(n);
}

void check_deep_sizes(const DeepImage& a, const DeepImage& b) {
  VIEWCELL_CHECK(a.width_px() == b.width_px() && a.height_px() == b.height_px() && a.width_px() > 0,
                 a.width_px(), a.height_px(), b.width_px(), b.height_px());
}

}  // namespace

ImageDistance compare_deep_images(const DeepImage& reference, const DeepImage& tested,
                                  const CompareOptions& options) {
  check_deep_sizes(reference, tested);
  const ComparedAs units = choose_units(reference, tested);
  if (units == ComparedAs::codes8) return compare_images(reference.codes, tested.codes, options);
  const DeepComparison compared = sum_pixels(reference, tested, units);
  const DeepSums& sums = compared.sums;
  ImageDistance d;
  d.width_px = reference.width_px();
  d.height_px = reference.height_px();
  d.compared_as = units;
  d.peak = options.peak.value_or(full_scale(units));
  d.mse = mean_or_nan(sums.error, sums.n);
  d.mse_rgb = mean_or_nan(sums.rgb, 3 * sums.n);
  d.mse_covered = sums.n_covered == 0 ? 0 : mean_or_nan(sums.error_covered, sums.n_covered);
  d.mse_rgb_covered = sums.n_covered == 0 ? 0 : mean_or_nan(sums.rgb_covered, 3 * sums.n_covered);
  d.n_covered = sums.n_covered;
  d.n_alpha_differs = sums.n_alpha_differs;
  d.n_not_finite = sums.n_not_finite;
  d.n_not_finite_in_one = sums.n_not_finite_in_one;
  set_decibels(d);
  d.snr_db = snr_db_of(sums.signal, sums.error);
  d.max_abs = sums.max_abs;
  d.ssim = options.ssim ? mean_ssim(compared.luminance_a, compared.luminance_b, d.peak)
                        : std::numeric_limits<double>::quiet_NaN();
  return d;
}

ImageRgba8 difference_of_deep_images(const DeepImage& a, const DeepImage& b, double gain) {
  check_deep_sizes(a, b);
  const ComparedAs units = choose_units(a, b);
  if (units == ComparedAs::codes8) return difference_image(a.codes, b.codes, gain);
  const double scale = gain * 255 / full_scale(units);
  ImageRgba8 out(a.width_px(), a.height_px(), {0, 0, 0, 255});
  for (std::size_t p = 0; p < out.pixels.size(); ++p) {
    const RgbaDouble pa = pixel_of(a, p, units), pb = pixel_of(b, p, units);
    for (std::size_t c = 0; c < 3; ++c) {
      const double amplified = scale * std::abs(pa[c] - pb[c]);
      const bool is_less = amplified < 255;  // not for what is not finite
      out.pixels[p][c] = static_cast<std::uint8_t>(is_less ? amplified + 0.5 : 255);
    }
  }
  return out;
}

}  // namespace viewcell

// How far two pictures are from each other.
#pragma once

#include <cstddef>
#include <optional>

#include "image/image.h"

namespace viewcell {

/// Decibels that identical pictures count as, and that no pair exceeds.
inline constexpr double kIdenticalDb = 100;

struct CompareOptions {
  bool ssim = true;  ///< measure SSIM too: some ten times the time of all the rest
  /// Full scale, in the units of the samples. None: 255, 65535, or 1 for linear light and two
  /// depths.
  std::optional<double> peak = {};
};

/// What pictures were compared as.
enum class ComparedAs {
  codes8,   ///< sRGB code values of 8 bits
  codes16,  ///< sRGB code values of 16 bits
  linear,   ///< linear light, not clipped
  unit      ///< two depths: sRGB in [0, 1]; linear light is clamped and encoded
};

/// Luminance is Y = 0.299 R + 0.587 G + 0.114 B of the samples, not rounded. Errors are in their
/// units, of which `peak` is the full scale.
struct ImageDistance {
  /// 10 log10(peak^2 / mean squared difference of luminance), over the frame [Chen06 5.3.2] and
  /// over covered pixels: those where either picture's alpha is above 0. No covered pixel counts as
  /// identical.
  double psnr_db = kIdenticalDb, psnr_covered_db = kIdenticalDb;
  double mse = 0, mse_covered = 0;
  /// The same of the squared differences of R, G and B, all together: luminance is blind to colours
  /// of one brightness.
  double psnr_rgb_db = kIdenticalDb, psnr_rgb_covered_db = kIdenticalDb;
  double mse_rgb = 0, mse_rgb_covered = 0;
  std::size_t n_covered = 0;
  /// Mean structural similarity of luminance, in [-1, 1]: Gaussian window of 11 x 11 pixels, sigma
  /// 1.5, K1 0.01, K2 0.03, L = peak, windows wholly inside the picture [Wang04]. The window is cut
  /// to a picture that is smaller. NaN when not asked for.
  double ssim = 0;
  /// Power of the tested picture over power of the difference, 10 log10 [Chen03 4.1]; within
  /// +-100. Not PSNR: it depends on how bright the picture is.
  double snr_db = kIdenticalDb;
  double rms = 0;      ///< square root of mse [NSC01]
  double max_abs = 0;  ///< largest difference of any of R, G, B
  double peak = 255;
  ComparedAs compared_as = ComparedAs::codes8;
  std::size_t n_alpha_differs = 0;  ///< pixels whose alpha differs; no figure above counts it
  /// Pixels with a sample that is not finite, in either picture, and in one alone. All figures
  /// leave them out.
  std::size_t n_not_finite = 0, n_not_finite_in_one = 0;
  int width_px = 0, height_px = 0;
};

/// Sizes must agree. Sums of a row are exact whole numbers (SSIM and rows are summed in order). One
/// thread; about 4 ms a megapixel without SSIM.
ImageDistance compare_images(const ImageRgba8& reference, const ImageRgba8& tested,
                             const CompareOptions& options = {});

/// 10 log10(peak^2 / mse), at most kIdenticalDb.
double psnr_db_of(double mse, double peak = 255);

/// 10 log10(signal / error) of two sums of squares, within +-kIdenticalDb.
double snr_db_of(double signal, double error);
/// Sets all decibels and rms from the mean squares and the peak.
void set_decibels(ImageDistance& distance);

/// |a - b| times gain, channel by channel, clamped at 255; opaque. Sizes must agree.
ImageRgba8 difference_image(const ImageRgba8& a, const ImageRgba8& b, double gain = 8);

}  // namespace viewcell

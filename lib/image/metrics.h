// How far two pictures are from each other.
#pragma once

#include <cstddef>

#include "image/image.h"

namespace viewcell {

/// Decibels that identical pictures count as, and that no pair exceeds.
inline constexpr double kIdenticalDb = 100;

struct CompareOptions {
  bool ssim = true;  ///< measure SSIM too: some ten times the time of all the rest
};

/// Luminance is Y = 0.299 R + 0.587 G + 0.114 B of the 8-bit code values, not rounded.
struct ImageDistance {
  /// 10 log10(255^2 / mean squared difference of luminance), over the frame [Chen06 5.3.2] and over
  /// covered pixels: those where either picture's alpha is above 0. No covered pixel counts as
  /// identical.
  double psnr_db = kIdenticalDb, psnr_covered_db = kIdenticalDb;
  double mse = 0, mse_covered = 0;
  std::size_t n_covered = 0;
  /// Mean structural similarity of luminance, in [-1, 1]: Gaussian window of 11 x 11 pixels, sigma
  /// 1.5, K1 0.01, K2 0.03, windows wholly inside the picture [Wang04]. The window is cut to a
  /// picture that is smaller. NaN when not asked for.
  double ssim = 0;
  /// Power of the tested picture over power of the difference, 10 log10 [Chen03 4.1]; within
  /// +-100. Not PSNR: it depends on how bright the picture is.
  double snr_db = kIdenticalDb;
  double rms = 0;      ///< square root of mse, in code values [NSC01]
  double max_abs = 0;  ///< largest difference of any of R, G, B, in code values
  int width_px = 0, height_px = 0;
};

/// Sizes must agree. Sums are exact whole numbers, so nothing depends on their order (SSIM is
/// summed row by row). One thread; about 4 ms a megapixel without SSIM.
ImageDistance compare_images(const ImageRgba8& reference, const ImageRgba8& tested,
                             const CompareOptions& options = {});

/// 10 log10(255^2 / mse), at most kIdenticalDb.
double psnr_db_of(double mse);

/// |a - b| times gain, channel by channel, clamped at 255; opaque. Sizes must agree.
ImageRgba8 difference_image(const ImageRgba8& a, const ImageRgba8& b, double gain = 8);

}  // namespace viewcell

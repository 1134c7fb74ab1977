// Structural similarity.
#pragma once

#include "image/image.h"

namespace viewcell {

/// Luminance in code values, 0 to 255.
Image<double> luminance(const ImageRgba8& image);

/// Mean SSIM of two pictures of the same size (metrics.h says which). peak: full scale.
double mean_ssim(const Image<double>& a, const Image<double>& b, double peak = 255);

}  // namespace viewcell

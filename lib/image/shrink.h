// Smaller pictures.
#pragma once

#include "image/image.h"

namespace viewcell {

/// What a pixel's channels are, but for alpha.
enum class PixelKind {
  color,  ///< sRGB: averaged as light, each pixel as much as its alpha says
  data    ///< averaged as it is: normals
};

/// Averages over the area that each new pixel covers. 1 <= width_px, height_px; neither is above
/// the image's. The same bytes for any n_threads (0: all).
ImageRgba8 shrink(const ImageRgba8& image, int width_px, int height_px, PixelKind kind,
                  int n_threads = 0);

/// With a longer side of at most max_side_px; smaller ones stay.
ImageRgba8 shrink_to_side(const ImageRgba8& image, int max_side_px, PixelKind kind,
                          int n_threads = 0);

}  // namespace viewcell

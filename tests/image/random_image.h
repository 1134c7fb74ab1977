// Seeded pictures for property tests.
#pragma once

#include "base/random.h"
#include "image/image.h"

namespace viewcell {

/// Every channel of every pixel uniform in [0, 255].
inline ImageRgba8 random_image(int width_px, int height_px, Random& random) {
  ImageRgba8 image(width_px, height_px);
  for (Rgba8& pixel : image.pixels)
    for (std::uint8_t& c : pixel) c = static_cast<std::uint8_t>(random.below(256));
  return image;
}

}  // namespace viewcell

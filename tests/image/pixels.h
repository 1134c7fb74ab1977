// Pixels compared and made.
#pragma once

#include <algorithm>
#include <cstdlib>

#include "base/srgb.h"
#include "image/image.h"

namespace viewcell {

/// Of any channel.
inline int most_difference(const Rgba8& a, const Rgba8& b) {
  int most = 0;
  for (std::size_t c = 0; c < 4; ++c) most = std::max(most, std::abs(int{a[c]} - int{b[c]}));
  return most;
}

/// Of any channel of any pixel of two images of one size.
inline int most_difference(const ImageRgba8& a, const ImageRgba8& b) {
  int most = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    most = std::max(most, most_difference(a.pixels[i], b.pixels[i]));
  return most;
}

/// As sRGB.
inline Rgba8 encoded(const glm::vec3& linear, std::uint8_t alpha = 255) {
  return {srgb8_from_linear(linear.x), srgb8_from_linear(linear.y), srgb8_from_linear(linear.z),
          alpha};
}

}  // namespace viewcell

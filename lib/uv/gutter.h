// Texels around texture charts, filled from the charts, so that fetches at a chart's border find
// nothing else.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "image/image.h"

namespace viewcell {

inline constexpr int kWholeImage = std::numeric_limits<int>::max();

/// Per texel the number (Image::offset) of the texel that it copies: the nearest one that is owned,
/// by the distance of their centres; of two as near the one in the lower row, then column. Owned
/// texels, those farther than reach_px from any, and all texels of an image that owns none copy
/// themselves.
Image<std::uint32_t> nearest_owned_texels(const Image<std::uint8_t>& is_owned,
                                          int reach_px = kWholeImage, int n_threads = 0);

/// Fills an image of the same size through such a map. O(texels).
template <typename Pixel>
void copy_into_gutter(Image<Pixel>& image, const Image<std::uint32_t>& source) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (source.pixels[i] != i) image.pixels[i] = image.pixels[source.pixels[i]];
}

}  // namespace viewcell

// Values for the pixels that have none, from those that have.
#pragma once

#include <cstdint>
#include <span>

#include "image/image.h"

namespace viewcell {

/// Fills every pixel whose mask is 0 from the pixels whose mask is not, by a pyramid: smooth, the
/// nearer the pixel the more it counts. samples: n_channels floats a pixel, row by row; mask: one
/// byte a pixel. Pixels inside the mask keep their bits; filled ones lie between the least and the
/// greatest masked value (but for rounding). With an empty mask nothing changes.
/// One thread; about 1 ms for 256 x 256 pixels of 4 channels.
void push_pull_fill(std::span<float> samples, int width_px, int height_px, int n_channels,
                    std::span<const std::uint8_t> mask);

/// The same for a colour and a depth that is affine on planes, 1/z. The mask is alpha above a half;
/// alpha is left as it is. depth must be of color's size.
void push_pull_fill(ImageRgbaFloat& color, Image<float>& inverse_depth);

}  // namespace viewcell

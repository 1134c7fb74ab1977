// How far two pictures of any depth are from each other.
#pragma once

#include "image/io.h"
#include "image/metrics.h"

namespace viewcell {

/// Pictures of one kind of sample at their own depth (of 8 bits: compare_images); otherwise as
/// ComparedAs::unit. Sums are added row by row, in order; not a number where every pixel has
/// samples that are not finite. Sizes must agree. One thread.
ImageDistance compare_deep_images(const DeepImage& reference, const DeepImage& tested,
                                  const CompareOptions& options = {});

/// |a - b| times gain, channel by channel, clamped at 255 times what the pictures are compared as,
/// full scale (1 of linear light); opaque. Samples that are not finite differ by full scale. Sizes
/// must agree.
ImageRgba8 difference_of_deep_images(const DeepImage& a, const DeepImage& b, double gain = 8);

}  // namespace viewcell

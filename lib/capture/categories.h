// Pixel categories of a depth image [Chen06 5.2.1].
#pragma once

#include "capture/tile.h"

namespace viewcell {

enum class PixelCategory : std::uint8_t {
  background,
  interior,
  sharp_edge,           ///< C1 discontinuity
  interior_silhouette,  ///< C0 discontinuity: the nearer side of a jump
  exterior_silhouette,  ///< next to background
};

/// Tolerances of window-space depth, for a near plane at `near` and a far plane at infinity:
/// window depth = 1 - near / depth, so differences are near * difference of 1/depth. They
/// stay what they are whatever planes the player draws with.
struct CategoryOptions {
  double tc0 = 3.4e-4;
  double tc1 = 1.28e-4;
  double near = 1;
};

/// Follows: [Chen06 5.2.1]. Differs: the C0 test compares with the depth that each side's own slope
/// predicts, so that a plane seen at a grazing angle is no silhouette.
Image<PixelCategory> classify_pixels(const CaptureTile& tile, const CategoryOptions& options = {});

}  // namespace viewcell

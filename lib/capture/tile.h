// A tile: what a centre sees of one object, the colour and depth of one crop.
#pragma once

#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "capture/view.h"
#include "image/image.h"

namespace viewcell {

/// Colour and depth of one object over a crop of a capture view.
struct CaptureTile {
  ObjectId object{};
  CaptureView view;
  Crop crop;
  /// Linear colour; alpha 1 where the object is seen, else 0 and the colour filled in from it.
  ImageRgbaFloat color;
  /// 1 / depth along the view's axis, affine on planes; filled in where alpha is 0.
  Image<float> inverse_depth;

  bool is_seen(int x, int y) const { return color.at(x, y)[3] > 0.5f; }
};

}  // namespace viewcell

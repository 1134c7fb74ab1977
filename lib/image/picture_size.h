// A picture's size without its pixels.
#pragma once

#include <string>
#include <string_view>

#include "image/header.h"

namespace viewcell {

struct PictureSize {
  ImageFormat format = ImageFormat::png;
  int width_px = 0, height_px = 0, n_channels = 0;
};

/// Of a picture file's bytes: nothing is decoded, but all that is checked before (image/header.h)
/// is. name: for errors. Throws InputError.
PictureSize measure_picture(std::string_view bytes, const std::string& name,
                            Remarks* remarks = nullptr);

}  // namespace viewcell

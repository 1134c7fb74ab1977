// Pictures written as JPEG.
#pragma once

#include <string>
#include <string_view>

#include "image/image.h"

namespace viewcell {

struct JpegOptions {
  int quality = 90;         ///< 1 to 100
  bool halves_hues = true;  ///< chroma at half the resolution: for colours, not for normals
};

/// Whether alpha, which a JPEG has not, is 255 all over.
bool is_opaque(const ImageRgba8& image);

/// The quality whose table for brightness is nearest to that of a JPEG's bytes, 1 to 100: what the
/// common encoder was given, and about that for others. 0: the bytes are no JPEG with such a table.
int measure_jpeg_quality(std::string_view bytes);

/// A JPEG's bytes; alpha is left out. The same pixels give the same bytes. Throws MachineError.
/// Safe from many threads at once.
std::string encode_jpeg(const ImageRgba8& image, const JpegOptions& options = {});

}  // namespace viewcell

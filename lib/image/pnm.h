// PBM, PGM and PPM with all their codes: OpenImageIO rounds those of other maxima down. Private to
// this room's readers; their PictureFacts are checked first. PFM is OpenImageIO's.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "image/memory_input.h"

namespace viewcell {

/// One or three channels, scaled to 0 to 65535 and rounded to the nearest. Throws InputError(file):
/// a maximum outside 1 to 65535, a sample above it, too few samples.
Samples<std::uint16_t> decode_pnm(std::string_view bytes, const std::string& file);

}  // namespace viewcell

// WebP by its own library: OpenImageIO hands out colours multiplied by alpha, which are lost where
// alpha is thin. Private to this room's readers.
#pragma once

#include <string>
#include <string_view>

#include "image/image.h"

namespace viewcell {

/// The picture of a WebP, of an animated one its first, laid on its canvas, which is clear around
/// it. width and height are those of the file's header, checked. Alpha is straight and colours are
/// as stored under any alpha. Throws InputError(file).
ImageRgba8 decode_webp(std::string_view bytes, int width, int height, const std::string& file);

}  // namespace viewcell

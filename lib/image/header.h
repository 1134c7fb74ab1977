// What a picture's first bytes say, checked before any decoder reads it.
#pragma once

#include <string>
#include <string_view>

namespace viewcell {

/// The pictures that are read, recognised by their first bytes, never by the file's name.
enum class ImageFormat { png, jpeg, openexr, tiff, webp };

/// The largest picture that is read.
inline constexpr int kMaxImageSidePx = 16384;
inline constexpr long long kMaxImagePixels = 1LL << 28;

/// OpenImageIO's name of the format.
const char* name_of(ImageFormat format);
/// As file names have it: ".png", ".jpg", ".exr", ".tif", ".webp".
const char* extension_of(ImageFormat format);

/// Tells the format, and where the decoder would allocate the picture before it can be asked for
/// its size (PNG, JPEG, WebP), holds the size in the header against the limits above. A JPEG must
/// also have its end marker, since its decoder makes up what is missing. Throws InputError(file).
ImageFormat check_image_header(std::string_view bytes, const std::string& file);

/// Throws InputError when a side is not within [1, kMaxImageSidePx] or the area above the limit.
void check_image_size(long long width_px, long long height_px, const std::string& file);

}  // namespace viewcell

// What a picture's first bytes say, checked before any decoder reads it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/remarks.h"

namespace viewcell {

/// The pictures that are read, recognised by their first bytes, never by the file's name. pnm: PBM,
/// PGM, PPM and PFM; hdr: Radiance.
enum class ImageFormat { png, jpeg, openexr, tiff, webp, gif, bmp, targa, pnm, hdr };

/// The largest side of pictures that we make.
inline constexpr int kMaxImageSidePx = 16384;
/// The most pixels of pictures that are read, unless told otherwise, and the most that may be told.
inline constexpr long long kMaxImagePixels = 1LL << 28;
inline constexpr long long kMostImagePixels = 1LL << 30;

struct ImageLimits {
  /// None: kMaxImagePixels, and, in formats in which a few bytes may say any size (GIF, WebP, run
  /// lengths), no more than files of so many bytes are known to hold.
  std::optional<std::size_t> max_pixels = {};
};

/// OpenImageIO's name of the format.
const char* name_of(ImageFormat format);
/// As file names have it: ".png", ".jpg", ".exr", ".tif", ".webp", ".gif", ".bmp", ".tga", ".ppm",
/// ".hdr".
const char* extension_of(ImageFormat format);
/// All endings that such files have, in lower case: ".png", ".jpg", ".jpeg" and so on.
const std::vector<std::string>& picture_endings();

/// Tells the format and, where the decoder would allocate the picture before it can be asked for
/// its size (all but TIFF), holds the size in the header against the limits, and against
/// what the file's bytes can hold: a PNG is inflated on the way, a JPEG's segments are walked. A
/// JPEG must also have its end marker, since its decoder makes up what is missing. Further pictures
/// (frames, pages) are remarked. Throws InputError(file).
ImageFormat check_image_header(std::string_view bytes, const std::string& file,
                               const ImageLimits& limits = {}, Remarks* remarks = nullptr);

/// Throws InputError when a side is below 1 or the area above the limit.
void check_image_size(long long width_px, long long height_px, const std::string& file,
                      const ImageLimits& limits = {});

/// What is remarked of a file that holds further pictures.
inline constexpr const char* kFurtherPictures =
    "further pictures in it, left out: the first counts";

}  // namespace viewcell

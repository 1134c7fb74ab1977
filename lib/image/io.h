// Pictures read from and written to files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "image/image.h"

namespace viewcell {

/// Reads a PNG, JPEG, EXR, TIFF or WebP, recognised by its first bytes ("-": standard input), as
/// 8-bit sRGB with straight alpha. Gray and gray with alpha are expanded; without alpha it is 255.
/// Float and half samples are taken as linear: clamped to [0, 1], encoded as sRGB, their alpha as
/// it is. An EXR gives its data window. The first picture of several.
///
/// The size is checked before pixels are read (image/header.h). Throws InputError naming the file.
/// Safe from many threads at once. Known limit: OpenImageIO hands out a WebP's colour multiplied by
/// alpha, so where alpha is small it comes back coarse, and 0 where alpha is 0.
ImageRgba8 read_image_rgba8(const std::filesystem::path& file);

/// The same of a file's bytes. name: for errors.
ImageRgba8 decode_image_rgba8(std::string_view bytes, const std::string& name);

enum class PngAlpha {
  keep,
  drop,  ///< write RGB only: for pictures for people, whose background would show as transparent
};

/// A PNG's bytes. The same pixels give the same bytes: no date, no software. Throws MachineError.
/// Safe from many threads at once.
std::string encode_png(const ImageRgba8& image, PngAlpha alpha = PngAlpha::keep);

/// Writes encode_png, whole or not at all ("-": standard output). Throws MachineError.
void write_png(const std::filesystem::path& file, const ImageRgba8& image,
               PngAlpha alpha = PngAlpha::keep);

}  // namespace viewcell

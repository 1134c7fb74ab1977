// Pictures read from and written to files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/remarks.h"
#include "image/header.h"
#include "image/image.h"

namespace viewcell {

struct ReadImageOptions {
  ImageLimits limits = {};
  /// What the reader did on the side: further pictures left out, alpha that is 0 everywhere taken
  /// as opaque, an orientation not followed, samples made coarser, channels left out.
  Remarks* remarks = nullptr;
};

/// Reads a picture (image/header.h has the formats; they are recognised by their first bytes; "-":
/// standard input) as 8-bit sRGB with straight alpha. Gray and gray with alpha are expanded;
/// without alpha it is 255. Float and half samples are taken as linear: clamped to [0, 1], encoded
/// as sRGB, their alpha as it is. An EXR gives its data window. The first picture of several. BMP
/// and TGA whose alpha is 0 everywhere are opaque: to most that write them it is padding.
///
/// Colours that a file stores multiplied by alpha (EXR; TIFF and TGA that say so) are divided by
/// it, remarked; those under alpha 0 stay as stored.
///
/// The size is checked before pixels are read. Throws InputError naming the file. Safe from many
/// threads at once.
ImageRgba8 read_image_rgba8(const std::filesystem::path& file,
                            const ReadImageOptions& options = {});

/// The same of a file's bytes. name: for errors.
ImageRgba8 decode_image_rgba8(std::string_view bytes, const std::string& name,
                              const ReadImageOptions& options = {});

/// What the samples of a picture's file are.
enum class SampleKind {
  code8,   ///< up to 8 bits: sRGB code values 0 to 255
  code16,  ///< 9 to 32 bits: code values scaled to 0 to 65535
  linear   ///< float and half, and HDR: linear light, any number, finite or not
};

/// A picture at its file's own depth: codes of code8, otherwise samples.
struct DeepImage {
  SampleKind kind = SampleKind::code8;
  ImageRgba8 codes;
  ImageRgbaFloat samples;
  int width_px() const { return kind == SampleKind::code8 ? codes.width_px : samples.width_px; }
  int height_px() const { return kind == SampleKind::code8 ? codes.height_px : samples.height_px; }
};

/// As read_image_rgba8, but for the depth: nothing is rounded, clamped or encoded, and an EXR's
/// colours stay multiplied by alpha. Where there is no alpha it is 255, 65535 or 1.
DeepImage read_deep_image(const std::filesystem::path& file, const ReadImageOptions& options = {});

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

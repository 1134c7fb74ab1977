// A picture in memory, opened by OpenImageIO and checked before a pixel of it is decoded. Private
// to this room's readers.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "image/header.h"
#include "image/library.h"

namespace viewcell {

/// The largest picture file that is read.
inline constexpr std::uint64_t kMaxImageFileBytes = 1ULL << 31;

/// The first picture of a file. Its members die in the right order: the input reads from the
/// memory.
struct MemoryInput {
  ImageFormat format = ImageFormat::png;
  OIIO::ImageSpec spec;
  std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;
  std::unique_ptr<OIIO::ImageInput> input;
};

/// Opens and checks: a format that is read, flat, its size and tiles within the limits of
/// image/header.h, 1 to 64 channels. Alpha will come out straight. bytes must outlive the result.
/// Throws InputError naming `file`.
MemoryInput open_memory(std::string_view bytes, const std::string& file);

/// Channels 0 .. n_channels - 1 of the picture as Sample, pixel by pixel. Throws InputError(file).
template <typename Sample>
std::vector<Sample> decode(MemoryInput& picture, int n_channels, const std::string& file) {
  const OIIO::TypeDesc type(OIIO::BaseTypeFromC<Sample>::value);
  std::vector<Sample> samples(static_cast<std::size_t>(picture.spec.width) *
                              static_cast<std::size_t>(picture.spec.height) *
                              static_cast<std::size_t>(n_channels));
  if (!picture.input->read_image(0, 0, 0, n_channels, type, samples.data()))
    throw InputError(file, "pixels", first_line(picture.input->geterror()));
  return samples;
}

}  // namespace viewcell

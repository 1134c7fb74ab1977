// A picture in memory, opened by OpenImageIO and checked before a pixel of it is decoded. Private
// to this room's readers.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>
#include <string_view>

#include "base/error.h"
#include "image/header.h"
#include "image/library.h"

namespace viewcell {

/// The largest picture file that is read.
inline constexpr std::uint64_t kMaxImageFileBytes = 1ULL << 31;

/// Reads nothing from outside its bytes. IOMemReader (2.4.7) adds a place to a size without asking
/// for its sign: a chunk of an EXR at -1 is read from before them.
class BoundedReader : public OIIO::Filesystem::IOMemReader {
 public:
  /// Only reads, though the library's parameter is not const.
  explicit BoundedReader(std::string_view bytes)
      : IOMemReader(const_cast<char*>(bytes.data()), bytes.size()), n_bytes_(bytes.size()) {}
  std::size_t pread(void* to, std::size_t n, std::int64_t place) override;
  std::size_t read(void* to, std::size_t n) override;

 private:
  std::size_t n_bytes_;
};

/// The first picture of a file. Its members die in the right order: the input reads from the
/// memory.
struct MemoryInput {
  ImageFormat format = ImageFormat::png;
  OIIO::ImageSpec spec;
  std::unique_ptr<BoundedReader> memory;
  std::unique_ptr<OIIO::ImageInput> input;
};

/// Opens and checks: a format that is read, flat, its size and tiles within the limits, no more
/// pixels than the file can hold, 1 to 64 channels. Alpha will come out straight. bytes must
/// outlive the result. Remarked: further pictures, and an orientation, which is not followed.
/// Throws InputError naming `file`.
MemoryInput open_memory(std::string_view bytes, const std::string& file,
                        const ImageLimits& limits = {}, Remarks* remarks = nullptr);

/// Pixel by pixel, channel by channel.
template <typename Sample>
struct Samples {
  std::unique_ptr<Sample[]> data;  // not a vector: zeros would touch memory before it is needed
  std::size_t n_channels = 0;
  const Sample* pixel(std::size_t p) const { return data.get() + p * n_channels; }
};

/// Of a TIFF, for decode().
bool read_tiff(MemoryInput& picture, int n_channels, const OIIO::TypeDesc& type, char* out);

/// Channels 0 .. n_channels - 1 of the picture. Throws InputError(file).
template <typename Sample>
Samples<Sample> decode(MemoryInput& picture, int n_channels, const std::string& file) {
  const OIIO::TypeDesc type(OIIO::BaseTypeFromC<Sample>::value);
  const auto n = static_cast<std::size_t>(n_channels);
  const std::size_t n_pixels =
      static_cast<std::size_t>(picture.spec.width) * static_cast<std::size_t>(picture.spec.height);
  Samples<Sample> samples{std::unique_ptr<Sample[]>(new Sample[n_pixels * n]), n};
  const bool is_read = call_library(file, [&] {
    if (picture.format == ImageFormat::tiff)
      return read_tiff(picture, n_channels, type, reinterpret_cast<char*>(samples.data.get()));
    return picture.input->read_image(0, 0, 0, n_channels, type, samples.data.get());
  });
  if (!is_read || picture.input->has_error())  // it may say so, and that all went well
    throw InputError(file, "pixels", first_line(picture.input->geterror()));
  return samples;
}

}  // namespace viewcell

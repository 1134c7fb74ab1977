#include "image/io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/file.h"
#include "base/srgb.h"
#include "image/library.h"
#include "image/memory_input.h"

namespace viewcell {
namespace {

// In file order, the channels that become R, G, B and A; alpha -1 when there is none.
struct ChannelMap {
  std::array<int, 4> from;
  int n_read;  // channels to decode: 0 .. n_read - 1
};

// The channels by index, or by name where the format has names.
ChannelMap map_channels(const OIIO::ImageSpec& spec, ImageFormat format, const std::string& file) {
  ChannelMap map{{0, 1, 2, spec.nchannels > 3 ? 3 : -1}, 0};
  if (spec.nchannels == 1) map.from = {0, 0, 0, -1};
  if (spec.nchannels == 2) map.from = {0, 0, 0, 1};
  if (format == ImageFormat::openexr) {
    const int y = spec.channelindex("Y");
    map.from = {spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B"),
                spec.channelindex("A")};
    if (map.from[0] < 0) map.from = {y, y, y, map.from[3]};
  }
  for (int c = 0; c < 3; ++c)
    if (map.from[static_cast<std::size_t>(c)] < 0)
      throw InputError(file, "header", "has no channels R, G, B nor Y");
  map.n_read = 1 + *std::max_element(map.from.begin(), map.from.end());
  if (map.n_read > 4)
    throw InputError(file, "header", "its colour is not among the first four channels");
  return map;
}

// The samples as RGBA: convert(sample, c) gives the code value of channel c.
template <typename Sample, typename Convert>
ImageRgba8 gather(const std::vector<Sample>& samples, const OIIO::ImageSpec& spec,
                  const ChannelMap& map, const Convert& convert) {
  ImageRgba8 image(spec.width, spec.height, {0, 0, 0, 255});
  const auto stride = static_cast<std::size_t>(map.n_read);
  for (std::size_t p = 0; p < image.pixels.size(); ++p)
    for (std::size_t c = 0; c < 4; ++c)
      if (map.from[c] >= 0)
        image.pixels[p][c] =
            convert(samples[p * stride + static_cast<std::size_t>(map.from[c])], c);
  return image;
}

// Undoes the multiplication of the WebP reader.
void divide_by_alpha(ImageRgba8& image) {
  for (Rgba8& p : image.pixels)
    for (std::size_t c = 0; c < 3 && p[3] > 0; ++c)
      p[c] = static_cast<std::uint8_t>(std::min(255, (p[c] * 255 + p[3] / 2) / p[3]));
}

ImageRgba8 read_pixels(MemoryInput& picture, const std::string& file) {
  const OIIO::ImageSpec& spec = picture.spec;
  const ChannelMap map = map_channels(spec, picture.format, file);
  if (spec.format.is_floating_point())
    return gather(decode<float>(picture, map.n_read, file), spec, map, [](float x, std::size_t c) {
      if (c < 3) return srgb8_from_linear(x);
      return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.f, 1.f)));
    });
  return gather(decode<std::uint8_t>(picture, map.n_read, file), spec, map,
                [](std::uint8_t x, std::size_t) { return x; });
}

}  // namespace

ImageRgba8 decode_image_rgba8(std::string_view bytes, const std::string& name) {
  MemoryInput picture = open_memory(bytes, name);
  ImageRgba8 image = read_pixels(picture, name);
  if (picture.format == ImageFormat::webp) divide_by_alpha(image);
  return image;
}

ImageRgba8 read_image_rgba8(const std::filesystem::path& file) {
  return decode_image_rgba8(read_file(file, kMaxImageFileBytes), file.string());
}

std::string encode_png(const ImageRgba8& image, PngAlpha alpha) {
  VIEWCELL_CHECK(!image.empty());
  configure_openimageio();
  OIIO::ImageSpec spec(image.width_px, image.height_px, alpha == PngAlpha::keep ? 4 : 3,
                       OIIO::TypeUInt8);
  spec.attribute("oiio:UnassociatedAlpha", 1);  // else it divides colour by alpha
  // Measured on lit frames: a third of the default's time for 1 % more bytes.
  spec.attribute("png:compressionLevel", 4);
  spec.attribute("png:filter", 16);  // "sub" on every row
  OIIO::Filesystem::IOVecOutput memory;
  const auto output = OIIO::ImageOutput::create("png", &memory);
  if (!output) throw MachineError("OpenImageIO cannot write PNG");
  const bool written = output->open("memory.png", spec) &&
                       output->write_image(OIIO::TypeUInt8, image.pixels.data(), sizeof(Rgba8));
  if (!output->close() || !written)
    throw MachineError("encoding a PNG: " + first_line(output->geterror()));
  const std::vector<unsigned char>& bytes = memory.buffer();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void write_png(const std::filesystem::path& file, const ImageRgba8& image, PngAlpha alpha) {
  write_file(file, encode_png(image, alpha));
}

}  // namespace viewcell

#include "image/io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "base/error.h"
#include "base/file.h"
#include "base/srgb.h"
#include "image/header.h"
#include "image/library.h"

namespace viewcell {
namespace {

constexpr std::uint64_t kMaxFileBytes = 1ULL << 31;
constexpr int kMaxChannels = 64;

// In file order, the channels that become R, G, B and A; alpha -1 when there is none.
struct ChannelMap {
  std::array<int, 4> from;
  int n_read;  // channels to decode: 0 .. n_read - 1
};

// OpenImageIO's messages end in a newline and may repeat the file's name; one line is enough.
std::string first_line(const std::string& text) {
  return text.empty() ? "cannot decode" : text.substr(0, text.find('\n'));
}

// What the decoder will allocate, before it does.
void check_spec(const OIIO::ImageSpec& spec, const std::string& file) {
  check_image_size(spec.width, spec.height, file);
  if (spec.tile_width > 0) check_image_size(16LL * spec.tile_width, 16LL * spec.tile_height, file);
  if (spec.depth > 1 || spec.deep) throw InputError(file, "header", "is not a flat picture");
  if (spec.nchannels < 1 || spec.nchannels > kMaxChannels)
    throw InputError(
        file, "header",
        std::to_string(spec.nchannels) + " channels, more than " + std::to_string(kMaxChannels));
}

// The channels by place, or by name where the format has names.
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

template <typename Sample>
std::vector<Sample> decode(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int n_channels,
                           OIIO::TypeDesc type, const std::string& file) {
  std::vector<Sample> samples(static_cast<std::size_t>(spec.width) *
                              static_cast<std::size_t>(spec.height) *
                              static_cast<std::size_t>(n_channels));
  if (!input.read_image(0, 0, 0, n_channels, type, samples.data()))
    throw InputError(file, "pixels", first_line(input.geterror()));
  return samples;
}

// Undoes the multiplication of the WebP reader.
void divide_by_alpha(ImageRgba8& image) {
  for (Rgba8& p : image.pixels)
    for (std::size_t c = 0; c < 3 && p[3] > 0; ++c)
      p[c] = static_cast<std::uint8_t>(std::min(255, (p[c] * 255 + p[3] / 2) / p[3]));
}

ImageRgba8 read_pixels(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, ImageFormat format,
                       const std::string& file) {
  const ChannelMap map = map_channels(spec, format, file);
  if (spec.format.is_floating_point())
    return gather(decode<float>(input, spec, map.n_read, OIIO::TypeFloat, file), spec, map,
                  [](float x, std::size_t c) {
                    if (c < 3) return srgb8_from_linear(x);
                    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(x, 0.f, 1.f)));
                  });
  return gather(decode<std::uint8_t>(input, spec, map.n_read, OIIO::TypeUInt8, file), spec, map,
                [](std::uint8_t x, std::size_t) { return x; });
}

}  // namespace

ImageRgba8 read_image_rgba8(const std::filesystem::path& path) {
  configure_openimageio();
  const std::string file = path.string();
  std::string bytes = read_file(path, kMaxFileBytes);
  const ImageFormat format = check_image_header(bytes, file);
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  const auto input = OIIO::ImageInput::create(name_of(format), false);
  if (!input || !input->set_ioproxy(&memory))
    throw MachineError(std::string("OpenImageIO cannot read ") + name_of(format));
  OIIO::ImageSpec spec, hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  if (!input->open(file, spec, hints)) throw InputError(file, "", first_line(input->geterror()));
  check_spec(spec, file);
  ImageRgba8 image = read_pixels(*input, spec, format, file);
  if (format == ImageFormat::webp) divide_by_alpha(image);
  return image;
}

void write_png(const std::filesystem::path& path, const ImageRgba8& image, PngAlpha alpha) {
  VIEWCELL_CHECK(!image.empty(), "writing", path.string());
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
    throw MachineError(path.string() + ": " + first_line(output->geterror()));
  const std::vector<unsigned char>& bytes = memory.buffer();
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace viewcell

#include "image/io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "base/error.h"
#include "base/file.h"
#include "base/srgb.h"
#include "image/library.h"
#include "image/memory_input.h"
#include "image/picture_facts.h"
#include "image/pnm.h"
#include "image/webp.h"

namespace viewcell {
namespace {

constexpr int kMostRead = 8;  // channels are decoded from the first on

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
    const auto has = [&](const char* name) { return spec.channelindex(name) >= 0; };
    if (has("RY") || has("BY") || (map.from[0] < 0 && has("X") && has("Z")))
      throw InputError(file, "header",
                       "has its colours as luminance and differences, or as CIE XYZ, which are not "
                       "read: convert them to R, G, B");
    if (map.from[0] < 0) map.from = {y, y, y, map.from[3]};
  }
  if (format == ImageFormat::tiff && spec.nchannels > 3 && spec.alpha_channel > 2)
    map.from[3] = spec.alpha_channel;
  for (int c = 0; c < 3; ++c)
    if (map.from[static_cast<std::size_t>(c)] < 0)
      throw InputError(file, "header", "has no channels R, G, B nor Y");
  map.n_read = 1 + *std::max_element(map.from.begin(), map.from.end());
  if (map.n_read > kMostRead)
    throw InputError(
        file, "header",
        "its colour or alpha is not among the first " + std::to_string(kMostRead) + " channels");
  return map;
}

void remark_channels(const OIIO::ImageSpec& spec, const ChannelMap& map, Remarks* remarks) {
  const std::set<int> used(map.from.begin(), map.from.end());
  const auto n_used = static_cast<int>(used.size() - used.count(-1));
  add_remark(remarks, "channels beside colour and alpha, left out",
             static_cast<std::size_t>(std::max(0, spec.nchannels - n_used)));
}

// The samples as RGBA: convert(sample, c) gives the value of channel c.
template <typename Pixel, typename Sample, typename Convert>
Image<Pixel> gather(const Samples<Sample>& samples, const OIIO::ImageSpec& spec,
                    const ChannelMap& map, const Pixel& fill, const Convert& convert) {
  Image<Pixel> image(spec.width, spec.height, fill);
  for (std::size_t p = 0; p < image.pixels.size(); ++p)
    for (std::size_t c = 0; c < 4; ++c)
      if (map.from[c] >= 0) image.pixels[p][c] = convert(samples.pixel(p)[map.from[c]], c);
  return image;
}

// Of 8 bits; 0 where alpha is 0.
void divide_by_alpha(ImageRgba8& image) {
  for (Rgba8& p : image.pixels)
    for (std::size_t c = 0; c < 3 && p[3] > 0; ++c)
      p[c] = static_cast<std::uint8_t>(std::min(255, (p[c] * 255 + p[3] / 2) / p[3]));
}

// Of 16 bits or linear, whose full alpha is given.
void divide_by_alpha(ImageRgbaFloat& image, float full) {
  for (RgbaFloat& p : image.pixels)
    for (std::size_t c = 0; c < 3 && p[3] > 0; ++c) p[c] = p[c] * full / p[3];
}

// TIFFs whose 0 is white: OpenImageIO turns all channels of 8 bits, and none of more.
bool is_min_white(const MemoryInput& input) {
  return input.format == ImageFormat::tiff &&
         input.spec.get_int_attribute("tiff:PhotometricInterpretation", -1) == 0;
}

// BMP and TGA of 32 bits may say that the fourth byte is no alpha, and often leave it at 0 and mean
// nothing by it.
void mend_alpha(ImageFormat format, std::string_view bytes, ImageRgba8& image, Remarks* remarks) {
  if (format != ImageFormat::bmp && format != ImageFormat::targa) return;
  if (format == ImageFormat::targa ? targa_has_no_alpha(bytes) : bmp_has_no_alpha(bytes))
    for (Rgba8& pixel : image.pixels) pixel[3] = 255;
  const auto is_clear = [](const Rgba8& pixel) { return pixel[3] == 0; };
  if (!std::all_of(image.pixels.begin(), image.pixels.end(), is_clear)) return;
  for (Rgba8& pixel : image.pixels) pixel[3] = 255;
  add_remark(remarks, "alpha that is 0 everywhere, taken as opaque");
}

SampleKind kind_of(ImageFormat format, const OIIO::TypeDesc& type, const std::string& file) {
  if (type.is_floating_point()) return SampleKind::linear;
  if (format == ImageFormat::openexr)
    throw InputError(file, "header", "has whole numbers for samples, which are no colours");
  if (type.is_signed())
    throw InputError(file, "header", "has signed samples, which are no colours");
  return type == OIIO::TypeUInt8 ? SampleKind::code8 : SampleKind::code16;
}

// Whether colours were stored multiplied by alpha: EXR's rule; TIFF and TGA say it.
bool is_multiplied(const MemoryInput& input, std::string_view bytes) {
  if (input.spec.alpha_channel < 0) return false;
  switch (input.format) {
    case ImageFormat::openexr:
      return true;
    case ImageFormat::tiff:
      return input.spec.get_int_attribute("oiio:UnassociatedAlpha") == 0;
    case ImageFormat::targa:
      return targa_is_multiplied(bytes);
    default:
      return false;
  }
}

// An opened picture and how its channels become RGBA.
struct OpenedPicture {
  MemoryInput input;
  std::string_view bytes;
  ChannelMap map;
  SampleKind kind;
  bool is_multiplied;
};

OpenedPicture open_picture(std::string_view bytes, const std::string& file,
                           const ReadImageOptions& options) {
  OpenedPicture opened{
      open_memory(bytes, file, options.limits, options.remarks), bytes, {}, {}, false};
  opened.map = map_channels(opened.input.spec, opened.input.format, file);
  opened.kind = kind_of(opened.input.format, opened.input.spec.format, file);
  remark_channels(opened.input.spec, opened.map, options.remarks);
  opened.is_multiplied = is_multiplied(opened.input, bytes);
  return opened;
}

constexpr const char* kDivided = "colours stored multiplied by alpha, divided by it";

ImageRgbaFloat decode_samples(OpenedPicture& opened, const std::string& file) {
  MemoryInput& input = opened.input;
  const auto keep = [](auto x, std::size_t) { return static_cast<float>(x); };
  if (opened.kind == SampleKind::linear)
    return gather(decode<float>(input, opened.map.n_read, file), input.spec, opened.map,
                  RgbaFloat{0, 0, 0, 1}, keep);
  if (input.format == ImageFormat::pnm)
    return gather(decode_pnm(opened.bytes, file), input.spec, opened.map, RgbaFloat{0, 0, 0, 65535},
                  keep);
  return gather(decode<std::uint16_t>(input, opened.map.n_read, file), input.spec, opened.map,
                RgbaFloat{0, 0, 0, 65535}, keep);
}

// As stored, but for the depth.
ImageRgbaFloat read_samples(OpenedPicture& opened, const std::string& file) {
  ImageRgbaFloat image = decode_samples(opened, file);
  if (!is_min_white(opened.input)) return image;
  const float white = opened.kind == SampleKind::linear ? 1.f : 65535.f;
  for (RgbaFloat& pixel : image.pixels)
    for (std::size_t c = 0; c < 3; ++c) pixel[c] = white - pixel[c];
  return image;
}

std::uint8_t round_code(float x) {
  return x > 0 ? static_cast<std::uint8_t>(std::lround(std::min(x, 255.f))) : 0;
}

// Linear samples of straight alpha as codes.
ImageRgba8 encode_srgb(const ImageRgbaFloat& linear) {
  ImageRgba8 image(linear.width_px, linear.height_px, {});
  for (std::size_t p = 0; p < image.pixels.size(); ++p) {
    const RgbaFloat& from = linear.pixels[p];
    for (std::size_t c = 0; c < 3; ++c) image.pixels[p][c] = srgb8_from_linear(from[c]);
    image.pixels[p][3] = round_code(255 * from[3]);
  }
  return image;
}

ImageRgba8 round_to_8_bits(const ImageRgbaFloat& samples) {
  ImageRgba8 image(samples.width_px, samples.height_px, {});
  for (std::size_t p = 0; p < image.pixels.size(); ++p)
    for (std::size_t c = 0; c < 4; ++c) image.pixels[p][c] = round_code(samples.pixels[p][c] / 257);
  return image;
}

ImageRgba8 read_codes(OpenedPicture& opened, const std::string& file, Remarks* remarks) {
  MemoryInput& input = opened.input;
  if (opened.is_multiplied) add_remark(remarks, kDivided);
  if (opened.kind != SampleKind::code8 || input.format == ImageFormat::pnm) {
    const bool is_linear = opened.kind == SampleKind::linear;
    ImageRgbaFloat samples = read_samples(opened, file);
    if (opened.is_multiplied) divide_by_alpha(samples, is_linear ? 1.f : 65535.f);
    return is_linear ? encode_srgb(samples) : round_to_8_bits(samples);
  }
  if (input.format == ImageFormat::webp)
    return decode_webp(opened.bytes, input.spec.width, input.spec.height, file);
  ImageRgba8 image =
      gather(decode<std::uint8_t>(input, opened.map.n_read, file), input.spec, opened.map,
             Rgba8{0, 0, 0, 255}, [](std::uint8_t x, std::size_t) { return x; });
  if (is_min_white(input) && opened.map.from[3] >= 0)
    for (Rgba8& pixel : image.pixels) pixel[3] = static_cast<std::uint8_t>(255 - pixel[3]);
  if (opened.is_multiplied) divide_by_alpha(image);
  mend_alpha(input.format, opened.bytes, image, remarks);
  return image;
}

}  // namespace

ImageRgba8 decode_image_rgba8(std::string_view bytes, const std::string& name,
                              const ReadImageOptions& options) {
  OpenedPicture opened = open_picture(bytes, name, options);
  if (opened.kind == SampleKind::code16)
    add_remark(options.remarks, "samples of more than 8 bits, rounded to 8");
  if (opened.kind == SampleKind::linear)
    add_remark(options.remarks, "linear samples, encoded as sRGB of 8 bits and clamped to [0, 1]");
  return read_codes(opened, name, options.remarks);
}

ImageRgba8 read_image_rgba8(const std::filesystem::path& file, const ReadImageOptions& options) {
  return decode_image_rgba8(read_file(file, kMaxImageFileBytes), file.string(), options);
}

DeepImage read_deep_image(const std::filesystem::path& path, const ReadImageOptions& options) {
  const std::string file = path.string();
  const std::string bytes = read_file(path, kMaxImageFileBytes);
  OpenedPicture opened = open_picture(bytes, file, options);
  DeepImage image;
  image.kind = opened.kind;
  if (opened.kind == SampleKind::code8) {
    image.codes = read_codes(opened, file, options.remarks);
    return image;
  }
  image.samples = read_samples(opened, file);
  if (opened.is_multiplied && opened.input.format != ImageFormat::openexr) {
    add_remark(options.remarks, kDivided);
    divide_by_alpha(image.samples, opened.kind == SampleKind::linear ? 1.f : 65535.f);
  }
  return image;
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

#include "image/jpeg.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "base/error.h"
#include "image/library.h"

namespace viewcell {
namespace {

// Source: ITU-T T.81, table K.1, which is scaled by the quality in the IJG's manner.
constexpr std::array<int, 64> kBrightness{
    16, 11, 10, 16, 24,  40,  51,  61,  12, 12, 14, 19, 26,  58,  60,  55,  //
    14, 13, 16, 24, 40,  57,  69,  56,  14, 17, 22, 29, 51,  87,  80,  62,  //
    18, 22, 37, 56, 68,  109, 103, 77,  24, 35, 55, 64, 81,  104, 113, 92,  //
    49, 64, 78, 87, 103, 121, 120, 101, 72, 92, 95, 98, 112, 100, 103, 99};

// Of the table's entries, in whatever order.
int sum_at_quality(int quality) {
  const int percent = quality < 50 ? 5000 / quality : 200 - 2 * quality;
  int sum = 0;
  for (const int entry : kBrightness) sum += std::clamp((entry * percent + 50) / 100, 1, 255);
  return sum;
}

// The sum of table 0 in a DQT segment; 0: it is not there.
int sum_of_table(std::string_view segment) {
  const auto byte_at = [&](std::size_t i) { return int{static_cast<unsigned char>(segment[i])}; };
  for (std::size_t at = 0; at < segment.size();) {
    const std::size_t n_bytes = byte_at(at) >> 4 ? 2 : 1, end = at + 1 + 64 * n_bytes;
    if (end > segment.size()) return 0;
    int sum = 0;
    for (std::size_t i = at + 1; i < end; ++i)
      sum += n_bytes == 2 && (i - at) % 2 == 1 ? 256 * byte_at(i) : byte_at(i);
    if ((byte_at(at) & 15) == 0) return sum;
    at = end;
  }
  return 0;
}

}  // namespace

int measure_jpeg_quality(std::string_view bytes) {
  if (!bytes.starts_with("\xff\xd8\xff")) return 0;
  int sum = 0;
  for (std::size_t at = 2; at + 4 <= bytes.size() && sum == 0;) {
    const auto marker = static_cast<unsigned char>(bytes[at + 1]);
    const std::size_t n_bytes = std::size_t{static_cast<unsigned char>(bytes[at + 2])} * 256 +
                                static_cast<unsigned char>(bytes[at + 3]);
    if (bytes[at] != '\xff' || marker == 0xda || n_bytes < 2) return 0;
    if (marker == 0xdb) sum = sum_of_table(bytes.substr(at + 4, n_bytes - 2));
    at += 2 + n_bytes;
  }
  if (sum == 0) return 0;
  int best = 1;
  for (int quality = 2; quality <= 100; ++quality)
    if (std::abs(sum_at_quality(quality) - sum) < std::abs(sum_at_quality(best) - sum))
      best = quality;
  return best;
}

bool is_opaque(const ImageRgba8& image) {
  return std::all_of(image.pixels.begin(), image.pixels.end(),
                     [](const Rgba8& p) { return p[3] == 255; });
}

std::string encode_jpeg(const ImageRgba8& image, const JpegOptions& options) {
  VIEWCELL_CHECK(!image.empty() && options.quality >= 1 && options.quality <= 100, options.quality);
  configure_openimageio();
  OIIO::ImageSpec spec(image.width_px, image.height_px, 3, OIIO::TypeUInt8);
  spec.attribute("Compression", "jpeg:" + std::to_string(options.quality));
  spec.attribute("jpeg:subsampling", options.halves_hues ? "4:2:0" : "4:4:4");
  OIIO::Filesystem::IOVecOutput memory;
  const auto output = OIIO::ImageOutput::create("jpeg", &memory);
  if (!output) throw MachineError("OpenImageIO cannot write JPEG");
  const bool written = output->open("memory.jpg", spec) &&
                       output->write_image(OIIO::TypeUInt8, image.pixels.data(), sizeof(Rgba8));
  if (!output->close() || !written)
    throw MachineError("encoding a JPEG: " + first_line(output->geterror()));
  const std::vector<unsigned char>& bytes = memory.buffer();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace viewcell

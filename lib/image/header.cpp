#include "image/header.h"

#include <zlib.h>

#include <cstdint>
#include <optional>

#include "base/error.h"

namespace viewcell {
namespace {

struct Size {
  long long width_px;
  long long height_px;
};

std::uint32_t byte_at(std::string_view bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[i]);
}

std::uint32_t big_endian_16(std::string_view bytes, std::size_t i) {
  return byte_at(bytes, i) << 8 | byte_at(bytes, i + 1);
}

std::uint32_t big_endian_32(std::string_view bytes, std::size_t i) {
  return big_endian_16(bytes, i) << 16 | big_endian_16(bytes, i + 2);
}

std::uint32_t little_endian_16(std::string_view bytes, std::size_t i) {
  return byte_at(bytes, i) | byte_at(bytes, i + 1) << 8;
}

std::uint32_t little_endian_24(std::string_view bytes, std::size_t i) {
  return little_endian_16(bytes, i) | byte_at(bytes, i + 2) << 16;
}

bool has_at(std::string_view bytes, std::size_t i, std::string_view magic) {
  return bytes.size() >= i + magic.size() && bytes.substr(i, magic.size()) == magic;
}

std::optional<ImageFormat> format_of(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (has_at(bytes, 0, "\x89PNG\r\n\x1a\n"sv)) return ImageFormat::png;
  if (has_at(bytes, 0, "\xff\xd8\xff"sv)) return ImageFormat::jpeg;
  if (has_at(bytes, 0, "\x76\x2f\x31\x01"sv)) return ImageFormat::openexr;
  if (has_at(bytes, 0, "II*\0"sv) || has_at(bytes, 0, "MM\0*"sv)) return ImageFormat::tiff;
  if (has_at(bytes, 0, "RIFF"sv) && has_at(bytes, 8, "WEBP"sv)) return ImageFormat::webp;
  return std::nullopt;
}

// Walks the chunks to IEND and checks their sums, because libpng prints on stderr what it finds.
std::optional<Size> png_size(std::string_view bytes) {
  constexpr std::size_t kFrame = 12;  // length, type and sum around a chunk's data
  if (!has_at(bytes, 12, "IHDR")) return std::nullopt;
  for (std::size_t i = 8; i + kFrame <= bytes.size();) {
    const std::size_t length = big_endian_32(bytes, i);
    if (length > bytes.size() - i - kFrame) return std::nullopt;
    const auto* type = reinterpret_cast<const Bytef*>(bytes.data() + i + 4);
    if (crc32_z(0, type, length + 4) != big_endian_32(bytes, i + 8 + length)) return std::nullopt;
    if (has_at(bytes, i + 4, "IEND"))
      return Size{big_endian_32(bytes, 16), big_endian_32(bytes, 20)};
    i += kFrame + length;
  }
  return std::nullopt;
}

// SOF0 to SOF15, except the tables DHT, JPG and DAC that sit among their numbers.
bool is_start_of_frame(std::uint32_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

// Walks the segments to the frame header, and holds that the end marker follows it.
std::optional<Size> jpeg_size(std::string_view bytes) {
  std::size_t i = 2;
  while (i + 9 <= bytes.size()) {
    if (byte_at(bytes, i) != 0xff) return std::nullopt;
    const std::uint32_t marker = byte_at(bytes, i + 1);
    if (marker == 0xff) {  // fill byte
      ++i;
      continue;
    }
    if (is_start_of_frame(marker)) {
      if (bytes.find("\xff\xd9", i) == std::string_view::npos) return std::nullopt;
      return Size{big_endian_16(bytes, i + 7), big_endian_16(bytes, i + 5)};
    }
    i += 2 + big_endian_16(bytes, i + 2);
  }
  return std::nullopt;
}

// The three kinds of first chunk: lossy, lossless, extended.
std::optional<Size> webp_size(std::string_view bytes) {
  if (bytes.size() < 30) return std::nullopt;
  if (has_at(bytes, 12, "VP8 "))
    return Size{little_endian_16(bytes, 26) & 0x3fff, little_endian_16(bytes, 28) & 0x3fff};
  if (has_at(bytes, 12, "VP8L")) {
    const std::uint32_t all = little_endian_24(bytes, 21) | byte_at(bytes, 24) << 24;
    return Size{(all & 0x3fff) + 1, (all >> 14 & 0x3fff) + 1};
  }
  if (has_at(bytes, 12, "VP8X"))
    return Size{little_endian_24(bytes, 24) + 1LL, little_endian_24(bytes, 27) + 1LL};
  return std::nullopt;
}

}  // namespace

const char* name_of(ImageFormat format) {
  switch (format) {
    case ImageFormat::png:
      return "png";
    case ImageFormat::jpeg:
      return "jpeg";
    case ImageFormat::openexr:
      return "openexr";
    case ImageFormat::tiff:
      return "tiff";
    case ImageFormat::webp:
      return "webp";
  }
  throw_bug(__FILE__, __LINE__, "unknown image format", static_cast<int>(format));
}

const char* extension_of(ImageFormat format) {
  switch (format) {
    case ImageFormat::png:
      return ".png";
    case ImageFormat::jpeg:
      return ".jpg";
    case ImageFormat::openexr:
      return ".exr";
    case ImageFormat::tiff:
      return ".tif";
    case ImageFormat::webp:
      return ".webp";
  }
  throw_bug(__FILE__, __LINE__, "unknown image format", static_cast<int>(format));
}

void check_image_size(long long width_px, long long height_px, const std::string& file) {
  const auto size = std::to_string(width_px) + " x " + std::to_string(height_px) + " pixels";
  if (width_px < 1 || height_px < 1) throw InputError(file, "header", size);
  if (width_px > kMaxImageSidePx || height_px > kMaxImageSidePx ||
      width_px * height_px > kMaxImagePixels)
    throw InputError(file, "header",
                     size + ", more than " + std::to_string(kMaxImageSidePx) + " a side or " +
                         std::to_string(kMaxImagePixels) + " in all");
}

ImageFormat check_image_header(std::string_view bytes, const std::string& file) {
  const std::optional<ImageFormat> format = format_of(bytes);
  if (!format) throw InputError(file, "", "is not a PNG, JPEG, EXR, TIFF or WebP picture");
  std::optional<Size> size;
  switch (*format) {
    case ImageFormat::png:
      size = png_size(bytes);
      break;
    case ImageFormat::jpeg:
      size = jpeg_size(bytes);
      break;
    case ImageFormat::webp:
      size = webp_size(bytes);
      break;
    case ImageFormat::openexr:
    case ImageFormat::tiff:
      return *format;  // opened without allocating: the caller checks
  }
  if (!size) throw InputError(file, "header", std::string("malformed or cut ") + name_of(*format));
  check_image_size(size->width_px, size->height_px, file);
  return *format;
}

}  // namespace viewcell

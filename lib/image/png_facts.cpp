#include <zlib.h>

#include <algorithm>
#include <array>
#include <vector>

#include "image/picture_facts.h"

// Follows: PNG specification, second edition, chapters 5, 8 and 11.

namespace viewcell {
namespace {

struct PngLayout {
  std::uint64_t width_px = 0, height_px = 0, bits_per_pixel = 0;
  bool interlaced = false;
};

constexpr std::uint64_t kDeflateMost = 1032;  // what a byte of it can turn into

std::uint64_t channels_of_type(std::uint32_t color_type) {
  switch (color_type) {
    case 2:
      return 3;
    case 4:
      return 2;
    case 6:
      return 4;
    default:
      return 1;  // gray, palette
  }
}

std::uint64_t bytes_of_rows(const PngLayout& png, std::uint64_t width, std::uint64_t height) {
  if (width == 0 || height == 0) return 0;
  return height * (1 + (width * png.bits_per_pixel + 7) / 8);  // a filter's number before each row
}

// What the compressed stream holds. Adam7 has seven smaller pictures.
std::uint64_t count_raw_bytes(const PngLayout& png) {
  if (!png.interlaced) return bytes_of_rows(png, png.width_px, png.height_px);
  struct Pass {
    std::uint64_t x0, y0, dx, dy;
  };
  constexpr std::array<Pass, 7> kPasses{{{0, 0, 8, 8},
                                         {4, 0, 8, 8},
                                         {0, 4, 4, 8},
                                         {2, 0, 4, 4},
                                         {0, 2, 2, 4},
                                         {1, 0, 2, 2},
                                         {0, 1, 1, 2}}};
  std::uint64_t n = 0;
  for (const Pass& pass : kPasses) {
    const auto part = [](std::uint64_t side, std::uint64_t from, std::uint64_t step) {
      return side > from ? (side - from + step - 1) / step : 0;
    };
    n += bytes_of_rows(png, part(png.width_px, pass.x0, pass.dx),
                       part(png.height_px, pass.y0, pass.dy));
  }
  return n;
}

struct PngChunks {
  std::vector<std::string_view> data;  // IDAT's
  std::uint64_t n_data_bytes = 0, n_pictures = 1;
};

// Walks the chunks to IEND and checks their sums.
std::optional<PngChunks> walk_chunks(std::string_view bytes) {
  constexpr std::size_t kFrame = 12;  // length, type and sum around a chunk's data
  const HeaderBytes header(bytes);
  PngChunks chunks;
  for (std::size_t i = 8; i + kFrame <= bytes.size();) {
    const std::size_t length = header.be32(i);
    if (length > bytes.size() - i - kFrame) return std::nullopt;
    const auto* type = reinterpret_cast<const Bytef*>(bytes.data() + i + 4);
    if (crc32_z(0, type, length + 4) != header.be32(i + 8 + length)) return std::nullopt;
    if (header.has_at(i + 4, "IEND")) return chunks;
    if (header.has_at(i + 4, "acTL")) chunks.n_pictures = std::max(1U, header.be32(i + 8));
    if (header.has_at(i + 4, "IDAT")) {
      chunks.data.push_back(bytes.substr(i + 8, length));
      chunks.n_data_bytes += length;
    }
    i += kFrame + length;
  }
  return std::nullopt;
}

// Whether the chunks' data inflate to at least n bytes.
bool holds_bytes(const PngChunks& chunks, std::uint64_t n) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) return false;
  std::vector<Bytef> scratch(1 << 16);
  std::uint64_t n_out = 0;
  int code = Z_OK;
  for (const std::string_view data : chunks.data) {
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
    stream.avail_in = static_cast<uInt>(data.size());
    do {
      stream.next_out = scratch.data();
      stream.avail_out = static_cast<uInt>(scratch.size());
      code = inflate(&stream, Z_NO_FLUSH);
      n_out += scratch.size() - stream.avail_out;
    } while (code == Z_OK && n_out < n && (stream.avail_in > 0 || stream.avail_out == 0));
    if ((code != Z_OK && code != Z_BUF_ERROR) || n_out >= n) break;
  }
  inflateEnd(&stream);
  return n_out >= n && (code == Z_OK || code == Z_STREAM_END || code == Z_BUF_ERROR);
}

}  // namespace

std::optional<PictureFacts> png_facts(std::string_view bytes) {
  const HeaderBytes header(bytes);
  if (!header.has_at(12, "IHDR")) return std::nullopt;
  const std::optional<PngChunks> chunks = walk_chunks(bytes);
  if (!chunks) return std::nullopt;
  const PngLayout png{header.be32(16), header.be32(20),
                      header.u8(24) * channels_of_type(header.u8(25)), header.u8(28) == 1};
  PictureFacts facts{header.be32(16),   header.be32(20), chunks->n_data_bytes, 0, true,
                     chunks->n_pictures};
  // Sides go up to 2^32, and their product is held against the limits later.
  if (png.width_px > 1 << 28 || png.height_px > 1 << 28) return facts;
  const std::uint64_t n_raw = count_raw_bytes(png);
  facts.least_bytes = n_raw / kDeflateMost;
  if (facts.n_bytes >= facts.least_bytes && !holds_bytes(*chunks, n_raw)) return std::nullopt;
  return facts;
}

}  // namespace viewcell

#include "image/bc.h"

#include <algorithm>
#include <array>
#include <cstdlib>  // stb_dxt.h uses abs and memcpy, and includes neither in C++
#include <cstring>

#include "base/error.h"

#define STB_DXT_STATIC
#define STB_DXT_IMPLEMENTATION
#include <stb/stb_dxt.h>

namespace viewcell {
namespace {

using Block = std::array<Rgba8, 16>;  // row by row

std::size_t bytes_of_block(BlockFormat format) {
  return format == BlockFormat::bc1 ? 8 : 16;
}

int blocks_along(int side_px) {
  return (side_px + 3) / 4;
}

// Calls visit(block's number, x, y) with the block's first pixel.
template <typename Visit>
void for_each_block(int width_px, int height_px, const Visit& visit) {
  std::size_t number = 0;
  for (int y = 0; y < height_px; y += 4)
    for (int x = 0; x < width_px; x += 4) visit(number++, x, y);
}

Block gather_block(const ImageRgba8& image, int x0, int y0, BlockFormat format) {
  Block block;
  for (int i = 0; i < 16; ++i) {
    const int x = std::min(x0 + i % 4, image.width_px - 1);
    const int y = std::min(y0 + i / 4, image.height_px - 1);
    Rgba8& pixel = block[static_cast<std::size_t>(i)] = image.at(x, y);
    // The encoder looks at alpha for whether the block is of one colour.
    if (format == BlockFormat::bc1) pixel[3] = 255;
  }
  return block;
}

Rgba8 expand_565(std::uint32_t c) {
  const std::uint32_t r = c >> 11, g = c >> 5 & 63, b = c & 31;
  return {static_cast<std::uint8_t>(r << 3 | r >> 2), static_cast<std::uint8_t>(g << 2 | g >> 4),
          static_cast<std::uint8_t>(b << 3 | b >> 2), 255};
}

// (a * weight_a + b * weight_b) / (weight_a + weight_b), channel by channel.
Rgba8 mix(const Rgba8& a, const Rgba8& b, int weight_a, int weight_b) {
  Rgba8 out{0, 0, 0, 255};
  for (std::size_t c = 0; c < 3; ++c)
    out[c] = static_cast<std::uint8_t>((a[c] * weight_a + b[c] * weight_b) / (weight_a + weight_b));
  return out;
}

// always_four: BC3's colour has no third mode.
void decode_color(const std::uint8_t* bytes, bool always_four, Block& block) {
  const std::uint32_t first = bytes[0] | bytes[1] << 8, second = bytes[2] | bytes[3] << 8;
  std::array<Rgba8, 4> palette{expand_565(first), expand_565(second)};
  if (always_four || first > second) {
    palette[2] = mix(palette[0], palette[1], 2, 1);
    palette[3] = mix(palette[0], palette[1], 1, 2);
  } else {
    palette[2] = mix(palette[0], palette[1], 1, 1);
    palette[3] = {0, 0, 0, 0};
  }
  for (std::size_t i = 0; i < 16; ++i) block[i] = palette[bytes[4 + i / 4] >> 2 * (i % 4) & 3];
}

void decode_alpha(const std::uint8_t* bytes, Block& block) {
  const int first = bytes[0], second = bytes[1];
  std::array<int, 8> palette{first, second};
  const int n_steps = first > second ? 7 : 5;
  for (int i = 1; i < n_steps; ++i)
    palette[static_cast<std::size_t>(i + 1)] = ((n_steps - i) * first + i * second) / n_steps;
  if (n_steps == 5) palette[6] = 0, palette[7] = 255;
  std::uint64_t indices = 0;
  for (std::size_t i = 0; i < 6; ++i) indices |= std::uint64_t{bytes[2 + i]} << 8 * i;
  for (std::size_t i = 0; i < 16; ++i)
    block[i][3] = static_cast<std::uint8_t>(palette[indices >> 3 * i & 7]);
}

// Endpoints in ascending order: six levels between them, then 0 and 255.
void encode_alpha_with_zero(const Block& block, std::uint8_t* bytes) {
  int least = 255, most = 1;
  for (const Rgba8& pixel : block) {
    if (pixel[3] == 0) continue;
    least = std::min<int>(least, pixel[3]), most = std::max<int>(most, pixel[3]);
  }
  const int range = std::max(most - least, 0);
  bytes[0] = static_cast<std::uint8_t>(std::min(least, most));
  bytes[1] = static_cast<std::uint8_t>(most);
  std::uint64_t indices = 0;
  for (std::size_t i = 0; i < 16; ++i) {
    // Its level, from the first endpoint to the second; in the file the endpoints come first.
    const int level = range == 0 ? 0 : (5 * (block[i][3] - least) + range / 2) / range;
    const int index = block[i][3] == 0 ? 6 : level == 0 ? 0 : level == 5 ? 1 : level + 1;
    indices |= static_cast<std::uint64_t>(index) << 3 * i;
  }
  for (std::size_t i = 0; i < 6; ++i)
    bytes[2 + i] = static_cast<std::uint8_t>(indices >> 8 * i & 255);
}

bool has_zero_alpha(const Block& block) {
  return std::any_of(block.begin(), block.end(), [](const Rgba8& pixel) { return pixel[3] == 0; });
}

void scatter_block(const Block& block, int x0, int y0, ImageRgba8& image) {
  for (int y = y0; y < std::min(y0 + 4, image.height_px); ++y)
    for (int x = x0; x < std::min(x0 + 4, image.width_px); ++x)
      image.at(x, y) = block[static_cast<std::size_t>(4 * (y - y0) + x - x0)];
}

}  // namespace

std::size_t block_bytes(BlockFormat format, int width_px, int height_px) {
  return static_cast<std::size_t>(blocks_along(width_px)) *
         static_cast<std::size_t>(blocks_along(height_px)) * bytes_of_block(format);
}

BlockImage encode_blocks(const ImageRgba8& image, BlockFormat format, ZeroAlpha zero) {
  BlockImage out{format, image.width_px, image.height_px, {}};
  out.blocks.resize(block_bytes(format, image.width_px, image.height_px));
  for_each_block(image.width_px, image.height_px, [&](std::size_t number, int x, int y) {
    const Block block = gather_block(image, x, y, format);
    std::uint8_t* bytes = &out.blocks[number * bytes_of_block(format)];
    stb_compress_dxt_block(bytes, block[0].data(), format == BlockFormat::bc3, STB_DXT_HIGHQUAL);
    if (format == BlockFormat::bc3 && zero == ZeroAlpha::exact && has_zero_alpha(block))
      encode_alpha_with_zero(block, bytes);
  });
  return out;
}

ImageRgba8 decode_blocks(const BlockImage& image) {
  VIEWCELL_CHECK(image.blocks.size() == block_bytes(image.format, image.width_px, image.height_px),
                 image.blocks.size(), image.width_px, image.height_px);
  ImageRgba8 out(image.width_px, image.height_px);
  const bool has_alpha = image.format == BlockFormat::bc3;
  for_each_block(image.width_px, image.height_px, [&](std::size_t number, int x, int y) {
    const std::uint8_t* bytes = &image.blocks[number * bytes_of_block(image.format)];
    Block block;
    decode_color(bytes + (has_alpha ? 8 : 0), has_alpha, block);
    if (has_alpha) decode_alpha(bytes, block);
    scatter_block(block, x, y, out);
  });
  return out;
}

}  // namespace viewcell

// Block compression of textures: BC1 (DXT1) and BC3 (DXT5).
#pragma once

#include <cstdint>
#include <vector>

#include "image/image.h"

namespace viewcell {

enum class BlockFormat {
  bc1,  ///< 8 bytes for 4 x 4 pixels; colour only
  bc3,  ///< 16 bytes: BC1's colour and 8 levels of alpha
};

/// What becomes of alpha 0 among other values.
enum class ZeroAlpha {
  nearest,  ///< the nearest of eight levels
  exact     ///< 0, and nothing else becomes 0: beside it six levels
};

/// A picture as blocks, row by row. Sides need not be multiples of 4: blocks cover them, and what
/// lies beyond is never seen.
struct BlockImage {
  BlockFormat format = BlockFormat::bc1;
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> blocks;
};

/// The bytes that a picture of this size takes.
std::size_t block_bytes(BlockFormat format, int width_px, int height_px);

/// Encodes; the last row and column are repeated where a block reaches beyond. BC1 drops alpha.
/// One thread, about 40 ms a megapixel. Same pixels, same bytes.
BlockImage encode_blocks(const ImageRgba8& image, BlockFormat format,
                         ZeroAlpha zero = ZeroAlpha::nearest);

/// Decodes as the format's integer formulas have it, truncating thirds and sevenths. BC1's third
/// colour mode gives transparent black; encode_blocks never uses it. blocks must be of the size
/// that block_bytes says.
ImageRgba8 decode_blocks(const BlockImage& image);

}  // namespace viewcell

#include "image/bc.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "common/same_every_time.h"
#include "image/metrics.h"
#include "image/random_image.h"

namespace viewcell {
namespace {

constexpr BlockFormat kFormats[] = {BlockFormat::bc1, BlockFormat::bc3};

ImageRgba8 decoded(const ImageRgba8& image, BlockFormat format) {
  return decode_blocks(encode_blocks(image, format));
}

int largest_difference(const ImageRgba8& a, const ImageRgba8& b, std::size_t n_channels) {
  int largest = 0;
  for (std::size_t p = 0; p < a.pixels.size(); ++p)
    for (std::size_t c = 0; c < n_channels; ++c)
      largest = std::max(largest, std::abs(a.pixels[p][c] - b.pixels[p][c]));
  return largest;
}

// 565: red, then blue, indices 0 1 2 3 along each row.
TEST(BlockDecode, FourColoursByHand) {
  const BlockImage image{BlockFormat::bc1, 4, 4, {0x00, 0xf8, 0x1f, 0x00, 0xe4, 0xe4, 0xe4, 0xe4}};
  const ImageRgba8 out = decode_blocks(image);
  for (int y = 0; y < 4; ++y) {
    EXPECT_EQ(out.at(0, y), (Rgba8{255, 0, 0, 255}));
    EXPECT_EQ(out.at(1, y), (Rgba8{0, 0, 255, 255}));
    EXPECT_EQ(out.at(2, y), (Rgba8{170, 0, 85, 255}));
    EXPECT_EQ(out.at(3, y), (Rgba8{85, 0, 170, 255}));
  }
}

// The first colour not greater than the second: a mean, and transparent black.
TEST(BlockDecode, ThreeColoursByHand) {
  const BlockImage image{BlockFormat::bc1, 4, 4, {0x1f, 0x00, 0x00, 0xf8, 0xe4, 0xe4, 0xe4, 0xe4}};
  const ImageRgba8 out = decode_blocks(image);
  EXPECT_EQ(out.at(0, 3), (Rgba8{0, 0, 255, 255}));
  EXPECT_EQ(out.at(1, 3), (Rgba8{255, 0, 0, 255}));
  EXPECT_EQ(out.at(2, 3), (Rgba8{127, 0, 127, 255}));
  EXPECT_EQ(out.at(3, 3), (Rgba8{0, 0, 0, 0}));
}

// Alpha 210 and 0 in eight levels: 210 0 180 150 120 90 60 30. Indices 0 1 2 3 4 5 6 7, twice.
TEST(BlockDecode, AlphaByHand) {
  const BlockImage image{
      BlockFormat::bc3,
      4,
      4,
      {210, 0, 0x88, 0xc6, 0xfa, 0x88, 0xc6, 0xfa, 0, 0, 0xff, 0xff, 0, 0, 0, 0}};
  const int levels[8] = {210, 0, 180, 150, 120, 90, 60, 30};
  const ImageRgba8 out = decode_blocks(image);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(out.pixels[i], (Rgba8{0, 0, 0, static_cast<std::uint8_t>(levels[i % 8])})) << i;
  }
}

// The other way round: 0 and 200 in six levels, then 0 and 255.
TEST(BlockDecode, AlphaWithBlackAndWhiteByHand) {
  const BlockImage image{
      BlockFormat::bc3, 4, 4, {0, 200, 0x88, 0xc6, 0xfa, 0x88, 0xc6, 0xfa, 0, 0, 0, 0, 0, 0, 0, 0}};
  const int levels[8] = {0, 200, 40, 80, 120, 160, 0, 255};
  const ImageRgba8 out = decode_blocks(image);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(out.pixels[i][3], levels[i % 8]) << i;
}

// Where 0 is exact, only 0 becomes 0, and what lies between has six levels of the rest's range.
TEST(BlockEncode, ZeroAlphaIsExact) {
  Random random(9);
  for (int k = 0; k < 300; ++k) {
    ImageRgba8 image = random_image(8, 4, random);
    const int least = 1 + static_cast<int>(random.below(200));
    const int most =
        least + static_cast<int>(random.below(static_cast<std::uint32_t>(256 - least)));
    for (Rgba8& p : image.pixels)
      p[3] = static_cast<std::uint8_t>(
          random.below(4) == 0
              ? 0
              : least +
                    static_cast<int>(random.below(static_cast<std::uint32_t>(most - least + 1))));
    const ImageRgba8 out = decode_blocks(encode_blocks(image, BlockFormat::bc3, ZeroAlpha::exact));
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      ASSERT_EQ(out.pixels[i][3] == 0, image.pixels[i][3] == 0) << k;
      EXPECT_LE(std::abs(out.pixels[i][3] - image.pixels[i][3]), (most - least) / 10 + 1) << k;
    }
  }
  const ImageRgba8 nothing(4, 4, {1, 2, 3, 0});
  EXPECT_EQ(decode_blocks(encode_blocks(nothing, BlockFormat::bc3, ZeroAlpha::exact)).at(2, 2)[3],
            0);
}

TEST(BlockEncode, OneColourIsKeptWithinTheStepOf565) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const ImageRgba8 image(4, 4, random_image(1, 1, random).pixels[0]);
    for (const BlockFormat format : kFormats)
      EXPECT_LE(largest_difference(decoded(image, format), image, 3), 4);
    EXPECT_EQ(decoded(image, BlockFormat::bc3).pixels[0][3], image.pixels[0][3]);
    EXPECT_EQ(decoded(image, BlockFormat::bc1).pixels[0][3], 255);
  }
  for (const std::uint8_t end : {0, 255}) {
    const ImageRgba8 image(4, 4, {end, end, end, 255});
    EXPECT_EQ(decoded(image, BlockFormat::bc1).pixels, image.pixels);
  }
}

// Two colours that 565 holds exactly come back exactly, wherever they lie.
TEST(BlockEncode, TwoColoursOf565AreExact) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Rgba8 dark{static_cast<std::uint8_t>(random.below(2) * 33), 0, 66, 255};
    const Rgba8 bright{222, 255, 189, 255};
    ImageRgba8 image(4, 4, dark);
    for (Rgba8& p : image.pixels) p = random.below(2) ? dark : bright;
    EXPECT_EQ(decoded(image, BlockFormat::bc1).pixels, image.pixels);
    EXPECT_EQ(decoded(image, BlockFormat::bc3).pixels, image.pixels);
  }
}

TEST(BlockEncode, ASmoothPictureOfAnySizeIsClose) {
  for (const auto& [width, height] : {std::pair{64, 64}, {61, 35}, {1, 1}, {3, 9}, {5, 4}}) {
    ImageRgba8 image(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        image.at(x, y) = {static_cast<std::uint8_t>(100 + x), static_cast<std::uint8_t>(150 - y),
                          static_cast<std::uint8_t>(60 + x + y),
                          static_cast<std::uint8_t>(255 - 2 * x)};
    for (const BlockFormat format : kFormats) {
      const BlockImage blocks = encode_blocks(image, format);
      EXPECT_EQ(blocks.blocks.size(), block_bytes(format, width, height));
      const ImageRgba8 out = decode_blocks(blocks);
      ASSERT_EQ(out.pixels.size(), image.pixels.size());
      EXPECT_LE(largest_difference(out, image, 3), 8) << width << " x " << height;
      EXPECT_GT(compare_images(image, out).psnr_db, 38) << width << " x " << height;
      if (format == BlockFormat::bc3) {
        EXPECT_LE(largest_difference(out, image, 4), 8);
      }
    }
  }
}

// Noise is the worst case; still opaque, and nearer than its own mean.
TEST(BlockEncode, NoiseStaysOpaqueAndBounded) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const ImageRgba8 image = random_image(32, 32, random);
    const ImageRgba8 out = decoded(image, BlockFormat::bc1);
    for (const Rgba8& p : out.pixels) EXPECT_EQ(p[3], 255);
    EXPECT_LT(compare_images(image, out).rms, 45);
    const ImageRgba8 with_alpha = decoded(image, BlockFormat::bc3);
    for (std::size_t p = 0; p < image.pixels.size(); ++p)
      EXPECT_NEAR(with_alpha.pixels[p][3], image.pixels[p][3], 19);  // half of 255 / 7, rounded
  }
}

TEST(BlockEncode, SameBytesEveryTime) {
  Random random(3);
  const ImageRgba8 image = random_image(20, 12, random);
  for (const BlockFormat format : kFormats) {
    const auto blocks =
        same_every_time([&](std::size_t) { return encode_blocks(image, format).blocks; });
    EXPECT_EQ(blocks.size(), block_bytes(format, 20, 12));
  }
}

TEST(BlockEncode, SizesInBytes) {
  EXPECT_EQ(block_bytes(BlockFormat::bc1, 4, 4), 8u);
  EXPECT_EQ(block_bytes(BlockFormat::bc3, 4, 4), 16u);
  EXPECT_EQ(block_bytes(BlockFormat::bc1, 5, 1), 16u);
  EXPECT_EQ(block_bytes(BlockFormat::bc1, 0, 0), 0u);
  EXPECT_THROW(decode_blocks({BlockFormat::bc3, 4, 4, std::vector<std::uint8_t>(8)}), BugError);
}

}  // namespace
}  // namespace viewcell

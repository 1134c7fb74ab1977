// Pictures of many formats, written byte by byte, and files that lie about their size.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <zlib.h>

#include <chrono>

#include "base/file.h"
#include "base/random.h"
#include "common/expect_input_error.h"
#include "common/mutate.h"
#include "common/temporary_folder.h"
#include "image/io.h"
#include "image/memory_input.h"

namespace viewcell {
namespace {

// A picture of 3 x 2, as the formats below write it.
constexpr Rgba8 kPixels[2][3] = {{{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}},
                                 {{10, 20, 30, 255}, {40, 50, 60, 255}, {70, 80, 90, 255}}};
constexpr int kUpwards[] = {1, 0}, kDownwards[] = {0, 1};

std::string le16(std::uint32_t x) {
  return {static_cast<char>(x & 255), static_cast<char>(x >> 8 & 255)};
}
std::string le32(std::uint32_t x) {
  return le16(x) + le16(x >> 16);
}
std::string be32(std::uint32_t x) {
  const std::string bytes = le32(x);
  return {bytes.rbegin(), bytes.rend()};
}

// Row by row in the order given; channels "BGR", "RGB", or with a byte of alpha "BGR0", "BGRA".
std::string pixel_bytes(const int (&rows)[2], const std::string& channels, std::size_t pad = 0) {
  std::string out;
  for (const int y : rows) {
    for (const Rgba8& p : kPixels[y])
      for (const char c : channels)
        out += static_cast<char>(c == 'R'   ? p[0]
                                 : c == 'G' ? p[1]
                                 : c == 'B' ? p[2]
                                 : c == 'A' ? p[3]
                                            : 0);
    out.append(pad, '\0');
  }
  return out;
}

std::string tga(int kind, int bits, int flags, const std::string& pixels,
                const std::string& map = "", std::uint32_t width = 3, std::uint32_t height = 2) {
  const auto n_map = static_cast<std::uint32_t>(map.size() / 3);
  std::string out{'\0', static_cast<char>(n_map > 0), static_cast<char>(kind)};
  out += le16(0) + le16(n_map) + static_cast<char>(n_map > 0 ? 24 : 0) + le32(0);
  out += le16(width) + le16(height) + static_cast<char>(bits) + static_cast<char>(flags);
  return out + map + pixels;
}

std::string bmp(int bits, std::int32_t height, const std::string& pixels,
                const std::string& palette = "", std::int32_t width = 3,
                std::uint32_t compression = 0) {
  const auto start = static_cast<std::uint32_t>(54 + palette.size());
  const auto n_pixels = static_cast<std::uint32_t>(pixels.size());
  return "BM" + le32(start + n_pixels) + le32(0) + le32(start) + le32(40) +
         le32(static_cast<std::uint32_t>(width)) + le32(static_cast<std::uint32_t>(height)) +
         le16(1) + le16(static_cast<std::uint32_t>(bits)) + le32(compression) + le32(n_pixels) +
         le32(2835) + le32(2835) + le32(static_cast<std::uint32_t>(palette.size() / 4)) + le32(0) +
         palette + pixels;
}

// Codes of 3 bits, with a clear code (4) after every second so that they stay so wide.
std::string gif_frame(const std::vector<int>& indices) {
  std::vector<int> codes{4};
  for (std::size_t i = 0; i < indices.size(); ++i) {
    codes.push_back(indices[i]);
    if (i % 2 == 1) codes.push_back(4);
  }
  codes.push_back(5);
  std::string data;
  std::uint32_t held = 0;
  int n_held = 0;
  for (const int code : codes) {
    held |= static_cast<std::uint32_t>(code) << n_held;
    for (n_held += 3; n_held >= 8; n_held -= 8, held >>= 8) data += static_cast<char>(held & 255);
  }
  if (n_held > 0) data += static_cast<char>(held & 255);
  return "," + le32(0) + le16(3) + le16(2) + std::string("\0\x02", 2) +
         static_cast<char>(data.size()) + data + '\0';
}

// Of four colours: the first three and the fourth of kPixels.
std::string gif(const std::vector<std::vector<int>>& frames, std::uint32_t width = 3,
                std::uint32_t height = 2) {
  std::string out = "GIF89a" + le16(width) + le16(height) + std::string("\x81\0\0", 3);
  for (const Rgba8& p : {kPixels[0][0], kPixels[0][1], kPixels[0][2], kPixels[1][0]})
    out += {static_cast<char>(p[0]), static_cast<char>(p[1]), static_cast<char>(p[2])};
  for (const std::vector<int>& frame : frames) out += gif_frame(frame);
  return out + ";";
}

std::string png_chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(body.data()), body.size());
  return be32(static_cast<std::uint32_t>(data.size())) + body +
         be32(static_cast<std::uint32_t>(sum));
}

std::string png(std::uint32_t width, std::uint32_t height, const std::string& flags,
                const std::string& pixels) {
  std::string data(compressBound(pixels.size()), '\0');
  uLongf n = data.size();
  compress(reinterpret_cast<Bytef*>(data.data()), &n, reinterpret_cast<const Bytef*>(pixels.data()),
           pixels.size());
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", be32(width) + be32(height) + flags) +
         png_chunk("IDAT", data.substr(0, n)) + png_chunk("IEND", "");
}

ImageRgba8 decode(const std::string& bytes, Remarks* remarks = nullptr) {
  return decode_image_rgba8(bytes, "nameless", {{}, remarks});
}

void expect_pixels(const std::string& bytes) {
  const ImageRgba8 image = decode(bytes);
  ASSERT_EQ(image.width_px, 3);
  ASSERT_EQ(image.height_px, 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) EXPECT_EQ(image.at(x, y), kPixels[y][x]) << x << " " << y;
}

TEST(PictureFormats, TargasOfAllKinds) {
  expect_pixels(tga(2, 24, 0x20, pixel_bytes(kDownwards, "BGR")));
  expect_pixels(tga(2, 24, 0, pixel_bytes(kUpwards, "BGR")));
  expect_pixels(tga(2, 32, 8, pixel_bytes(kUpwards, "BGRA")));
  const std::string map = pixel_bytes(kDownwards, "BGR");
  expect_pixels(tga(1, 8, 0x20, {0, 1, 2, 3, 4, 5}, map));
  expect_pixels(tga(9, 8, 0x20, {5, 0, 1, 2, 3, 4, 5}, map));  // a packet of six as they are
  expect_pixels(tga(10, 24, 0x20, '\x05' + pixel_bytes(kDownwards, "BGR")));
  // A run of six of one colour; gray.
  EXPECT_EQ(decode(tga(10, 24, 0x20, "\x85\x1e\x14\x0a")).at(2, 1), kPixels[1][0]);
  EXPECT_EQ(decode(tga(3, 8, 0x20, {0, 50, 100, 1, 2, 3})).at(2, 0), (Rgba8{100, 100, 100, 255}));
}

TEST(PictureFormats, BitmapsOfAllKinds) {
  expect_pixels(bmp(24, 2, pixel_bytes(kUpwards, "BGR", 3)));
  expect_pixels(bmp(24, -2, pixel_bytes(kDownwards, "BGR", 3)));
  const std::string palette = pixel_bytes(kDownwards, "BGR0");
  expect_pixels(bmp(8, 2, std::string("\x03\x04\x05\0\0\x01\x02\0", 8), palette));
  expect_pixels(bmp(4, 2, std::string("\x34\x50\0\0\x01\x20\0\0", 8), palette));
}

TEST(PictureFormats, NetpbmGifAndHdr) {
  expect_pixels("P6\n# a comment\n3 2\n255\n" + pixel_bytes(kDownwards, "RGB"));
  expect_pixels("P3 3 2 255 255 0 0 0 255 0 0 0 255 10 20 30 40 50 60 70 80 90\n");
  EXPECT_EQ(decode(std::string("P5 2 1 255\n\x07\xff", 13)).at(0, 0), (Rgba8{7, 7, 7, 255}));
  EXPECT_EQ(decode(std::string("P4\n2 1\n\x40", 8)).at(0, 0), (Rgba8{255, 255, 255, 255}));
  const ImageRgba8 image = decode(gif({{0, 1, 2, 3, 0, 1}}));
  EXPECT_EQ(image.at(1, 0), kPixels[0][1]);
  EXPECT_EQ(image.at(0, 1), kPixels[1][0]);
  // 0.5, 0.25, 0.125 and 1, linear.
  const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
  EXPECT_EQ(decode(hdr + "\x80\x40\x20\x80\x80\x80\x80\x81").at(0, 0), (Rgba8{188, 137, 99, 255}));
}

// The fourth byte of a pixel means nothing where it is 0 in all of them.
TEST(PictureFormats, AlphaThatIsZeroEverywhereIsPadding) {
  for (const std::string& bytes : {bmp(32, 2, pixel_bytes(kUpwards, "BGR0")),
                                   tga(2, 32, 0x20, pixel_bytes(kDownwards, "BGR0"))}) {
    expect_pixels(bytes);
    Remarks remarks;
    decode(bytes, &remarks);
    ASSERT_EQ(remarks.size(), 1u);
    EXPECT_EQ(remarks[0].what, "alpha that is 0 everywhere, taken as opaque");
  }
  std::string pixels = pixel_bytes(kDownwards, "BGR0");
  pixels[3] = 9;
  EXPECT_EQ(decode(tga(2, 32, 0x28, pixels)).at(1, 0)[3], 0);
}

TEST(PictureFormats, TheFirstOfSeveralAndAWord) {
  const TemporaryFolder folder;
  const auto file = (folder / "pages.tif").string();
  const auto output = OIIO::ImageOutput::create(file);
  for (std::uint8_t i = 0; i < 3; ++i) {
    const auto mode = i == 0 ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendSubimage;
    const std::vector<std::uint8_t> samples(12, i);
    ASSERT_TRUE(output->open(file, OIIO::ImageSpec(2, 2, 3, OIIO::TypeUInt8), mode));
    ASSERT_TRUE(output->write_image(OIIO::TypeUInt8, samples.data()));
  }
  output->close();
  Remarks pages, frames;
  EXPECT_EQ(read_image_rgba8(file, {{}, &pages}).at(0, 0), (Rgba8{0, 0, 0, 255}));
  EXPECT_EQ(decode(gif({{0, 1, 2, 3, 0, 1}, {1, 1, 1, 1, 1, 1}}), &frames).at(0, 0), kPixels[0][0]);
  ASSERT_EQ(pages.size() + frames.size(), 2u);
  EXPECT_EQ(pages[0].what, kFurtherPictures);
  EXPECT_EQ(pages[0].count, 2u);
  EXPECT_EQ(frames[0].what, kFurtherPictures);
  EXPECT_EQ(frames[0].count, 1u);
}

// Turned for display only: the rows are the file's.
TEST(PictureFormats, OrientationIsSaidNotFollowed) {
  const TemporaryFolder folder;
  const auto file = (folder / "a.tif").string();
  OIIO::ImageSpec spec(3, 2, 3, OIIO::TypeUInt8);
  spec.attribute("Orientation", 6);
  const auto output = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(output->open(file, spec));
  ASSERT_TRUE(output->write_image(OIIO::TypeUInt8, pixel_bytes(kDownwards, "RGB").data()));
  output->close();
  Remarks remarks;
  EXPECT_EQ(read_image_rgba8(file, {{}, &remarks}).width_px, 3);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_TRUE(remarks[0].what.starts_with("orientation 6"));
}

TEST(PictureFormats, WhatIsNotReadIsCalledByItsName) {
  EXPECT_INPUT_ERROR(decode("DDS and so on"), "as DDS, which is not read: convert it to PNG");
  EXPECT_INPUT_ERROR(decode("\xabKTX 20\xbb"), "KTX2");
  EXPECT_INPUT_ERROR(decode(std::string("\0\0\0\x18"
                                        "ftypavif",
                                        12)),
                     "AVIF");
  EXPECT_INPUT_ERROR(decode("P9 3 2 255\n"), "is not a PNG, JPEG");
}

// --- files that cannot hold what they say ---

struct Costs {
  long memory_kib;
  double seconds;
};

Costs costs_now() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const std::chrono::duration<double> t = std::chrono::steady_clock::now().time_since_epoch();
  return {usage.ru_maxrss, t.count()};
}

// A baseline JPEG of one component, whose scan has n bytes; progressive ones may have several.
std::string jpeg(std::uint32_t side, std::size_t n_scan_bytes) {
  using namespace std::string_literals;
  const std::string size{static_cast<char>(side >> 8), static_cast<char>(side & 255)};
  return "\xff\xd8\xff\xc0\0\x0b\x08"s + size + size + "\x01\x01\x11\0"s +
         "\xff\xda\0\x08\x01\x01\0\0\x3f\0"s + std::string(n_scan_bytes, '\x55') + "\xff\xd9"s;
}

TEST(PictureBombs, AreRefusedForWhatTheirBytesCannotHold) {
  using namespace std::string_literals;
  const std::string few(100, '\0');
  const std::vector<std::pair<const char*, std::string>> bombs{
      {"png", png(16384, 16384, "\x08\x06\0\0\0"s, few)},
      {"png", png(16384, 16384, "\x08\x06\0\0\x01"s, few)},  // interlaced
      {"png",
       png(16384, 16384, "\x01\0\0\0\0"s, std::string(1 << 22, '\0'))},  // an eighth is there
      {"jpeg", jpeg(16384, 900)},
      {"gif", gif({{0, 1, 2, 3, 0, 1}}, 16000, 16000)},
      {"bmp", bmp(24, 16384, few, "", 16384)},
      {"bmp, run lengths", bmp(8, 16384, few, few, 16384, 1)},
      {"tga", tga(2, 24, 0, few, "", 16384, 16384)},
      {"tga, run lengths", tga(10, 24, 0, few, "", 16384, 16384)},
      {"ppm", "P6 16384 16384 255\n" + few},
      {"ppm, text", "P3 16384 16384 255\n0 0 0"},
      {"pfm", "PF\n16384 16384\n-1.0\n" + few},
      {"hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16384 +X 16384\n" + few},
      {"webp", "RIFF\x40\0\0\0WEBPVP8L\x10\0\0\0\x2f\xff\xff\xff\x0f"s + few}};
  for (const auto& [name, bytes] : bombs) {
    SCOPED_TRACE(name);
    const Costs before = costs_now();
    std::string error;
    try {
      decode(bytes);
    } catch (const InputError& refused) {
      error = refused.what();
    }
    EXPECT_TRUE(error.starts_with("nameless: ")) << error;
    EXPECT_TRUE(error.find(" x ") != std::string::npos || error.find("cut") != std::string::npos)
        << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
    EXPECT_LT(costs_now().memory_kib - before.memory_kib, 32 * 1024);
    EXPECT_LT(costs_now().seconds - before.seconds, 0.5);
  }
}

// The same lies as TIFF and EXR, whose headers OpenImageIO reads.
TEST(PictureBombs, TiffAndExr) {
  const TemporaryFolder folder;
  for (const char* name : {"a.tif", "a.exr"}) {
    for (const char* compression : {"none", "zip"}) {
      SCOPED_TRACE(std::string(name) + " " + compression);
      const auto file = (folder / name).string();
      OIIO::ImageSpec spec(16384, 16, 3, OIIO::TypeHalf);
      if (name[2] == 't') spec.format = OIIO::TypeUInt8;
      spec.attribute("compression", compression);
      const auto output = OIIO::ImageOutput::create(file);
      ASSERT_TRUE(output->open(file, spec));
      const std::vector<std::uint8_t> samples(16384 * 16 * 3);
      ASSERT_TRUE(output->write_image(OIIO::TypeUInt8, samples.data()));
      output->close();
      EXPECT_EQ(read_image_rgba8(file).height_px, 16);
      std::string bytes = read_file(file);
      if (name[2] == 't') {
        const std::size_t tag = bytes.find(std::string("\x01\x01\x03\0\x01\0\0\0\x10\0", 10));
        ASSERT_NE(tag, std::string::npos);
        bytes.replace(tag + 8, 2, le16(16384));
      } else {
        const std::size_t window = bytes.find("dataWindow");
        bytes.replace(window + 11 + 6 + 4 + 12, 4, le32(16383));
        bytes.append(1 << 17, '\0');  // room for the table of rows
      }
      EXPECT_INPUT_ERROR(decode_image_rgba8(bytes, "x"), "16384 x 16384 pixels");
    }
  }
}

// Rows of 67 million pixels: before OpenEXR makes room for one.
TEST(PictureBombs, ExrOfLongRows) {
  const TemporaryFolder folder;
  const auto file = (folder / "a.exr").string();
  const auto output = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(output->open(file, OIIO::ImageSpec(4, 1, 3, OIIO::TypeHalf)));
  const std::vector<std::uint8_t> samples(12);
  ASSERT_TRUE(output->write_image(OIIO::TypeUInt8, samples.data()));
  output->close();
  std::string bytes = read_file(file);
  bytes.replace(bytes.find("dataWindow") + 11 + 6 + 4 + 8, 4, le32(67108868));
  const Costs before = costs_now();
  EXPECT_INPUT_ERROR(decode(bytes), "67108869 x 1 pixels");
  EXPECT_LT(costs_now().memory_kib - before.memory_kib, 32 * 1024);
}

// A chunk that the table has before the file's first byte.
TEST(PictureFormats, ExrChunksLieInTheFile) {
  const TemporaryFolder folder;
  const auto file = (folder / "a.exr").string();
  OIIO::ImageSpec spec(4, 1, 3, OIIO::TypeHalf);
  spec.attribute("compression", "none");
  const auto output = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(output->open(file, spec));
  const std::vector<std::uint8_t> samples(12);
  ASSERT_TRUE(output->write_image(OIIO::TypeUInt8, samples.data()));
  output->close();
  const std::string bytes = read_file(file);
  // At the end: a table of one place, then the chunk: row, size, 24 bytes of samples.
  const std::size_t table = bytes.size() - 8 - 8 - 24;
  for (const std::uint32_t place : {0xffffffffu, 0xfffffffdu, 0x80000000u}) {
    std::string bad = bytes;
    bad.replace(table, 8, le32(place) + le32(0xffffffffu));
    EXPECT_INPUT_ERROR(decode(bad), "");
  }
  BoundedReader reader("0123456789");
  char to[16] = {};
  for (const std::int64_t place : {-1, -4, -16, 10, 11})
    EXPECT_EQ(reader.pread(to, 4, place), 0u) << place;
  EXPECT_EQ(reader.pread(to, 16, 7), 3u);
  EXPECT_TRUE(reader.seek(-2));
  EXPECT_EQ(reader.read(to, 4), 0u);
  EXPECT_TRUE(reader.seek(4));
  EXPECT_EQ(reader.read(to, 4), 4u);
  EXPECT_EQ(std::string(to, 4), "4567");
  EXPECT_EQ(reader.tell(), 8);
}

TEST(PictureFormats, BmpOfOtherMasksIsRefused) {
  const std::string pixels(3 * 2 * 4, '\x40');
  const auto with = [&](std::uint32_t r, std::uint32_t g, std::uint32_t b) {
    return bmp(32, 2, pixels, le32(r) + le32(g) + le32(b), 3, 3);
  };
  EXPECT_EQ(decode(with(0xff0000, 0xff00, 0xff)).width_px, 3);
  EXPECT_INPUT_ERROR(decode(with(0xff, 0xff00, 0xff0000)), "bit masks of its own");
  EXPECT_INPUT_ERROR(decode(with(0xff000000, 0xff0000, 0xff00)), "bit masks of its own");
}

TEST(PictureFormats, TiffOfAnyDepth) {
  const TemporaryFolder folder;
  const int width = 37, height = 21;
  std::vector<float> samples(static_cast<std::size_t>(3 * width * height));
  Random random(1);
  for (float& sample : samples) sample = static_cast<float>(random.below(256)) / 255;
  const auto decoded = [&](const OIIO::TypeDesc& type, const char* compression, int tile) {
    const auto file = (folder / "a.tif").string();
    OIIO::ImageSpec spec(width, height, 3, type);
    spec.attribute("compression", compression);
    spec.tile_width = spec.tile_height = tile;
    const auto output = OIIO::ImageOutput::create(file);
    EXPECT_TRUE(output->open(file, spec));
    EXPECT_TRUE(output->write_image(OIIO::TypeFloat, samples.data()));
    output->close();
    return decode(read_file(file)).pixels;
  };
  for (const int tile : {0, 16})
    for (const char* compression : {"none", "zip", "lzw"}) {
      SCOPED_TRACE(compression);
      const auto linear = decoded(OIIO::TypeFloat, "none", 0);
      EXPECT_INPUT_ERROR(decoded(OIIO::TypeDesc::DOUBLE, compression, tile),
                         "64 bits a sample, which is not read");
      EXPECT_EQ(decoded(OIIO::TypeFloat, compression, tile), linear);
      const auto encoded = decoded(OIIO::TypeUInt8, "none", 0);
      EXPECT_EQ(decoded(OIIO::TypeUInt16, compression, tile), encoded);
      EXPECT_EQ(decoded(OIIO::TypeUInt8, compression, tile), encoded);
    }
}

// How many rows a strip has says nothing of the picture; of what cannot be decoded nothing is
// shown.
TEST(PictureFormats, TiffStripsAndTiles) {
  using namespace std::string_literals;
  const TemporaryFolder folder;
  const auto file = (folder / "a.tif").string();
  const int width = 400, height = 30;
  Random random(1);
  std::vector<std::uint8_t> samples(static_cast<std::size_t>(4 * width * height));
  for (std::uint8_t& sample : samples) sample = static_cast<std::uint8_t>(random.below(256));
  const auto written = [&](const char* compression, int n_channels, int tile) {
    OIIO::ImageSpec spec(width, height, n_channels, OIIO::TypeUInt8);
    spec.attribute("compression", compression);
    spec.attribute("tiff:RowsPerStrip", height);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.tile_width = spec.tile_height = tile;
    const auto output = OIIO::ImageOutput::create(file);
    EXPECT_TRUE(output->open(file, spec));
    EXPECT_TRUE(output->write_image(OIIO::TypeUInt8, samples.data()));
    output->close();
    return read_file(file);
  };
  for (const char* compression : {"none", "zip", "lzw", "packbits"})
    for (const int n_channels : {1, 2, 3, 4})
      for (const int tile : {0, 16, 64}) {
        SCOPED_TRACE(std::string(compression) + ", " + std::to_string(n_channels) + ", " +
                     std::to_string(tile));
        const std::string good = written(compression, n_channels, tile);
        const ImageRgba8 picture = decode(good);
        for (const auto& [x, y] : {std::pair(0, 0), {399, 29}, {63, 17}, {64, 15}})
          EXPECT_EQ(picture.at(x, y)[0],
                    samples[static_cast<std::size_t>(n_channels * (y * width + x))]);
        if (compression == "zip"s) {
          std::string broken = good;
          broken.replace(good.find("\x78\x9c"s) + 2, 1, "\xff");  // a block of no kind
          EXPECT_INPUT_ERROR(decode(broken), "pixels");
        }
        EXPECT_THROW(decode(good.substr(0, good.size() / 2)), InputError);
      }
  const std::string good = written("zip", 1, 0), rows = "\x16\x01\x03\0\x01\0\0\0\x1e\0"s;
  ASSERT_NE(good.find(rows), std::string::npos);
  for (const std::uint32_t n : {0xffffffffu, 0x7fffffffu, 2000000000u, 60000u, 64u}) {
    SCOPED_TRACE(n);
    const Costs before = costs_now();
    std::string many = good;
    many.replace(good.find(rows), 12, "\x16\x01\x04\0\x01\0\0\0"s + le32(n));
    EXPECT_EQ(decode(many).pixels, decode(good).pixels);
    EXPECT_LT(costs_now().memory_kib - before.memory_kib, 32 * 1024);
  }
}

// An attribute that says two gigabytes, a window of as many rows: OpenEXR makes room for either.
TEST(PictureBombs, ExrHeaders) {
  const TemporaryFolder folder;
  const auto file = (folder / "a.exr").string();
  const auto output = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(output->open(file, OIIO::ImageSpec(4, 4, 3, OIIO::TypeHalf)));
  const std::vector<std::uint8_t> samples(48);
  ASSERT_TRUE(output->write_image(OIIO::TypeUInt8, samples.data()));
  output->close();
  const std::string good = read_file(file);
  std::string bad = good;
  const std::size_t size = bad.find(std::string("channels\0chlist\0", 16)) + 16;
  bad.replace(size, 4, le32(0x7c000013));
  const Costs before = costs_now();
  EXPECT_INPUT_ERROR(decode(bad), "malformed or cut openexr");
  bad = good;
  const std::size_t window = bad.find("dataWindow") + 11 + 6 + 4;
  bad.replace(window + 8, 8, le32(0) + le32(0x7ffffff0));
  EXPECT_INPUT_ERROR(decode(bad), "1 x 2147483633 pixels");
  EXPECT_LT(costs_now().memory_kib - before.memory_kib, 32 * 1024);
}

// OpenEXR goes by an attribute's type, not by its size, and what it then takes for sizes it makes
// room for; at channels of an unknown kind OpenImageIO ends the program.
TEST(PictureBombs, ExrAttributesAreAsTheirTypesAsk) {
  using namespace std::string_literals;
  const TemporaryFolder folder;
  const auto file = (folder / "a.exr").string();
  const auto output = OIIO::ImageOutput::create(file);
  OIIO::ImageSpec spec(4, 4, 3, OIIO::TypeHalf);
  const char* const words[] = {"one", "two"};
  spec.attribute("words", OIIO::TypeDesc(OIIO::TypeDesc::STRING, 2), words);
  ASSERT_TRUE(output->open(file, spec));
  const std::vector<std::uint8_t> samples(48);
  ASSERT_TRUE(output->write_image(OIIO::TypeUInt8, samples.data()));
  output->close();
  const std::string good = read_file(file);
  EXPECT_EQ(decode(good).width_px, 4);
  const auto refused = [&](const std::string& from, const std::string& to) {
    SCOPED_TRACE(from);
    EXPECT_INPUT_ERROR(decode(replaced(good, from, to)), "malformed or cut openexr");
  };
  refused("float\0\x04\0\0\0"s, "float\0\0\0\0\0"s);
  refused("float\0\x04\0\0\0"s, "v2f\0\x04\0\0\0"s);
  refused("box2i\0\x10\0\0\0"s, "box2i\0\x0f\0\0\0"s);
  refused("B\0\x01\0\0\0"s, "B\0\x03\0\0\0"s);
  refused("B\0\x01\0\0\0\0\0\0\0\x01\0"s, "B\0\x01\0\0\0\0\0\0\0\0\0"s);
  refused("chlist\0\x37\0"s, "chlist\0\x36\0"s);
  refused("stringvector\0\x0e\0\0\0\x03\0"s, "stringvector\0\x0e\0\0\0\x03\x7f"s);
}

// A plain picture is small, and true.
TEST(PictureBombs, PlainPicturesAreNone) {
  using namespace std::string_literals;
  const std::string rows(2048 * 2049, '\0');
  EXPECT_EQ(decode(png(2048, 2048, "\x08\0\0\0\0"s, rows)).width_px, 2048);
  EXPECT_EQ(decode(png(16384, 2048, "\x01\0\0\0\0"s, rows)).width_px, 16384);
  EXPECT_EQ(decode(gif({{0, 1, 2, 3, 0, 1}}, 1000, 1000)).width_px, 1000);
}

TEST(PictureBombs, MaxPixelsIsTheLimitAndLiftsTheGuess) {
  const std::string wide = gif({{0, 1, 2, 3, 0, 1}}, 6000, 6000);
  EXPECT_INPUT_ERROR(decode(wide), "--max-pixels");
  EXPECT_EQ(decode_image_rgba8(wide, "x", {{36000000}, nullptr}).width_px, 6000);
  EXPECT_INPUT_ERROR(decode_image_rgba8(wide, "x", {{35999999}, nullptr}),
                     "6000 x 6000 pixels, more than 35999999 in all (--max-pixels)");
  const std::string lie = bmp(24, 6000, std::string(100, '\0'), "", 6000);
  EXPECT_INPUT_ERROR(decode_image_rgba8(lie, "x", {{36000000}, nullptr}), "lies about its size");
}

}  // namespace
}  // namespace viewcell

// Colours under alpha, and codes of other maxima than 255.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <webp/encode.h>

#include <array>

#include "base/file.h"
#include "base/random.h"
#include "common/expect_input_error.h"
#include "common/temporary_folder.h"
#include "image/io.h"
#include "image/random_image.h"

namespace viewcell {
namespace {

ImageRgba8 decode_bytes(const std::string& bytes, Remarks* remarks = nullptr) {
  return decode_image_rgba8(bytes, "nameless", {{}, remarks});
}

// Nothing is lost, also where alpha is 0.
std::string encode_webp(const ImageRgba8& image) {
  WebPConfig config;
  WebPPicture picture;
  WebPMemoryWriter writer;
  EXPECT_TRUE(WebPConfigInit(&config) && WebPPictureInit(&picture));
  WebPMemoryWriterInit(&writer);
  config.lossless = config.exact = 1;
  picture.use_argb = 1;
  picture.width = image.width_px, picture.height = image.height_px;
  picture.writer = WebPMemoryWrite, picture.custom_ptr = &writer;
  EXPECT_TRUE(WebPPictureImportRGBA(&picture, image.pixels[0].data(), 4 * image.width_px));
  EXPECT_TRUE(WebPEncode(&config, &picture));
  std::string bytes(reinterpret_cast<const char*>(writer.mem), writer.size);
  WebPPictureFree(&picture);
  WebPMemoryWriterClear(&writer);
  return bytes;
}

TEST(PictureAlpha, WebpKeepsColoursUnderThinAlpha) {
  Random random(4);
  ImageRgba8 image = random_image(23, 11, random);
  for (std::size_t p = 0; p < image.pixels.size(); ++p)
    image.pixels[p][3] = static_cast<std::uint8_t>(p % 4);
  EXPECT_EQ(decode_bytes(encode_webp(image)).pixels, image.pixels);
}

std::string le(std::uint32_t x, int n_bytes) {
  std::string out;
  for (int i = 0; i < n_bytes; ++i) out += static_cast<char>(x >> 8 * i & 255);
  return out;
}

// The parts of an animation of two frames: the first at (2, 4) of a canvas of 8 x 9.
TEST(PictureAlpha, WebpOfFramesIsTheFirstOnItsCanvas) {
  const ImageRgba8 image(3, 2, {90, 60, 30, 7});
  const auto chunk = [](const std::string& name, const std::string& data) {
    return name + le(static_cast<std::uint32_t>(data.size()), 4) + data +
           std::string(data.size() % 2, '\0');
  };
  const auto frame = [&](std::uint32_t x, std::uint32_t y) {
    return chunk("ANMF", le(x / 2, 3) + le(y / 2, 3) + le(2, 3) + le(1, 3) + le(100, 3) + '\0' +
                             encode_webp(image).substr(12));
  };
  const std::string body = "WEBP" + chunk("VP8X", le(0x12, 4) + le(7, 3) + le(8, 3)) +
                           chunk("ANIM", le(0, 6)) + frame(2, 4) + frame(0, 0);
  Remarks remarks;
  const ImageRgba8 read = decode_bytes(chunk("RIFF", body), &remarks);
  ASSERT_EQ(read.width_px, 8);
  ASSERT_EQ(read.height_px, 9);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 8; ++x) {
      const bool is_in = x >= 2 && x < 5 && y >= 4 && y < 6;
      EXPECT_EQ(read.at(x, y), (is_in ? Rgba8{90, 60, 30, 7} : Rgba8{0, 0, 0, 0})) << x << " " << y;
    }
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].what, kFurtherPictures);
}

TEST(PictureAlpha, WebpThatIsCutIsRefused) {
  const std::string whole = encode_webp(ImageRgba8(23, 11, {1, 2, 3, 4}));
  for (std::size_t n = 30; n < whole.size(); ++n)
    EXPECT_THROW(decode_bytes(whole.substr(0, n)), InputError) << n;
}

// A TIFF of 8 or 16 bits whose fourth sample is what `extra` says.
std::string tiff(std::uint32_t extra, std::uint32_t n_bytes,
                 const std::vector<std::uint32_t>& samples) {
  constexpr std::uint32_t kTags = 10, kAfter = 8 + 2 + 12 * kTags + 4;
  const auto tag = [](std::uint32_t id, std::uint32_t kind, std::uint32_t count,
                      std::uint32_t value) {
    return le(id, 2) + le(kind, 2) + le(count, 4) + le(value, 4);
  };
  const auto n = static_cast<std::uint32_t>(samples.size());
  std::string out = "II" + le(42, 2) + le(8, 4) + le(kTags, 2) + tag(256, 3, 1, n / 4) +
                    tag(257, 3, 1, 1) + tag(258, 3, 4, kAfter) + tag(259, 3, 1, 1) +
                    tag(262, 3, 1, 2) + tag(273, 4, 1, kAfter + 8) + tag(277, 3, 1, 4) +
                    tag(278, 3, 1, 1) + tag(279, 4, 1, n * n_bytes) + tag(338, 3, 1, extra) +
                    le(0, 4);
  for (int i = 0; i < 4; ++i) out += le(8 * n_bytes, 2);
  for (const std::uint32_t x : samples) out += le(x, static_cast<int>(n_bytes));
  return out;
}

TEST(PictureAlpha, TiffOfAssociatedAlphaIsDivided) {
  const std::vector<std::uint32_t> samples{64, 32, 128, 128, 10, 20, 30, 0, 255, 1, 0, 255};
  Remarks divided, straight;
  const ImageRgba8 image = decode_bytes(tiff(1, 1, samples), &divided);
  EXPECT_EQ(image.at(0, 0), (Rgba8{128, 64, 255, 128}));
  EXPECT_EQ(image.at(1, 0), (Rgba8{10, 20, 30, 0}));
  EXPECT_EQ(image.at(2, 0), (Rgba8{255, 1, 0, 255}));
  ASSERT_EQ(divided.size(), 1u);
  EXPECT_EQ(divided[0].what, "colours stored multiplied by alpha, divided by it");
  EXPECT_EQ(decode_bytes(tiff(2, 1, samples), &straight).at(0, 0), (Rgba8{64, 32, 128, 128}));
  EXPECT_EQ(decode_bytes(tiff(0, 1, samples), &straight).at(0, 0), (Rgba8{64, 32, 128, 128}));
  EXPECT_TRUE(straight.empty());
}

// TIFFs of gray whose 0 is white: gray is turned over, alpha is not, whatever the depth.
std::string min_white_tiff(std::uint32_t n_bytes, bool has_alpha,
                           const std::vector<std::uint32_t>& samples) {
  const std::uint32_t n_tags = has_alpha ? 10 : 9, n_channels = has_alpha ? 2 : 1;
  const std::uint32_t after = 8 + 2 + 12 * n_tags + 4;
  const auto tag = [](std::uint32_t id, std::uint32_t kind, std::uint32_t count,
                      std::uint32_t value) {
    return le(id, 2) + le(kind, 2) + le(count, 4) + le(value, 4);
  };
  const auto n = static_cast<std::uint32_t>(samples.size());
  const std::uint32_t bits = 8 * n_bytes;
  std::string out = "II" + le(42, 2) + le(8, 4) + le(n_tags, 2) + tag(256, 3, 1, n / n_channels) +
                    tag(257, 3, 1, 1) +
                    tag(258, 3, n_channels, has_alpha ? bits << 16 | bits : bits) +
                    tag(259, 3, 1, 1) + tag(262, 3, 1, 0) + tag(273, 4, 1, after) +
                    tag(277, 3, 1, n_channels) + tag(278, 3, 1, 1) + tag(279, 4, 1, n * n_bytes);
  if (has_alpha) out += tag(338, 3, 1, 2);
  out += le(0, 4);
  for (const std::uint32_t x : samples) out += le(x, static_cast<int>(n_bytes));
  return out;
}

TEST(PictureAlpha, WhereZeroIsWhite) {
  EXPECT_EQ(decode_bytes(min_white_tiff(1, false, {0, 55})).at(1, 0), (Rgba8{200, 200, 200, 255}));
  EXPECT_EQ(decode_bytes(min_white_tiff(2, false, {0, 55 * 257})).at(1, 0),
            (Rgba8{200, 200, 200, 255}));
  EXPECT_EQ(decode_bytes(min_white_tiff(1, true, {55, 30, 0, 255})).at(0, 0),
            (Rgba8{200, 200, 200, 30}));
  EXPECT_EQ(decode_bytes(min_white_tiff(2, true, {55 * 257, 30 * 257, 0, 65535})).at(0, 0),
            (Rgba8{200, 200, 200, 30}));
}

TEST(PictureAlpha, AlsoOf16Bits) {
  const TemporaryFolder folder;
  const auto file = folder / "a.tif";
  write_file(file, tiff(1, 2, {0x4000, 0x2000, 0, 0x8000}));
  const DeepImage deep = read_deep_image(file);
  EXPECT_FLOAT_EQ(deep.samples.at(0, 0)[0], 32767.5f);
  EXPECT_FLOAT_EQ(deep.samples.at(0, 0)[3], 32768.f);
  EXPECT_EQ(read_image_rgba8(file).at(0, 0), (Rgba8{128, 64, 0, 128}));
}

// A TGA of one pixel with a footer of version 2.
std::string targa(std::uint32_t kind_of_alpha) {
  const std::string pixel{'\x10', '\x20', '\x40', '\x80'};  // blue first
  const std::string header = le(0x020000, 3) + le(0, 9) + le(1, 2) + le(1, 2) + "\x20\x28";
  const std::string extension = le(495, 2) + std::string(492, '\0') + le(kind_of_alpha, 1);
  return header + pixel + extension + le(22, 4) + le(0, 4) + std::string("TRUEVISION-XFILE.\0", 18);
}

TEST(PictureAlpha, TargaThatSaysSoIsDivided) {
  EXPECT_EQ(decode_bytes(targa(3)).at(0, 0), (Rgba8{64, 32, 16, 128}));
  EXPECT_EQ(decode_bytes(targa(4)).at(0, 0), (Rgba8{128, 64, 32, 128}));
}

TEST(PictureAlpha, TargaThatHasNone) {
  EXPECT_EQ(decode_bytes(targa(0)).at(0, 0), (Rgba8{64, 32, 16, 255}));
  EXPECT_EQ(decode_bytes(targa(1)).at(0, 0), (Rgba8{64, 32, 16, 255}));
  EXPECT_EQ(decode_bytes(targa(2)).at(0, 0), (Rgba8{64, 32, 16, 128}));
}

// Palettes of two colours, whose entries are numbered from `first` on.
std::string targa_of_palette(std::uint32_t first, std::uint32_t bits) {
  const std::string map =
      le(0x80102030, static_cast<int>(bits / 8)) + le(0x40405060, static_cast<int>(bits / 8));
  return le(0x010100, 3) + le(first, 2) + le(2, 2) + le(bits, 1) + le(0, 4) + le(2, 2) + le(1, 2) +
         "\x08\x20" + map + le(first, 1) + le(first + 1, 1);
}

TEST(PictureAlpha, PalettesOfTargas) {
  EXPECT_INPUT_ERROR(decode_bytes(targa_of_palette(10, 24)), "palette that does not start at 0");
  Remarks remarks;
  decode_bytes(targa_of_palette(0, 32) + "more", &remarks);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].what, "alpha of a palette, left out");
}

// A BMP of one pixel, 16 or 32 bits, with masks.
std::string bmp_of_masks(std::uint32_t bits, const std::array<std::uint32_t, 4>& masks) {
  std::string out = "BM" + le(14 + 108 + bits / 8, 4) + le(0, 4) + le(14 + 108, 4) + le(108, 4) +
                    le(1, 4) + le(1, 4) + le(1, 2) + le(bits, 2) + le(3, 4) + le(4, 4) + le(0, 16);
  for (const std::uint32_t mask : masks) out += le(mask, 4);
  return out + std::string(108 - 56, '\0') + le(0x80402010, 4);
}

TEST(PictureAlpha, BmpWithoutAMaskForItIsOpaque) {
  EXPECT_EQ(decode_bytes(bmp_of_masks(32, {0xff0000, 0xff00, 0xff, 0})).at(0, 0),
            (Rgba8{64, 32, 16, 255}));
  EXPECT_EQ(decode_bytes(bmp_of_masks(32, {0xff0000, 0xff00, 0xff, 0xff000000})).at(0, 0),
            (Rgba8{64, 32, 16, 128}));
  Remarks remarks;
  decode_bytes(bmp_of_masks(16, {0x7c00, 0x3e0, 0x1f, 0x8000}), &remarks);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].what, "alpha of one bit, left out");
}

void write_exr(const std::filesystem::path& file, const OIIO::ImageSpec& spec) {
  const auto output = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(output->open(file.string(), spec));
  const std::vector<float> samples(64, 0.5f);
  ASSERT_TRUE(output->write_image(OIIO::TypeFloat, samples.data()));
  output->close();
}

TEST(Exr, WindowsAreSaidAndOtherChannelsRefused) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(2, 1, 3, OIIO::TypeHalf);
  spec.x = 5, spec.y = 7, spec.full_width = 20, spec.full_height = 10;
  write_exr(folder / "window.exr", spec);
  Remarks remarks;
  EXPECT_EQ(read_image_rgba8(folder / "window.exr", {{}, &remarks}).width_px, 2);
  ASSERT_EQ(remarks.size(), 2u);  // and that samples are linear
  EXPECT_EQ(remarks[0].what,
            "the data window is taken alone: at 5, 7 of a display window of 20 x 10");
  for (const std::vector<std::string>& names :
       {std::vector<std::string>{"Y", "RY", "BY"}, {"X", "Y", "Z"}}) {
    OIIO::ImageSpec other(2, 1, 3, OIIO::TypeHalf);
    other.channelnames = names;
    write_exr(folder / "other.exr", other);
    EXPECT_INPUT_ERROR(read_image_rgba8(folder / "other.exr"), "CIE XYZ");
  }
  write_exr(folder / "whole.exr", OIIO::ImageSpec(2, 1, 3, OIIO::TypeUInt));
  EXPECT_INPUT_ERROR(read_image_rgba8(folder / "whole.exr"), "whole numbers");
}

TEST(PictureAlpha, ExrIsDividedBeforeItIsEncoded) {
  const TemporaryFolder folder;
  const auto file = folder / "a.exr";
  const auto output = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(output->open(file.string(), OIIO::ImageSpec(1, 1, 4, OIIO::TypeFloat)));
  const float samples[] = {0.5f, 0.25f, 0, 0.5f};
  ASSERT_TRUE(output->write_image(OIIO::TypeFloat, samples));
  output->close();
  EXPECT_EQ(read_image_rgba8(file).at(0, 0), (Rgba8{255, 188, 0, 128}));
  EXPECT_EQ(read_deep_image(file).samples.at(0, 0)[1], 0.25f);
}

// --- Netpbm ---

TEST(Netpbm, EveryCodeOf16BitsIsKept) {
  const TemporaryFolder folder;
  std::string bytes = "P5 65536 1 65535\n";
  for (std::uint32_t x = 0; x < 65536; ++x)
    bytes += {static_cast<char>(x >> 8), static_cast<char>(x & 255)};
  write_file(folder / "a.pgm", bytes);
  const DeepImage image = read_deep_image(folder / "a.pgm");
  ASSERT_EQ(image.kind, SampleKind::code16);
  for (int x = 0; x < 65536; ++x) ASSERT_EQ(image.samples.at(x, 0)[1], static_cast<float>(x));
}

TEST(Netpbm, OtherMaximaAreRoundedToTheNearest) {
  std::string hundred = "P5 101 1 100\n", text = "P2\n101 1\n# of a hundred\n100\n";
  for (int x = 0; x <= 100; ++x) {
    hundred += static_cast<char>(x);
    text += std::to_string(x) + (x == 50 ? " # half\n" : " ");
  }
  for (const std::string& bytes : {hundred, text}) {
    const ImageRgba8 image = decode_bytes(bytes);
    for (int x = 0; x <= 100; ++x) EXPECT_EQ(image.at(x, 0)[0], (x * 255 + 50) / 100) << x;
  }
}

TEST(Netpbm, BitsByRow) {
  EXPECT_EQ(decode_bytes("P1\n3 2\n1 0 1\n011").at(2, 0), (Rgba8{0, 0, 0, 255}));
  EXPECT_EQ(decode_bytes("P1\n3 2\n1 0 1\n011").at(0, 1), (Rgba8{255, 255, 255, 255}));
  const ImageRgba8 packed = decode_bytes("P4\n3 2\n\xa0\x60");
  const ImageRgba8 text = decode_bytes("P1\n3 2\n101011");
  EXPECT_EQ(packed.pixels, text.pixels);
}

TEST(Netpbm, WhatIsNoSampleIsRefused) {
  EXPECT_INPUT_ERROR(decode_bytes("P2 2 1 9\n3 10\n"), "above the maximum");
  EXPECT_INPUT_ERROR(decode_bytes("P5 2 1 9\n\x03\x0a"), "above the maximum");
  EXPECT_INPUT_ERROR(decode_bytes("P2 2 1 9\n3 x\n"), "not a number");
  EXPECT_INPUT_ERROR(decode_bytes("P2 2 2 9\n3   4     \n"), "fewer samples");
  EXPECT_INPUT_ERROR(decode_bytes("P2 2 1 0\n0 0\n"), "1 to 65535");
  EXPECT_INPUT_ERROR(decode_bytes("P2 2 1 65536\n0 0\n"), "1 to 65535");
}

}  // namespace
}  // namespace viewcell

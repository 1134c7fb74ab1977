#include "image/io.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <thread>

#include "base/error.h"
#include "base/file.h"
#include "base/srgb.h"
#include "common/same_every_time.h"
#include "common/temporary_folder.h"
#include "image/header.h"
#include "image/random_image.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

// Writes samples with OpenImageIO, whatever the format.
template <typename Sample>
void write_samples(const fs::path& file, int width, int height, int n_channels, OIIO::TypeDesc type,
                   const std::vector<Sample>& samples, const std::vector<std::string>& names = {}) {
  OIIO::ImageSpec spec(width, height, n_channels, type);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("CompressionQuality", 100);
  if (!names.empty()) spec.channelnames = names;
  const auto output = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(output && output->open(file.string(), spec)) << file;
  const auto base = OIIO::TypeDesc(OIIO::BaseTypeFromC<Sample>::value);
  ASSERT_TRUE(output->write_image(base, samples.data())) << output->geterror();
  ASSERT_TRUE(output->close());
}

long peak_memory_kib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

// The error's text; empty when the file reads.
std::string error_of_picture(const fs::path& file) {
  try {
    read_image_rgba8(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void patch_box(std::string& exr, const std::string& name, int x0, int y0, int x1, int y1) {
  const std::size_t at = exr.find(name + '\0' + "box2i" + '\0');
  ASSERT_NE(at, std::string::npos);
  const std::int32_t box[4] = {x0, y0, x1, y1};
  exr.replace(at + name.size() + 1 + 6 + 4, 16, reinterpret_cast<const char*>(box), 16);
}

// The sum of the header chunk, after a change of the header.
void patch_png_sum(std::string& png) {
  const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(png.data() + 12), 17);
  for (std::size_t i = 0; i < 4; ++i) png[29 + i] = static_cast<char>(sum >> (24 - 8 * i));
}

TEST(PngWrite, RoundTripKeepsEveryPixelColourUnderZeroAlphaToo) {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const int width = 1 + static_cast<int>(random.below(40));
    ImageRgba8 image = random_image(width, 1 + static_cast<int>(random.below(40)), random);
    image.pixels[0] = {10, 200, 30, 0};
    write_png(folder / "a.png", image);
    const ImageRgba8 back = read_image_rgba8(folder / "a.png");
    EXPECT_EQ(back.width_px, image.width_px);
    EXPECT_EQ(back.height_px, image.height_px);
    EXPECT_EQ(back.pixels, image.pixels);
  }
}

TEST(PngWrite, SameBytesEveryTimeAndNoDateOrSoftware) {
  const TemporaryFolder folder;
  Random random(7);
  const ImageRgba8 image = random_image(33, 20, random);
  const std::string bytes = same_every_time([&](std::size_t i) {
    write_png(folder / (std::to_string(i) + ".png"), image);
    return read_file(folder / (std::to_string(i) + ".png"));
  });
  EXPECT_GT(bytes.size(), 33u * 20 * 3);  // noise
  for (const char* chunk : {"tIME", "tEXt", "iTXt", "zTXt", "eXIf"})
    EXPECT_EQ(bytes.find(chunk), std::string::npos) << chunk;
}

TEST(PngWrite, DroppedAlphaReadsAsOpaque) {
  const TemporaryFolder folder;
  write_png(folder / "a.png", ImageRgba8(3, 2, {9, 8, 7, 0}), PngAlpha::drop);
  for (const Rgba8& p : read_image_rgba8(folder / "a.png").pixels)
    EXPECT_EQ(p, (Rgba8{9, 8, 7, 255}));
}

TEST(PngWrite, IntoNoFolderIsTheMachinesFaultAndLeavesNothing) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_png(folder / "none/a.png", ImageRgba8(2, 2)), MachineError);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ImageRead, GrayAndAlphaAreExpanded) {
  const TemporaryFolder folder;
  const std::vector<std::uint8_t> gray = {0, 90, 255, 17};
  write_samples(folder / "g.png", 2, 2, 1, OIIO::TypeUInt8, gray);
  EXPECT_EQ(read_image_rgba8(folder / "g.png").pixels[1], (Rgba8{90, 90, 90, 255}));
  write_samples(folder / "g.tif", 2, 2, 1, OIIO::TypeUInt8, gray);
  EXPECT_EQ(read_image_rgba8(folder / "g.tif").pixels[3], (Rgba8{17, 17, 17, 255}));
  write_samples(folder / "ga.png", 1, 2, 2, OIIO::TypeUInt8, gray);
  EXPECT_EQ(read_image_rgba8(folder / "ga.png").pixels[0], (Rgba8{0, 0, 0, 90}));
  EXPECT_EQ(read_image_rgba8(folder / "ga.png").pixels[1], (Rgba8{255, 255, 255, 17}));
}

TEST(ImageRead, SixteenBitsAreRoundedToEight) {
  const TemporaryFolder folder;
  const std::vector<std::uint16_t> deep = {0, 65535, 128 * 257, 200 * 257 + 100};
  write_samples(folder / "d.png", 1, 1, 4, OIIO::TypeUInt16, deep);
  EXPECT_EQ(read_image_rgba8(folder / "d.png").pixels[0], (Rgba8{0, 255, 128, 200}));
}

TEST(ImageRead, FloatsAreLinearAndBecomeSrgb) {
  const TemporaryFolder folder;
  write_samples(folder / "f.tif", 1, 1, 4, OIIO::TypeFloat, std::vector{0.f, 0.5f, 2.f, 0.5f});
  EXPECT_EQ(read_image_rgba8(folder / "f.tif").pixels[0], (Rgba8{0, 188, 255, 128}));
  write_samples(folder / "f.exr", 1, 1, 4, OIIO::TypeFloat, std::vector{0.f, 0.25f, 1.f, 0.5f});
  EXPECT_EQ(read_image_rgba8(folder / "f.exr").pixels[0], (Rgba8{0, 188, 255, 128}));
  EXPECT_EQ(srgb8_from_linear(-1.f), 0);
  EXPECT_EQ(srgb8_from_linear(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(srgb8_from_linear(0.0031308f), 10);
  EXPECT_EQ(srgb8_from_linear(0.21586f), 128);
}

TEST(ImageRead, ExrChannelsGoByName) {
  const TemporaryFolder folder;
  const std::vector<float> samples = {1.f, 0.f, 0.5f};
  write_samples(folder / "y.exr", 1, 1, 1, OIIO::TypeHalf, std::vector<float>{0.5f}, {"Y"});
  EXPECT_EQ(read_image_rgba8(folder / "y.exr").pixels[0], (Rgba8{188, 188, 188, 255}));
  write_samples(folder / "q.exr", 1, 1, 3, OIIO::TypeHalf, samples, {"P", "Q", "S"});
  EXPECT_NE(error_of_picture(folder / "q.exr").find("no channels R, G, B nor Y"),
            std::string::npos);
}

TEST(ImageRead, JpegAndWebpAreWithinTheirLoss) {
  const TemporaryFolder folder;
  std::vector<std::uint8_t> samples;
  for (int i = 0; i < 32 * 32; ++i) samples.insert(samples.end(), {200, 100, 50});
  for (const char* name : {"a.jpg", "a.webp"}) {
    write_samples(folder / name, 32, 32, 3, OIIO::TypeUInt8, samples);
    const ImageRgba8 image = read_image_rgba8(folder / name);
    ASSERT_EQ(image.width_px, 32) << name;
    const int expected[3] = {200, 100, 50};
    for (const Rgba8& p : image.pixels) {
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(p[c], expected[c], 4) << name;
      EXPECT_EQ(p[3], 255);
    }
  }
}

TEST(ImageRead, TheNameDoesNotMatterTheBytesDo) {
  const TemporaryFolder folder;
  const ImageRgba8 image(5, 4, {1, 2, 3, 4});
  write_png(folder / "a.jpg", image);
  EXPECT_EQ(read_image_rgba8(folder / "a.jpg").pixels, image.pixels);
  write_file(folder / "b.png", "DDS and so on, which is not read");
  EXPECT_NE(error_of_picture(folder / "b.png").find("is not a PNG"), std::string::npos);
  write_file(folder / "c.png", "");
  EXPECT_NE(error_of_picture(folder / "c.png").find("is not a PNG"), std::string::npos);
  EXPECT_NE(error_of_picture(folder / "missing.png").find("missing.png"), std::string::npos);
}

// A header may promise what no machine holds: it is refused before anything is allocated.
TEST(ImageRead, AbsurdSizesAreRefusedQuicklyAndCheaply) {
  const TemporaryFolder folder;
  write_samples(folder / "a.png", 2, 2, 3, OIIO::TypeUInt8, std::vector<std::uint8_t>(12));
  std::string png = read_file(folder / "a.png");
  png.replace(16, 8, std::string("\0\0\xea\x60\0\0\xea\x60", 8));
  patch_png_sum(png);
  write_samples(folder / "a.exr", 2, 2, 3, OIIO::TypeHalf, std::vector<float>(12));
  std::string exr = read_file(folder / "a.exr");
  patch_box(exr, "dataWindow", 0, 0, 59999, 59999);
  patch_box(exr, "displayWindow", 0, 0, 59999, 59999);
  exr.resize(exr.size() + (1 << 16));  // room for the table of rows
  write_samples(folder / "a.jpg", 2, 2, 3, OIIO::TypeUInt8, std::vector<std::uint8_t>(12));
  std::string jpeg = read_file(folder / "a.jpg");
  const std::size_t frame = jpeg.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  jpeg.replace(frame + 5, 4, "\xea\x60\xea\x60");
  std::string webp("RIFF\x20\0\0\0WEBPVP8X\x0a\0\0\0\0\0\0\0\x5f\xea\0\x5f\xea\0", 30);
  webp.resize(64);

  const long before_kib = peak_memory_kib();
  for (const std::string& bytes : {png, exr, jpeg, webp}) {
    write_file(folder / "x.png", bytes);
    const std::string error = error_of_picture(folder / "x.png");
    EXPECT_NE(error.find("60000 x 60000 pixels"), std::string::npos) << error;
    EXPECT_NE(error.find("x.png"), std::string::npos);
  }
  EXPECT_LT(peak_memory_kib() - before_kib, 64 * 1024);
}

TEST(ImageRead, LimitsAreWhatTheHeaderSays) {
  EXPECT_NO_THROW(check_image_size(16384, 16384, "f"));
  EXPECT_NO_THROW(check_image_size(1, 1, "f"));
  EXPECT_NO_THROW(check_image_size(1 << 17, 1 << 11, "f"));  // a strip
  EXPECT_THROW(check_image_size(16385, 16384, "f"), InputError);
  EXPECT_THROW(check_image_size(101, 1, "f", {100}), InputError);
  EXPECT_THROW(check_image_size(0, 1, "f"), InputError);
  EXPECT_THROW(check_image_size(1, -3, "f"), InputError);
}

// Pictures of 37 x 29 in every format.
constexpr const char* kNames[] = {"a.png", "a.jpg", "a.tif", "a.webp", "a.exr",
                                  "a.gif", "a.bmp", "a.tga", "a.ppm",  "a.hdr"};

std::vector<std::uint8_t> random_rgb(Random& random) {
  std::vector<std::uint8_t> rgb;
  for (const Rgba8& p : random_image(37, 29, random).pixels)
    rgb.insert(rgb.end(), p.begin(), p.begin() + 3);
  return rgb;
}

// Returns the file's bytes.
std::string write_rgb(const fs::path& file, const std::vector<std::uint8_t>& rgb) {
  const auto ending = file.extension();
  write_samples(file, 37, 29, 3,
                ending == ".exr"   ? OIIO::TypeHalf
                : ending == ".hdr" ? OIIO::TypeFloat
                                   : OIIO::TypeUInt8,
                rgb);
  return read_file(file);
}

// Cut anywhere, a picture is refused, or (cut in what follows its pixels) reads as before.
TEST(ImageRead, TruncatedFilesNeverReadAsSomethingElse) {
  const TemporaryFolder folder;
  Random random(11);
  const std::vector<std::uint8_t> rgb = random_rgb(random);
  for (const char* name : kNames) {
    const std::string bytes = write_rgb(folder / name, rgb);
    const ImageRgba8 whole = read_image_rgba8(folder / name);
    int n_refused = 0;
    for (int i = 0; i < 50; ++i) {
      const std::size_t length = random.below(static_cast<std::uint32_t>(bytes.size()));
      put_bytes(folder / "cut", bytes.substr(0, length));
      try {
        EXPECT_EQ(read_image_rgba8(folder / "cut").pixels, whole.pixels) << name << " " << length;
      } catch (const InputError& error) {
        ++n_refused;
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      }
    }
    EXPECT_GE(n_refused, 45) << name;
  }
}

// Flipped bytes: any outcome but a crash, a hang or an error of another kind.
TEST(ImageRead, CorruptFilesReadOrAreRefused) {
  const TemporaryFolder folder;
  Random random(12);
  const std::vector<std::uint8_t> rgb = random_rgb(random);
  for (const char* name : kNames) {
    const std::string bytes = write_rgb(folder / name, rgb);
    for (int i = 0; i < 100; ++i) {
      SCOPED_TRACE(std::string(name) + " case " + std::to_string(i));
      std::string bad = bytes;
      for (int k = 0; k < 4; ++k) {
        // Half of the blows fall on the header.
        const auto reach = k % 2 ? bad.size() : std::min<std::size_t>(bad.size(), 400);
        bad[random.below(static_cast<std::uint32_t>(reach))] = static_cast<char>(random.below(256));
      }
      put_bytes(folder / "bad", bad);
      error_of_picture(folder / "bad");
    }
  }
}

TEST(ImageRead, ManyThreadsAtOnce) {
  const TemporaryFolder folder;
  std::vector<std::thread> threads;
  std::vector<int> n_equal(8, 0);
  for (std::size_t t = 0; t < n_equal.size(); ++t)
    threads.emplace_back([&, t] {
      Random random(t);
      for (int i = 0; i < 10; ++i) {
        const ImageRgba8 image = random_image(50, 40, random);
        const fs::path file = folder / (std::to_string(t) + ".png");
        write_png(file, image);
        n_equal[t] += read_image_rgba8(file).pixels == image.pixels;
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const int n : n_equal) EXPECT_EQ(n, 10);
}

}  // namespace
}  // namespace viewcell

#include "image/index_map.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "base/file.h"
#include "base/random.h"
#include "common/same_every_time.h"
#include "common/temporary_folder.h"
#include "image/io.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

IndexMap random_map(int width_px, int height_px, Random& random) {
  IndexMap map(width_px, height_px);
  for (glm::vec2& uv : map.pixels) uv = {random.uniform(), random.uniform()};
  return map;
}

bool same_bits(const IndexMap& a, const IndexMap& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec2)) == 0;
}

// A picture of any kind, by OpenImageIO.
template <typename Sample>
void write_map_samples(const fs::path& file, int n_channels, OIIO::TypeDesc type,
                       const std::vector<Sample>& samples,
                       const std::vector<std::string>& names = {"texcoord.u", "texcoord.v"}) {
  const int n = static_cast<int>(samples.size()) / n_channels;
  OIIO::ImageSpec spec(n, 1, n_channels, type);
  if (names.size() == static_cast<std::size_t>(n_channels)) spec.channelnames = names;
  spec.alpha_channel = -1;
  const auto output = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(output && output->open(file.string(), spec)) << file;
  ASSERT_TRUE(
      output->write_image(OIIO::TypeDesc(OIIO::BaseTypeFromC<Sample>::value), samples.data()));
  ASSERT_TRUE(output->close());
}

// The error's text; empty when the file reads.
std::string error_of_map(const fs::path& file) {
  try {
    read_index_map(file);
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "";
}

TEST(IndexMapFile, ExrKeepsEveryBit) {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const int width = 1 + static_cast<int>(random.below(60));
    IndexMap map = random_map(width, 1 + static_cast<int>(random.below(40)), random);
    map.pixels[0] = {-0.f, std::numeric_limits<float>::denorm_min()};
    map.pixels.back() = {-3.25f, 1e30f};
    write_index_map(folder / "a.exr", map);
    std::string hash;
    EXPECT_TRUE(same_bits(read_index_map(folder / "a.exr", &hash), map));
    EXPECT_EQ(hash, hash_file(folder / "a.exr"));
  }
}

// u and v are told apart, and rows from columns.
TEST(IndexMapFile, TiffRoundsToSixteenBits) {
  const TemporaryFolder folder;
  Random random(3);
  const IndexMap map = random_map(17, 5, random);
  write_index_map(folder / "a.tif", map);
  const IndexMap back = read_index_map(folder / "a.tif");
  ASSERT_EQ(back.width_px, 17);
  ASSERT_EQ(back.height_px, 5);
  for (std::size_t p = 0; p < map.pixels.size(); ++p)
    for (int k = 0; k < 2; ++k)
      EXPECT_LE(std::abs(double(back.pixels[p][k]) - map.pixels[p][k]), 0.5 / 65535 + 1e-7);
  write_index_map(folder / "b.TIFF", back);
  EXPECT_EQ(read_file(folder / "a.tif"), read_file(folder / "b.TIFF"));
}

TEST(IndexMapFile, TiffClampsAndRoundsToTheNearest) {
  const TemporaryFolder folder;
  IndexMap map(3, 1);
  map.pixels = {{-2, 7}, {0.6f / 65535, 0.4f / 65535}, {1, 0}};
  write_index_map(folder / "a.tif", map);
  const IndexMap back = read_index_map(folder / "a.tif");
  EXPECT_EQ(back.pixels[0], glm::vec2(0, 1));
  EXPECT_EQ(back.pixels[1], glm::vec2(1.f / 65535, 0));
  EXPECT_EQ(back.pixels[2], glm::vec2(1, 0));
}

TEST(IndexMapFile, EightBitsAreReadToo) {
  const TemporaryFolder folder;
  write_map_samples<std::uint8_t>(folder / "a.tif", 2, OIIO::TypeUInt8, {0, 255, 51, 128});
  const IndexMap map = read_index_map(folder / "a.tif");
  EXPECT_EQ(map.pixels[0], glm::vec2(0, 1));
  EXPECT_EQ(map.pixels[1], glm::vec2(0.2f, static_cast<float>(128 / 255.0)));
}

TEST(IndexMapFile, SameBytesEveryTimeAndNoDate) {
  const TemporaryFolder folder;
  Random random(5);
  const IndexMap map = random_map(40, 30, random);
  for (const std::string ending : {".exr", ".tif"}) {
    const std::string bytes = same_every_time([&](std::size_t i) {
      write_index_map(folder / (std::to_string(i) + ending), map);
      return read_file(folder / (std::to_string(i) + ending));
    });
    EXPECT_EQ(bytes.find("capDate"), std::string::npos);
    EXPECT_EQ(bytes.find(":20"), std::string::npos);  // "2031:12:24 20:15:00"
    EXPECT_NE(bytes.find("viewcell "), std::string::npos);
    EXPECT_EQ(bytes.find(folder.path().string()), std::string::npos);
  }
}

TEST(IndexMapFile, OtherPicturesAreRefused) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& name, const std::string& part) {
    const std::string error = error_of_map(folder / name);
    EXPECT_NE(error.find(part), std::string::npos) << error;
    EXPECT_NE(error.find(name), std::string::npos) << error;
  };
  write_png(folder / "a.png", ImageRgba8(2, 2));
  refused("a.png", "is not a TIFF or EXR picture");
  write_file(folder / "text.tif", "no picture");
  refused("text.tif", "is not a PNG");
  refused("missing.exr", "cannot open");
  const std::vector<float> six(6, 0.5f), four(4, 0.5f);
  write_map_samples(folder / "rgb.tif", 3, OIIO::TypeUInt16, six);
  refused("rgb.tif", "has channels R, G, B of uint16, not two");
  write_map_samples(folder / "gray.tif", 1, OIIO::TypeUInt16, six);
  refused("gray.tif", "not two");
  write_map_samples(folder / "float.tif", 2, OIIO::TypeFloat, six);
  refused("float.tif", "of float, not two");
  write_map_samples(folder / "half.exr", 2, OIIO::TypeHalf, six);
  refused("half.exr", "of half, not two");
  write_map_samples(folder / "rg.exr", 2, OIIO::TypeFloat, four, {"R", "G"});
  refused("rg.exr", "has channels R, G of float");
  write_map_samples(folder / "uvw.exr", 3, OIIO::TypeFloat, six,
                    {"texcoord.u", "texcoord.v", "texcoord.w"});
  refused("uvw.exr", "not two");
}

TEST(IndexMapFile, NumbersThatAreNotFiniteAreNamed) {
  const TemporaryFolder folder;
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    write_map_samples<float>(folder / "a.exr", 2, OIIO::TypeFloat, {0, 0, 0, bad, 0, 0});
    EXPECT_NE(error_of_map(folder / "a.exr").find("texel 1, 0: holds a number that is not"),
              std::string::npos);
    write_map_samples<float>(folder / "a.exr", 2, OIIO::TypeFloat, {0, 0, 0, 0, bad, 0});
    EXPECT_NE(error_of_map(folder / "a.exr").find("texel 2, 0: holds a number that is not"),
              std::string::npos);
    for (const int k : {0, 1}) {
      IndexMap map(2, 2);
      map.at(1, 1)[k] = bad;
      EXPECT_THROW(write_index_map(folder / "b.exr", map), BugError);
    }
  }
  // What lies between two of these is no number.
  write_map_samples<float>(folder / "a.exr", 2, OIIO::TypeFloat, {0, 0, 0, 3e38f, 0, -3e38f});
  EXPECT_NE(error_of_map(folder / "a.exr").find("texel 1, 0: holds a number that is not"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "b.exr"));
}

TEST(IndexMapFile, OtherEndingsAndFoldersThatAreNotThere) {
  const TemporaryFolder folder;
  const IndexMap map(2, 2);
  EXPECT_THROW(write_index_map(folder / "a.png", map), UsageError);
  EXPECT_THROW(write_index_map(folder / "a", map), UsageError);
  EXPECT_THROW(write_index_map(folder / "none/a.tif", map), MachineError);
  EXPECT_THROW(write_index_map(folder / "a.tif", IndexMap()), BugError);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

// A header that promises a gigabyte, in a file of some hundred bytes.
TEST(IndexMapFile, PromisesThatTheFileCannotHoldAreRefused) {
  const TemporaryFolder folder;
  write_index_map(folder / "a.tif", IndexMap(9, 9));
  std::string tiff = read_file(folder / "a.tif");
  int n_changed = 0;  // tags 256 and 257: a side, SHORT
  for (std::size_t at = 10; at + 12 <= tiff.size() && n_changed < 2; at += 12, ++n_changed)
    tiff.replace(at + 8, 2, std::string("\x00\x40", 2));
  put_bytes(folder / "a.tif", tiff);
  EXPECT_NE(error_of_map(folder / "a.tif").find("bytes of pixels in a file of"), std::string::npos)
      << error_of_map(folder / "a.tif");
}

// A byte of deflate stands for at most 1032: a header that promises a little more is refused for
// it, one that promises less is read, and found to be cut.
TEST(IndexMapFile, PromisesAreHeldAgainstTheFile) {
  const TemporaryFolder folder;
  constexpr int kWidth = 40;
  write_index_map(folder / "a.tif", IndexMap(kWidth, 9));
  const std::string tiff = read_file(folder / "a.tif");
  for (const double share : {0.99, 1.01}) {
    std::string bytes = tiff;
    const auto height = static_cast<std::uint16_t>(share * 1032 * double(tiff.size()) / 4 / kWidth);
    std::memcpy(bytes.data() + 10 + 12 + 8, &height, 2);  // the second tag, 257
    put_bytes(folder / "a.tif", bytes);
    const std::string error = error_of_map(folder / "a.tif");
    EXPECT_EQ(error.find("bytes of pixels in a file of") != std::string::npos, share > 1) << error;
  }
}

// Channels may each have a type of their own in an EXR.
TEST(IndexMapFile, ChannelsOfTwoTypesAreRefused) {
  const TemporaryFolder folder;
  OIIO::ImageSpec spec(2, 1, 2, OIIO::TypeFloat);
  spec.channelnames = {"texcoord.u", "texcoord.v"};
  spec.channelformats.push_back(OIIO::TypeFloat);
  spec.channelformats.push_back(OIIO::TypeHalf);
  const std::string file = folder / "a.exr";
  const auto output = OIIO::ImageOutput::create(file);
  ASSERT_TRUE(output && output->open(file, spec));
  const std::vector<float> samples{0, 0.25f, 0.5f, 1};
  ASSERT_TRUE(output->write_image(OIIO::TypeFloat, samples.data()) && output->close());
  EXPECT_NE(error_of_map(file).find("not two of an indexing map"), std::string::npos);
}

// Cut anywhere a map is refused, or reads as before (cut in what follows its pixels). Damaged, it
// reads or is refused.
TEST(IndexMapFile, CutAndDamagedFilesAreRefused) {
  const TemporaryFolder folder;
  Random random(21);
  const IndexMap map = random_map(37, 29, random);
  for (const char* name : {"a.exr", "a.tif"}) {
    write_index_map(folder / name, map);
    const std::string bytes = read_file(folder / name);
    const IndexMap whole = read_index_map(folder / name);
    int n_refused = 0;
    for (int i = 0; i < 50; ++i) {
      put_bytes(folder / "cut",
                bytes.substr(0, random.below(static_cast<std::uint32_t>(bytes.size()))));
      try {
        EXPECT_TRUE(same_bits(read_index_map(folder / "cut"), whole));
      } catch (const InputError&) {
        ++n_refused;
      }
    }
    EXPECT_GE(n_refused, 45) << name;
    for (int i = 0; i < 150; ++i) {
      std::string bad = bytes;
      for (int k = 0; k < 3; ++k) {
        const auto reach = k % 2 ? bad.size() : std::min<std::size_t>(bad.size(), 400);
        bad[random.below(static_cast<std::uint32_t>(reach))] = static_cast<char>(random.below(256));
      }
      put_bytes(folder / "bad", bad);
      error_of_map(folder / "bad");
    }
  }
}

}  // namespace
}  // namespace viewcell

#include "image/capture_file.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "base/file.h"
#include "base/random.h"
#include "common/mutate.h"
#include "common/same_every_time.h"
#include "common/temporary_folder.h"
#include "image/half.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

CapturePart random_part(const std::string& name, int x, int y, int width, int height,
                        Random& random) {
  CapturePart part{
      {name, 1024, 900, x, y, width, height, glm::dmat4(1), glm::dmat4(1), ""}, {}, {}};
  const auto n = static_cast<std::size_t>(width * height);
  for (std::size_t p = 0; p < n; ++p) {
    const float mask = random.below(2) ? 1.f : 0.f;
    for (int c = 0; c < 3; ++c)
      part.rgba_half.push_back(half_from_float(static_cast<float>(random.uniform())));
    part.rgba_half.push_back(half_from_float(mask));
    part.z.push_back(static_cast<float>(random.uniform(1, 2000)));
  }
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) {
      part.header.world_to_camera[column][row] = random.uniform(-2000, 2000);
      part.header.world_to_ndc[column][row] = random.uniform(-2, 2);
    }
  return part;
}

std::vector<CapturePart> random_parts(std::uint64_t seed) {
  Random random(seed);
  std::vector<CapturePart> parts;
  const int n = 1 + static_cast<int>(random.below(5));
  for (int i = 0; i < n; ++i)
    parts.push_back(random_part(
        "object " + std::to_string(i), static_cast<int>(random.below(3000)) - 1500,
        static_cast<int>(random.below(3000)) - 1500, 1 + static_cast<int>(random.below(50)),
        1 + static_cast<int>(random.below(50)), random));
  parts[0].header.note = R"({"focal_px": 886.8100134752651, "eye": [1, 2, 3]})";
  return parts;
}

void expect_same_header(const CapturePartHeader& a, const CapturePartHeader& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.source_width_px, b.source_width_px);
  EXPECT_EQ(a.source_height_px, b.source_height_px);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.width_px, b.width_px);
  EXPECT_EQ(a.height_px, b.height_px);
  EXPECT_EQ(a.note, b.note);
  EXPECT_EQ(glm::mat4(a.world_to_camera), glm::mat4(b.world_to_camera));
  EXPECT_EQ(glm::mat4(a.world_to_ndc), glm::mat4(b.world_to_ndc));
}

// The error's text; empty when all of the file reads.
std::string error_of_capture(const fs::path& path) {
  try {
    CaptureFile file(path);
    for (std::size_t i = 0; i < file.parts().size(); ++i) file.read_part(i);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// A 2 x 1 EXR that our writer would not write: its channels, and the same float in all of them.
void write_foreign_exr(const fs::path& file, const std::vector<std::string>& channels, float value,
                       bool all_float = false) {
  const auto n = static_cast<int>(channels.size());
  OIIO::ImageSpec spec(2, 1, n, OIIO::TypeHalf);
  spec.channelnames = channels;
  for (const std::string& channel : channels)
    spec.channelformats.push_back(channel == "Z" || all_float ? OIIO::TypeFloat : OIIO::TypeHalf);
  const glm::mat4 one(1);
  spec.attribute("worldToCamera", OIIO::TypeMatrix, &one);
  spec.attribute("worldToNDC", OIIO::TypeMatrix, &one);
  spec.attribute("name", "object 0");
  const std::vector<float> samples(channels.size() * 2, value);
  const auto output = OIIO::ImageOutput::create("openexr");
  ASSERT_TRUE(output->open(file.string(), spec)) << output->geterror();
  ASSERT_TRUE(output->write_image(OIIO::TypeFloat, samples.data()) && output->close());
}

const CaptureAttributes kAttributes = {{"viewcell", R"({"tool": "depthcap", "version": "0.1.0"})"},
                                       {"sceneHash", "0123456789abcdef"},
                                       {"centre", "217"}};

TEST(CaptureFileTest, RoundTripIsExactWithWindowsBeyondTheSourceImage) {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<CapturePart> parts = random_parts(seed);
    write_capture_file(folder / "c.exr", parts, kAttributes);
    CaptureFile file(folder / "c.exr");
    EXPECT_EQ(file.attributes(), kAttributes);
    ASSERT_EQ(file.parts().size(), parts.size());
    for (std::size_t i = parts.size(); i-- > 0;) {  // in another order than written
      expect_same_header(file.parts()[i], parts[i].header);
      const CapturePart part = file.read_part(i);
      expect_same_header(part.header, parts[i].header);
      EXPECT_EQ(part.rgba_half, parts[i].rgba_half);
      EXPECT_EQ(part.z, parts[i].z);
    }
  }
}

TEST(CaptureFileTest, SameBytesEveryTimeAndNoDateOrSoftware) {
  const TemporaryFolder folder;
  const std::string bytes = same_every_time([&](std::size_t i) {
    const auto file = folder / (std::to_string(i) + ".exr");
    write_capture_file(file, random_parts(3), kAttributes);
    return read_file(file);
  });
  EXPECT_GT(bytes.size(), 1000u);
  for (const char* name : {"capDate", "DateTime", "oftware", "ownerName", "OpenImageIO"})
    EXPECT_EQ(bytes.find(name), std::string::npos) << name;
}

// EXR's own readers multiply row vectors: a translation is in the last row there, the last column
// here, and in both the last four of the 16 numbers but one.
TEST(CaptureFileTest, MatrixLiesInTheFileAsExrHasIt) {
  const TemporaryFolder folder;
  Random random(5);
  CapturePart part = random_part("object 0", 0, 0, 4, 4, random);
  part.header.world_to_camera = glm::dmat4(1);
  part.header.world_to_camera[3] = glm::dvec4(7, 8, 9, 1);
  write_capture_file(folder / "m.exr", {part}, {});
  const std::string bytes = read_file(folder / "m.exr");
  const std::string head = std::string("worldToCamera") + '\0' + "m44f" + '\0';
  const std::size_t at = bytes.find(head);
  ASSERT_NE(at, std::string::npos);
  float m[4][4];
  std::memcpy(m, bytes.data() + at + head.size() + 4, sizeof m);
  EXPECT_EQ(m[3][0], 7);
  EXPECT_EQ(m[3][1], 8);
  EXPECT_EQ(m[3][2], 9);
  EXPECT_EQ(m[0][3], 0);
}

TEST(CaptureFileTest, NoPartsIsAFileTooAndKeepsItsAttributes) {
  const TemporaryFolder folder;
  write_capture_file(folder / "e.exr", {}, kAttributes);
  const CaptureFile file(folder / "e.exr");
  EXPECT_TRUE(file.parts().empty());
  EXPECT_EQ(file.attributes(), kAttributes);
}

TEST(CaptureFileTest, TruncatedAnywhereIsRefusedByOpening) {
  const TemporaryFolder folder;
  Random random(1);
  for (const std::size_t n_parts : {0, 1, 4}) {
    std::vector<CapturePart> parts;
    for (std::size_t i = 0; i < n_parts; ++i)
      parts.push_back(random_part("object " + std::to_string(i), -5, 890, 40, 45, random));
    write_capture_file(folder / "c.exr", parts, kAttributes);
    const std::string bytes = read_file(folder / "c.exr");
    for (int i = 0; i < 50; ++i) {
      const auto n = static_cast<std::uint32_t>(bytes.size());
      const std::size_t length = i == 0 ? n - 1 : random.below(n);
      put_bytes(folder / "cut.exr", bytes.substr(0, length));
      try {
        const CaptureFile file(folder / "cut.exr");
        ADD_FAILURE() << n_parts << " parts cut to " << length << " of " << n << " bytes";
      } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_EQ(text.find((folder / "cut.exr").string()), 0u) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
      }
    }
  }
}

TEST(CaptureFileTest, CorruptFilesReadOrAreRefused) {
  const TemporaryFolder folder;
  const std::vector<CapturePart> parts = random_parts(2);
  write_capture_file(folder / "c.exr", parts, kAttributes);
  const std::string bytes = read_file(folder / "c.exr");
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::string bad = bytes;
    for (int k = 0; k < 3; ++k) {
      const auto reach = k < 2 ? std::min<std::size_t>(bad.size(), 3000) : bad.size();
      bad[random.below(static_cast<std::uint32_t>(reach))] = static_cast<char>(random.below(256));
    }
    put_bytes(folder / "bad.exr", bad);
    error_of_capture(folder / "bad.exr");
  }
}

// Or OpenEXR takes what follows for sizes, and OpenImageIO ends the program.
TEST(CaptureFileTest, AttributesAreAsTheirTypesAsk) {
  using namespace std::string_literals;
  const TemporaryFolder folder;
  Random random(1);
  write_capture_file(folder / "c.exr", {random_part("a", 0, 0, 8, 8, random)}, {});
  const std::string bytes = read_file(folder / "c.exr");
  const auto refused = [&](const std::string& from, const std::string& to, const char* message) {
    put_bytes(folder / "bad.exr", replaced(bytes, from, to));
    EXPECT_NE(error_of_capture(folder / "bad.exr").find(message), std::string::npos) << from;
  };
  refused("\0A\0\x01\0"s, "\0A\0\x03\0"s, "attribute 'channels' is no sound 'chlist'");
  refused("float\0\x04\0"s, "float\0\0\0"s, "is no sound 'float'");
  refused("m44f\0\x40\0"s, "m44f\0\x3c\0"s, "is no sound 'm44f'");
}

TEST(CaptureFileTest, AbsurdWindowsAndPartsAreRefusedBeforeAnythingIsAllocated) {
  const TemporaryFolder folder;
  Random random(1);
  write_capture_file(folder / "c.exr", {random_part("a", 0, 0, 8, 8, random)}, {});
  const std::string bytes = read_file(folder / "c.exr");
  const std::string head = std::string("dataWindow") + '\0' + "box2i" + '\0';
  const std::size_t at = bytes.find(head) + head.size() + 4;
  const auto with_window = [&](std::vector<std::int32_t> box) {
    std::string bad = bytes;
    bad.replace(at, 16, reinterpret_cast<const char*>(box.data()), 16);
    put_bytes(folder / "bad.exr", bad);
    return error_of_capture(folder / "bad.exr");
  };
  EXPECT_NE(with_window({0, 0, 2000000000, 7}).find("reaches 2000000000"), std::string::npos);
  EXPECT_NE(with_window({0, 0, 16384, 7}).find("16385 x 8 pixels"), std::string::npos);
  EXPECT_NE(with_window({0, 0, -1, 7}).find("0 x 8 pixels"), std::string::npos);
  EXPECT_NE(with_window({0, 0, 7, 9999}), "");
  // As wide as is allowed, but far more than 1032 bytes a byte of file.
  EXPECT_NE(with_window({0, 0, 16383, 7}), "");
}

TEST(CaptureFileTest, NumbersThatAreNotFiniteAreRefused) {
  const TemporaryFolder folder;
  Random random(1);
  CapturePart part = random_part("object 9", 0, 0, 9, 1, random);
  part.z[4] = 1234.5f;
  CapturePart nan = part;
  nan.z[4] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(write_capture_file(folder / "n.exr", {nan}, {}), BugError);
  nan = part;
  nan.rgba_half[5] = 0x7c00;
  EXPECT_THROW(write_capture_file(folder / "n.exr", {nan}, {}), BugError);
  EXPECT_FALSE(fs::exists(folder / "n.exr"));
  write_capture_file(folder / "m.exr", {part}, {});
  std::string bytes = read_file(folder / "m.exr");
  const std::string head = std::string("worldToNDC") + '\0' + "m44f" + '\0';
  const float bad = std::numeric_limits<float>::infinity();
  bytes.replace(bytes.find(head) + head.size() + 4, 4, reinterpret_cast<const char*>(&bad), 4);
  write_file(folder / "m.exr", bytes);
  EXPECT_NE(error_of_capture(folder / "m.exr").find("worldToNDC is not finite"), std::string::npos);
}

TEST(CaptureFileTest, ForeignPixelsAreCheckedToo) {
  const TemporaryFolder folder;
  const fs::path file = folder / "f.exr";
  write_foreign_exr(file, {"R", "G", "B", "A", "Z"}, 0.5f);
  EXPECT_EQ(error_of_capture(file), "");
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), INFINITY, 1e9f}) {
    write_foreign_exr(file, {"R", "G", "B", "A", "Z"}, bad);  // 1e9 is infinite as a half
    EXPECT_NE(error_of_capture(file).find("part 0 (object 0): holds a number that is not finite"),
              std::string::npos);
  }
}

TEST(CaptureFileTest, MissingOrWrongChannelsAreRefused) {
  const TemporaryFolder folder;
  const fs::path file = folder / "f.exr";
  const std::string expected = "part 0: its channels are not R, G, B, A as half and Z as float";
  write_foreign_exr(file, {"R", "G", "B", "A"}, 0.5f);
  EXPECT_NE(error_of_capture(file).find(expected), std::string::npos);
  write_foreign_exr(file, {"R", "G", "B", "Z"}, 0.5f);
  EXPECT_NE(error_of_capture(file).find(expected), std::string::npos);
  write_foreign_exr(file, {"R", "G", "B", "A", "Z"}, 0.5f, true);
  EXPECT_NE(error_of_capture(file).find(expected), std::string::npos);
}

TEST(CaptureFileTest, OtherFilesAreRefusedByName) {
  const TemporaryFolder folder;
  EXPECT_NE(error_of_capture(folder / "none.exr").find("none.exr"), std::string::npos);
  EXPECT_NE(error_of_capture(folder.path()).find("is a folder"), std::string::npos);
  write_file(folder / "text.exr", "v 0 0 0\n");
  EXPECT_NE(error_of_capture(folder / "text.exr").find("not an EXR"), std::string::npos);
}

TEST(CaptureFileTest, WrongPartsAreOurBug) {
  const TemporaryFolder folder;
  Random random(1);
  const CapturePart part = random_part("a", 0, 0, 3, 3, random);
  CapturePart short_z = part, other_source = part, no_name = part;
  short_z.z.pop_back();
  other_source.header.name = "b";
  other_source.header.source_width_px = 512;
  no_name.header.name = "";
  EXPECT_THROW(write_capture_file(folder / "x.exr", {short_z}, {}), BugError);
  EXPECT_THROW(write_capture_file(folder / "x.exr", {part, other_source}, {}), BugError);
  EXPECT_THROW(write_capture_file(folder / "x.exr", {part, part}, {}), BugError);
  EXPECT_THROW(write_capture_file(folder / "x.exr", {no_name}, {}), BugError);
  EXPECT_THROW(write_capture_file(folder / "x.exr", {part}, {{"Bad name", "x"}}), BugError);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

// No file may grow beyond a size: the writes fail as on a full disk.
TEST(CaptureFileTest, AFullDiskIsTheMachinesFaultAndLeavesNothing) {
  const TemporaryFolder folder;
  const std::vector<CapturePart> parts = random_parts(2);
  write_capture_file(folder / "whole.exr", parts, {});
  const auto size = fs::file_size(folder / "whole.exr");
  fs::remove(folder / "whole.exr");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  for (const auto most : {size - 1, size - 100, size / 2, std::uintmax_t{100}, std::uintmax_t{0}}) {
    const rlimit limit{most, before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
    EXPECT_THROW(write_capture_file(folder / "c.exr", parts, {}), MachineError) << most;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    EXPECT_TRUE(fs::is_empty(folder.path())) << most;
  }
  EXPECT_THROW(write_capture_file(folder / "no/such.exr", {}, {}), MachineError);
}

}  // namespace
}  // namespace viewcell

#include "base/section_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <optional>
#include <set>

#include "base/file.h"
#include "base/random.h"
#include "common/expect_input_error.h"
#include "common/mutate.h"
#include "common/temporary_folder.h"

namespace viewcell {
namespace {

constexpr std::uint32_t kKind = 0x1234;

struct Contents {
  std::vector<std::uint32_t> ids;
  std::vector<double> sums;
  std::vector<char> none;
  bool operator==(const Contents&) const = default;
};

Contents make_contents() {
  Contents c;
  for (std::uint32_t i = 0; i < 7; ++i) c.ids.push_back(i * 0x01010101u);
  c.sums = {1.5, -0.0, 1e300};
  return c;
}

std::string make_file(const TemporaryFolder& folder, const Contents& c) {
  SectionWriter writer(kKind);
  writer.add("ids", c.ids);
  writer.add("eightchr", c.sums);
  writer.add("none", c.none);
  writer.write(folder.path() / "whole");
  return read_file(folder.path() / "whole");
}

Contents read(const std::filesystem::path& file) {
  const SectionReader reader(file, kKind);
  return {reader.read<std::uint32_t>("ids"), reader.read<double>("eightchr"),
          reader.read<char>("none")};
}

// Without write_file's sync, nor the one that file systems do when a file is overwritten.
Contents read_bytes(const TemporaryFolder& folder, const std::string& bytes) {
  std::filesystem::remove(folder.path() / "damaged");
  std::ofstream(folder.path() / "damaged", std::ios::binary) << bytes;
  return read(folder.path() / "damaged");
}

TEST(SectionFile, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const Contents c = make_contents();
  make_file(folder, c);
  EXPECT_EQ(read(folder.path() / "whole"), c);
  const SectionReader reader(folder.path() / "whole", kKind);
  EXPECT_EQ(reader.n_bytes("ids"), 28u);
  EXPECT_EQ(reader.n_bytes("none"), 0u);
}

// The table's hash tells any content from any other, and is what the writer returns.
TEST(SectionFile, TheTablesHashIsOfAllContent) {
  const TemporaryFolder folder;
  std::set<std::uint64_t> hashes;
  const auto write = [&](const Contents& c, std::uint32_t kind) {
    SectionWriter writer(kind);
    writer.add("ids", c.ids);
    writer.add("sums", c.sums);
    const std::uint64_t hash = writer.write(folder.path() / "a");
    EXPECT_EQ(SectionReader(folder.path() / "a", kind).table_hash(), hash);
    hashes.insert(hash);
  };
  Contents c = make_contents();
  write(c, kKind);
  write(c, kKind);
  EXPECT_EQ(hashes.size(), 1u);
  write(c, kKind + 1);
  ++c.ids[3];
  write(c, kKind);
  c.ids.pop_back();
  write(c, kKind);
  EXPECT_EQ(hashes.size(), 4u);
}

TEST(SectionFile, SectionsStartAtMultiplesOf16) {
  const TemporaryFolder folder;
  const std::string bytes = make_file(folder, make_contents());
  for (std::size_t i = 0; i < 3; ++i) {
    std::uint64_t offset = 0;
    std::memcpy(&offset, bytes.data() + 16 + 32 * i + 8, 8);
    EXPECT_EQ(offset % 16, 0u);
  }
}

TEST(SectionFile, RefusesAnotherKindAndMissingSections) {
  const TemporaryFolder folder;
  make_file(folder, make_contents());
  EXPECT_INPUT_ERROR(SectionReader(folder.path() / "whole", kKind + 1), "another kind");
  const SectionReader reader(folder.path() / "whole", kKind);
  EXPECT_INPUT_ERROR(reader.read<char>("absent"), "section absent: is missing");
  EXPECT_INPUT_ERROR(reader.read<std::uint64_t>("ids"), "no whole number of records");
  EXPECT_INPUT_ERROR(SectionReader(folder.path() / "absent", kKind), "cannot open");
  EXPECT_INPUT_ERROR(SectionReader(folder.path(), kKind), "not a file");
  EXPECT_INPUT_ERROR(SectionReader(folder.add("empty", ""), kKind), "too short");
  EXPECT_INPUT_ERROR(SectionReader(folder.add("text", std::string(100, 'x')), kKind),
                     "is not a section file");
  EXPECT_INPUT_ERROR(SectionReader(folder.path() / "text", kKind, "a loaf"), "is not a loaf");
  EXPECT_INPUT_ERROR(SectionReader(folder.path() / "whole", kKind + 1, "a loaf"), "is not a loaf");
}

TEST(SectionFile, InfoSaysFormatAndVersion) {
  const TemporaryFolder folder;
  const auto read = [&](const char* info) {
    SectionWriter writer(kKind);
    if (info) writer.add_bytes("INFO", info);
    writer.write(folder / "f");
    return SectionReader(folder / "f", kKind).read_info("viewcell-loaf", 2);
  };
  const Json info = read(R"({"format": "viewcell-loaf", "version": 2, "slices": 7})");
  EXPECT_EQ(info["slices"], 7);
  EXPECT_INPUT_ERROR(read(R"({"format": "viewcell-bun", "version": 2})"),
                     "format: is not viewcell-loaf");
  EXPECT_INPUT_ERROR(read(R"({"format": "viewcell-loaf", "version": 1})"), "version: is not 2");
  EXPECT_INPUT_ERROR(read(R"({"format": "viewcell-loaf", "version": "2"})"), "is not a number");
  EXPECT_INPUT_ERROR(read(R"({"version": 2})"), "has no \"format\"");
  EXPECT_INPUT_ERROR(read("[]"), "is not an object");
  EXPECT_INPUT_ERROR(read("{"), "not valid JSON");
  EXPECT_INPUT_ERROR(read(nullptr), "section INFO: is missing");
}

// Padding between sections carries nothing, so a change there reads the same; all else is refused.
TEST(SectionFile, EveryChangedByteIsRefusedOrChangesNothing) {
  const TemporaryFolder folder;
  const Contents c = make_contents();
  const std::string bytes = make_file(folder, c);
  std::size_t n_harmless = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (const int bit : {0, 7}) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
      try {
        EXPECT_EQ(read_bytes(folder, damaged), c) << "byte " << i;
        ++n_harmless;
      } catch (const InputError&) {
      }
    }
  EXPECT_EQ(n_harmless, 2 * (8 + 4 + 8u));  // two bits in each byte of padding, and nowhere else
}

TEST(SectionFile, RefusesWhatFollowsTheLastSection) {
  const TemporaryFolder folder;
  const std::string bytes = make_file(folder, make_contents());
  EXPECT_INPUT_ERROR(read_bytes(folder, bytes + std::string(1, '\0')), "1 bytes follow");
  EXPECT_INPUT_ERROR(read_bytes(folder, bytes + bytes), "follow its last section");
  SectionWriter(kKind).write(folder.path() / "none");
  EXPECT_NO_THROW(SectionReader(folder.path() / "none", kKind));
}

TEST(SectionFile, EveryTruncationIsRefusedOrChangesNothing) {
  const TemporaryFolder folder;
  const Contents c = make_contents();
  const std::string bytes = make_file(folder, c);
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    std::optional<Contents> found;
    try {
      found = read_bytes(folder, bytes.substr(0, n));
    } catch (const InputError&) {
    }
    EXPECT_FALSE(found && *found != c) << n << " bytes";
    EXPECT_FALSE(found && n + 16 < bytes.size()) << n << " bytes of " << bytes.size();
  }
}

// Counts and sizes with a hash that fits, as a hostile file has them: refused before memory is
// asked for.
TEST(SectionFile, AbsurdCountsAreRefused) {
  const TemporaryFolder folder;
  const std::string bytes = make_file(folder, make_contents());
  const auto with = [&](std::size_t at, std::uint64_t value, std::size_t width) {
    std::string changed = bytes;
    std::memcpy(changed.data() + at, &value, width);
    const std::uint64_t hash = hash_bytes(changed.data(), 16 + 3 * 32);
    std::memcpy(changed.data() + 16 + 3 * 32, &hash, 8);
    return changed;
  };
  ASSERT_EQ(with(12, 3, 4), bytes);
  for (const std::uint64_t count : {65ull, 0x7fffffffull, 0xffffffffull})
    EXPECT_INPUT_ERROR(read_bytes(folder, with(12, count, 4)), "truncated");
  for (const std::uint64_t huge : {1ull << 20, 1ull << 40, ~0ull, ~0ull - 15})
    for (const std::size_t field : {24u, 32u})  // offset and size of the first section
      EXPECT_INPUT_ERROR(read_bytes(folder, with(field, huge, 8)),
                         "section ids: reaches past the end of the file");
}

TEST(SectionFile, DamagedCopiesNeverDoWorse) {
  const TemporaryFolder folder;
  const Contents c = make_contents();
  read_damaged_copies(make_file(folder, c), 1000, 5,
                      [&](const std::string& bytes) { EXPECT_EQ(read_bytes(folder, bytes), c); });
}

TEST(SectionFile, FileThatShrinksAfterOpeningIsRefused) {
  const TemporaryFolder folder;
  const std::string bytes = make_file(folder, make_contents());
  const SectionReader reader(folder.path() / "whole", kKind);
  ASSERT_EQ(truncate((folder.path() / "whole").c_str(), 130), 0);
  EXPECT_INPUT_ERROR(reader.read<double>("eightchr"), "cannot be read to its end");
}

TEST(SectionWriter, RefusesLongTags) {
  SectionWriter writer(1);
  EXPECT_THROW(writer.add_bytes("ninechars", ""), BugError);
}

}  // namespace
}  // namespace viewcell

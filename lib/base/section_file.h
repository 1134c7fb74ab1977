// Binary files of named sections, each with its hash; read with pread, never trusted.
// Layout (little-endian): "VCSECT01", u32 kind, u32 n_sections, then per section
// { char tag[8]; u64 offset; u64 n_bytes; u64 xxh3 }, then the xxh3 of all of that, then the
// sections, each starting at a multiple of 16.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/json.h"

namespace viewcell {

static_assert(std::endian::native == std::endian::little, "section files are little-endian");

/// Gathers sections and writes them whole or not at all.
class SectionWriter {
 public:
  explicit SectionWriter(std::uint32_t kind) : kind_(kind) {}
  /// tag: at most 8 characters. T: a plain type without padding.
  template <typename T>
  void add(const std::string& tag, const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add_bytes(tag, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
  }
  void add_bytes(const std::string& tag, std::string_view bytes);
  /// Returns the file's table_hash().
  std::uint64_t write(const std::filesystem::path& file) const;

 private:
  struct Section {
    std::string tag;
    std::string bytes;
  };
  std::uint32_t kind_;
  std::vector<Section> sections_;
};

/// Opens a section file and checks its table; sections are read one by one.
class SectionReader {
 public:
  /// Throws InputError when the file is missing, truncated, of another kind, or its table is bad.
  /// what: a file of this kind, with its article, for errors. "-", a pipe or a device is read into
  /// memory whole.
  SectionReader(const std::filesystem::path& file, std::uint32_t kind,
                const std::string& what = "a section file");
  ~SectionReader();
  SectionReader(const SectionReader&) = delete;
  SectionReader& operator=(const SectionReader&) = delete;

  /// The section's values; its hash and size are checked. Throws InputError.
  template <typename T>
  std::vector<T> read(const std::string& tag) const {
    std::vector<T> values;
    read(tag, values);
    return values;
  }
  /// The same into memory that is there already: fresh pages cost as much as the reading.
  template <typename T>
  void read(const std::string& tag, std::vector<T>& values) const {
    static_assert(std::is_trivially_copyable_v<T>);
    const Section& section = find(tag);
    if (section.n_bytes % sizeof(T) != 0)
      fail(tag, "has a size that is no whole number of records");
    values.resize(section.n_bytes / sizeof(T));
    read_bytes(section, reinterpret_cast<char*>(values.data()));
  }
  /// The JSON object in section INFO, whose "format" must be the one given, and "version" the
  /// one given or one from there to `newest`. Throws InputError.
  Json read_info(const std::string& format, int version, int newest = 0) const;
  /// XXH3 of the table, which holds the hashes of all sections: no other content has it.
  std::uint64_t table_hash() const { return table_hash_; }
  std::uint64_t n_bytes(const std::string& tag) const { return find(tag).n_bytes; }
  [[noreturn]] void fail(const std::string& tag, const std::string& what) const;

 private:
  struct Section {
    char tag[8];
    std::uint64_t offset, n_bytes, hash;
  };
  const Section& find(const std::string& tag) const;
  void read_bytes(const Section& section, char* to) const;
  void read_at(std::uint64_t offset, char* to, std::uint64_t n) const;
  std::uint64_t open_file();
  void read_table(std::uint32_t kind, const std::string& what);

  std::filesystem::path file_;
  int fd_ = -1;        // of a regular file; otherwise
  std::string bytes_;  // the whole of it
  std::vector<Section> sections_;
  std::uint64_t table_hash_ = 0;
};

}  // namespace viewcell

#include "base/section_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "base/file.h"

namespace viewcell {
namespace {

constexpr char kMagic[8] = {'V', 'C', 'S', 'E', 'C', 'T', '0', '1'};
constexpr std::uint32_t kMostSections = 64;
constexpr std::size_t kEntryBytes = 32;
constexpr std::size_t kHeadBytes = 16;

std::uint64_t aligned(std::uint64_t offset) {
  return (offset + 15) / 16 * 16;
}

template <typename T>
void append(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

void SectionWriter::add_bytes(const std::string& tag, std::string_view bytes) {
  VIEWCELL_CHECK(tag.size() <= 8 && sections_.size() < kMostSections, tag, sections_.size());
  sections_.push_back({tag, std::string(bytes)});
}

std::uint64_t SectionWriter::write(const std::filesystem::path& file) const {
  std::string out(kMagic, sizeof kMagic);
  append(out, kind_);
  append(out, static_cast<std::uint32_t>(sections_.size()));
  std::uint64_t offset = kHeadBytes + sections_.size() * kEntryBytes + 8;
  for (const Section& section : sections_) {
    offset = aligned(offset);
    char tag[8] = {};
    std::memcpy(tag, section.tag.data(), section.tag.size());
    out.append(tag, sizeof tag);
    append(out, offset);
    append(out, static_cast<std::uint64_t>(section.bytes.size()));
    append(out, hash_bytes(section.bytes.data(), section.bytes.size()));
    offset += section.bytes.size();
  }
  const std::uint64_t table_hash = hash_bytes(out.data(), out.size());
  append(out, table_hash);
  for (const Section& section : sections_) {
    out.resize(aligned(out.size()), '\0');
    out += section.bytes;
  }
  write_file(file, out);
  return table_hash;
}

SectionReader::SectionReader(const std::filesystem::path& file, std::uint32_t kind,
                             const std::string& what)
    : file_(file) {
  try {
    read_table(kind, what);
  } catch (...) {
    if (fd_ >= 0) ::close(fd_);
    throw;
  }
}

SectionReader::~SectionReader() {
  if (fd_ >= 0) ::close(fd_);
}

// Returns its size.
std::uint64_t SectionReader::open_file() {
  struct stat info {};
  if (file_ != "-" && ::stat(file_.c_str(), &info) == 0 && S_ISDIR(info.st_mode))
    fail("", "is a folder, not a file");
  if (file_ == "-" || (info.st_mode != 0 && !S_ISREG(info.st_mode))) {
    bytes_ = read_file(file_);
    return bytes_.size();
  }
  fd_ = ::open(file_.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd_ < 0) fail("", std::string("cannot open: ") + strerror(errno));
  if (::fstat(fd_, &info) != 0 || !S_ISREG(info.st_mode)) fail("", "is not a file");
  return static_cast<std::uint64_t>(info.st_size);
}

void SectionReader::read_table(std::uint32_t kind, const std::string& what) {
  const std::uint64_t size = open_file();
  std::string head(kHeadBytes, '\0');
  if (size < kHeadBytes + 8) fail("", "is too short to be " + what);
  read_at(0, head.data(), head.size());
  if (std::memcmp(head.data(), kMagic, sizeof kMagic) != 0) fail("", "is not " + what);
  std::uint32_t found_kind = 0, n = 0;
  std::memcpy(&found_kind, head.data() + 8, 4);
  std::memcpy(&n, head.data() + 12, 4);
  if (found_kind != kind)
    fail("", what == "a section file" ? "is a section file of another kind" : "is not " + what);
  if (n > kMostSections || size < kHeadBytes + n * kEntryBytes + 8) fail("", "is truncated");
  head.resize(kHeadBytes + n * kEntryBytes + 8);
  read_at(kHeadBytes, head.data() + kHeadBytes, head.size() - kHeadBytes);
  std::memcpy(&table_hash_, head.data() + head.size() - 8, 8);
  if (table_hash_ != hash_bytes(head.data(), head.size() - 8))
    fail("", "its table of sections is damaged");
  sections_.resize(n);
  std::uint64_t end = head.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::memcpy(&sections_[i], head.data() + kHeadBytes + i * kEntryBytes, kEntryBytes);
    const Section& section = sections_[i];
    if (section.offset > size || section.n_bytes > size - section.offset)
      fail(std::string(section.tag, strnlen(section.tag, 8)), "reaches past the end of the file");
    for (std::size_t k = 0; k < i; ++k)
      if (std::memcmp(section.tag, sections_[k].tag, sizeof section.tag) == 0)
        fail(std::string(section.tag, strnlen(section.tag, 8)), "stands twice");
    end = std::max(end, section.offset + section.n_bytes);
  }
  if (end != size) fail("", std::to_string(size - end) + " bytes follow its last section");
}

const SectionReader::Section& SectionReader::find(const std::string& tag) const {
  for (const Section& section : sections_)
    if (tag == std::string(section.tag, strnlen(section.tag, 8))) return section;
  fail(tag, "is missing");
}

void SectionReader::read_bytes(const Section& section, char* to) const {
  read_at(section.offset, to, section.n_bytes);
  if (hash_bytes(to, section.n_bytes) != section.hash)
    fail(std::string(section.tag, strnlen(section.tag, 8)), "is damaged: its hash does not match");
}

void SectionReader::read_at(std::uint64_t offset, char* to, std::uint64_t n) const {
  if (fd_ < 0) {
    std::memcpy(to, bytes_.data() + offset, n);  // read_table has checked the sections
    return;
  }
  while (n > 0) {
    const ssize_t got = ::pread(fd_, to, n, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail("", "cannot be read to its end");
    offset += static_cast<std::uint64_t>(got);
    to += got;
    n -= static_cast<std::uint64_t>(got);
  }
}

Json SectionReader::read_info(const std::string& format, int version, int newest) const {
  const auto bytes = read<char>("INFO");
  Json json = parse_json(std::string(bytes.begin(), bytes.end()), file_);
  const JsonCursor info(json, file_);
  if (info.at("format").string() != format) info.at("format").fail("is not " + format);
  const std::int64_t found = info.at("version").integer(0, 1 << 30);
  if (found < version || found > std::max(version, newest))
    info.at("version").fail("is not " + std::to_string(version) +
                            (newest > version ? " to " + std::to_string(newest) : ""));
  return json;
}

void SectionReader::fail(const std::string& tag, const std::string& what) const {
  throw InputError(file_.string(), tag.empty() ? "" : "section " + tag, what);
}

}  // namespace viewcell

#include "image/exr_layout.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "base/error.h"
#include "image/exr_attributes.h"
#include "image/header.h"

// Follows: "OpenEXR File Layout" (openexr.com), format version 2. Little-endian throughout.

namespace viewcell {
namespace {

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kTiledBit = 0x200, kDeepBit = 0x800, kManyPartsBit = 0x1000;
constexpr std::size_t kMaxNameLength = 255;
constexpr std::int32_t kMaxCoordinate = 1 << 20;
// Lines a chunk, by compression: none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa, dwab.
constexpr std::array<int, 10> kLinesOfChunk = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};

// A file read forward, in small pieces, none of them past its end.
class Reader {
 public:
  Reader(std::FILE* stream, const std::string& name) : name_(name), stream_(stream) {
    if (::fseeko(stream_, 0, SEEK_END) != 0) throw InputError(name_, "", "is not a file");
    size_ = static_cast<std::uint64_t>(::ftello(stream_));
    seek(0);
  }

  std::uint64_t size() const { return size_; }
  std::uint64_t position() const { return position_; }
  std::uint64_t left() const { return size_ - position_; }

  void read(void* to, std::uint64_t n_bytes) {
    if (n_bytes > left() || std::fread(to, 1, n_bytes, stream_) != n_bytes)
      fail("the file ends in its header or chunk table");
    position_ += n_bytes;
  }
  template <typename Number>
  Number number() {
    Number x;
    read(&x, sizeof x);
    return x;
  }
  /// Up to the zero byte; empty at the end of a list.
  std::string string() {
    std::string text;
    for (char c = number<char>(); c != 0; c = number<char>()) {
      if (text.size() == kMaxNameLength) fail("a name in the header does not end");
      text += c;
    }
    return text;
  }
  std::string text(std::uint64_t n_bytes) {
    if (n_bytes > left()) fail("the file ends in its header");
    std::string bytes(n_bytes, '\0');
    read(bytes.data(), n_bytes);
    return bytes;
  }
  void skip(std::uint64_t n_bytes) {
    if (n_bytes > left()) fail("the file ends in its header");
    seek(position_ + n_bytes);
  }
  void seek(std::uint64_t position) {
    if (::fseeko(stream_, static_cast<off_t>(position), SEEK_SET) != 0) fail("cannot be read");
    position_ = position;
  }

  void set_place(const std::string& place) { place_ = place; }
  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_, place_, what); }

 private:
  std::string name_, place_;
  std::FILE* stream_;
  std::uint64_t size_ = 0, position_ = 0;
};

// What the check needs of a part's header.
struct PartHeader {
  bool has_window = false;
  std::array<std::int32_t, 4> window{};  // x and y of the first and the last pixel
  std::int32_t n_chunks = -1;            // the file may leave it out when it has one part
  int compression = -1;

  std::int64_t width_px() const { return std::int64_t{window[2]} - window[0] + 1; }
  std::int64_t height_px() const { return std::int64_t{window[3]} - window[1] + 1; }
};

void read_attribute(Reader& reader, const std::string& name, PartHeader& part) {
  const std::string type = reader.string();
  const auto n_bytes = reader.number<std::int32_t>();
  if (n_bytes < 0) reader.fail("attribute '" + name + "' has a negative size");
  const std::string value = reader.text(static_cast<std::uint64_t>(n_bytes));
  if (!is_sound_exr_attribute(type, value))
    reader.fail("attribute '" + name + "' is no sound '" + type + "'");
  if (name == "dataWindow" && n_bytes == 16) {
    std::memcpy(part.window.data(), value.data(), 16);
    part.has_window = true;
  } else if (name == "chunkCount" && n_bytes == 4) {
    std::memcpy(&part.n_chunks, value.data(), 4);
  } else if (name == "compression" && n_bytes == 1) {
    part.compression = static_cast<unsigned char>(value[0]);
  }
}

// Holds the window and the compression, and sets or holds the number of chunks.
void check_part_header(const Reader& reader, PartHeader& part) {
  if (!part.has_window) reader.fail("has no data window");
  for (const std::int32_t x : part.window)
    if (x < -kMaxCoordinate || x > kMaxCoordinate)
      reader.fail("its data window reaches " + std::to_string(x));
  if (part.width_px() < 1 || part.height_px() < 1 || part.width_px() > kMaxImageSidePx ||
      part.height_px() > kMaxImageSidePx)
    reader.fail("its data window is " + std::to_string(part.width_px()) + " x " +
                std::to_string(part.height_px()) + " pixels");
  if (part.compression < 0 || part.compression >= static_cast<int>(kLinesOfChunk.size()))
    reader.fail("has an unknown compression");
  const int lines = kLinesOfChunk[static_cast<std::size_t>(part.compression)];
  const auto expected = static_cast<std::int32_t>((part.height_px() + lines - 1) / lines);
  if (part.n_chunks != -1 && part.n_chunks != expected)
    reader.fail("declares " + std::to_string(part.n_chunks) + " chunks, not " +
                std::to_string(expected));
  part.n_chunks = expected;
}

// Empty at the end of a list of headers: a header has attributes.
std::vector<PartHeader> read_headers(Reader& reader, bool many_parts) {
  std::vector<PartHeader> parts;
  do {
    reader.set_place("part " + std::to_string(parts.size()));
    std::string name = reader.string();
    if (name.empty()) break;
    PartHeader part;
    for (; !name.empty(); name = reader.string()) read_attribute(reader, name, part);
    check_part_header(reader, part);
    parts.push_back(part);
  } while (many_parts);
  reader.set_place("header");
  if (parts.empty()) reader.fail("has no parts");
  return parts;
}

// The offset of the last chunk, after checking that all start behind the tables and inside the
// file.
std::uint64_t read_last_offset(Reader& reader, const std::vector<PartHeader>& parts) {
  std::uint64_t n_chunks = 0;
  for (const PartHeader& part : parts) n_chunks += static_cast<std::uint64_t>(part.n_chunks);
  if (n_chunks > reader.left() / 8) reader.fail("the file ends in its chunk table");
  std::vector<std::uint64_t> offsets(n_chunks);
  reader.read(offsets.data(), 8 * n_chunks);
  for (const std::uint64_t offset : offsets)
    if (offset < reader.position() || offset >= reader.size())
      reader.fail("a chunk is outside the file: it is cut, or was not finished");
  return *std::max_element(offsets.begin(), offsets.end());
}

}  // namespace

std::uint64_t check_exr_layout(std::FILE* file, const std::string& name) {
  Reader reader(file, name);
  reader.set_place("header");
  if (reader.number<std::uint32_t>() != kMagic) reader.fail("is not an EXR file");
  const auto version = reader.number<std::uint32_t>();
  if ((version & 0xff) != 2 || (version & (kTiledBit | kDeepBit)) != 0)
    reader.fail("is not an EXR of scan lines");
  const bool many_parts = (version & kManyPartsBit) != 0;
  const std::vector<PartHeader> parts = read_headers(reader, many_parts);
  const std::uint64_t last = read_last_offset(reader, parts);
  reader.seek(last);
  reader.set_place("pixels");
  if (many_parts) reader.skip(4);  // the part's number
  reader.skip(4);                  // the line's
  const auto n_bytes = reader.number<std::int32_t>();
  if (n_bytes < 0 || static_cast<std::uint64_t>(n_bytes) > reader.left())
    reader.fail("the file ends inside a chunk: it is cut");
  return reader.size();
}

}  // namespace viewcell

#include <algorithm>
#include <cstring>

#include "image/picture_facts.h"

// Follows: ITU-T T.81, B.1 and B.2.

namespace viewcell {
namespace {

constexpr std::uint64_t kMostScans = 200;  // each is a pass over all blocks; encoders make about 10

// SOF0 to SOF15, except the tables DHT, JPG and DAC that sit among their numbers.
bool is_start_of_frame(std::uint32_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

// Blocks of 8 x 8 samples, of all components.
std::uint64_t count_blocks(const HeaderBytes& bytes, std::size_t frame) {
  const std::uint64_t height = bytes.be16(frame + 5), width = bytes.be16(frame + 7);
  const std::uint32_t n_components = std::min(bytes.u8(frame + 9), 4U);
  std::uint64_t h_most = 1, v_most = 1, of_unit = 0;
  for (std::uint32_t c = 0; c < n_components; ++c) {
    const std::uint32_t sampling = bytes.u8(frame + 11 + 3 * c);
    const std::uint64_t h = sampling >> 4, v = sampling & 15;
    h_most = std::max(h_most, h), v_most = std::max(v_most, v);
    of_unit += h * v;
  }
  if (n_components == 1) return ((width + 7) / 8) * ((height + 7) / 8);
  return (width / (8 * h_most)) * (height / (8 * v_most)) * of_unit;
}

// Where the coded pixels that begin at i end: at the next marker that is not within them.
std::size_t find_scan_end(std::string_view bytes, std::size_t i) {
  while (i + 1 < bytes.size()) {
    const void* found = std::memchr(bytes.data() + i, 0xff, bytes.size() - 1 - i);
    if (found == nullptr) break;
    i = static_cast<std::size_t>(static_cast<const char*>(found) - bytes.data());
    const auto next = static_cast<unsigned char>(bytes[i + 1]);
    if (next != 0 && next != 0xff && (next < 0xd0 || next > 0xd7)) return i;
    i += next == 0xff ? 1 : 2;
  }
  return bytes.size();
}

struct JpegScans {
  std::uint64_t n = 0, n_bytes = 0;
  bool ends = false;
};

// From the first marker behind the frame's header to the end marker.
JpegScans walk_scans(std::string_view all, std::size_t i) {
  const HeaderBytes bytes(all);
  JpegScans scans;
  while (i + 4 <= all.size() || bytes.has_at(i, "\xff\xd9")) {
    if (bytes.u8(i) != 0xff) return scans;
    const std::uint32_t marker = bytes.u8(i + 1);
    scans.ends = marker == 0xd9;
    if (scans.ends) return scans;
    if (marker == 0xff) {
      ++i;
      continue;
    }
    i += 2 + bytes.be16(i + 2);
    if (marker != 0xda) continue;
    const std::size_t end = find_scan_end(all, std::min(i, all.size()));
    ++scans.n;
    scans.n_bytes += end - std::min(i, end);
    i = end;
  }
  return scans;
}

std::size_t find_frame(const HeaderBytes& bytes) {
  std::size_t i = 2;
  while (i + 9 <= bytes.size() && bytes.u8(i) == 0xff) {
    const std::uint32_t marker = bytes.u8(i + 1);
    if (is_start_of_frame(marker)) return i;
    i += marker == 0xff ? 1 : 2 + bytes.be16(i + 2);  // a fill byte, or a segment
  }
  return 0;
}

}  // namespace

std::optional<PictureFacts> jpeg_facts(std::string_view bytes) {
  const HeaderBytes header(bytes);
  const std::size_t frame = find_frame(header);
  if (frame == 0) return std::nullopt;
  PictureFacts facts{header.be16(frame + 7), header.be16(frame + 5)};
  const JpegScans scans = walk_scans(bytes, frame + 2 + header.be16(frame + 2));
  // Damage within the scans may hide the marker from the walk; the decoder copes with that.
  if (!scans.ends && bytes.find("\xff\xd9", frame) == std::string_view::npos) return std::nullopt;
  if (scans.n > kMostScans) return std::nullopt;
  facts.n_bytes = scans.n_bytes;
  // Huffman codes have a bit at least, and each block one code at least. Arithmetic codes (SOF9 on)
  // may take less.
  facts.is_law = header.u8(frame + 1) < 0xc9;
  facts.least_bytes = count_blocks(header, frame) / 8;
  return facts;
}

}  // namespace viewcell

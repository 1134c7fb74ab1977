#include <algorithm>

#include "image/exr_attributes.h"
#include "image/picture_facts.h"

// Follows: "OpenEXR File Layout" (openexr.com), format version 2. OpenEXR makes room for whatever
// an attribute's size says, so the attributes are walked first.

namespace viewcell {
namespace {

constexpr std::uint32_t kSeveralParts = 0x1000, kNoScanLines = 0x200 | 0x800;  // tiles, deep

// The length of the name at i, at most 255; 0 at the end of a list, or where no name ends.
std::size_t name_length(std::string_view bytes, std::size_t i) {
  const std::size_t end = bytes.substr(0, std::min(bytes.size(), i + 256)).find('\0', i);
  return end == std::string_view::npos ? 0 : end - i;
}

struct ExrPart {
  bool is_whole = false;
  long long width_px = 0, height_px = 0;
};

// The attributes from i on, which moves behind their end.
ExrPart walk_part(std::string_view all, std::size_t& i) {
  const HeaderBytes bytes(all);
  ExrPart part;
  for (std::size_t name = name_length(all, i); name > 0; name = name_length(all, i)) {
    const std::string_view key = all.substr(i, name);
    const std::size_t at_type = i + name + 1;
    const std::size_t n_type = name_length(all, at_type);
    const std::size_t at_size = at_type + n_type + 1;
    const std::size_t at = at_size + 4, size = bytes.le32(at_size);
    if (at > all.size() || size > all.size() - at) return part;
    if (!is_sound_exr_attribute(all.substr(at_type, n_type), all.substr(at, size))) return part;
    if (key == "dataWindow" && size == 16) {
      const auto side = [&](std::size_t lo, std::size_t hi) {
        return static_cast<long long>(static_cast<std::int32_t>(bytes.le32(at + hi))) -
               static_cast<std::int32_t>(bytes.le32(at + lo)) + 1;
      };
      part.width_px = side(0, 8), part.height_px = side(4, 12);
    }
    i = at + size;
  }
  part.is_whole = i < all.size() && all[i] == '\0';
  ++i;
  return part;
}

}  // namespace

std::optional<PictureFacts> exr_facts(std::string_view bytes) {
  const std::uint32_t version = HeaderBytes(bytes).le32(4);
  std::size_t i = 8;
  PictureFacts facts;
  facts.n_bytes = bytes.size();
  std::uint64_t n_parts = 0;
  do {
    const ExrPart part = walk_part(bytes, i);
    if (!part.is_whole) return std::nullopt;
    if (n_parts++ == 0) facts.width_px = part.width_px, facts.height_px = part.height_px;
    // A place in the table for each chunk of at most 256 rows.
    if ((version & kNoScanLines) == 0 && part.height_px > 0)
      facts.least_bytes += static_cast<std::uint64_t>(part.height_px) / 256 * 8;
  } while ((version & kSeveralParts) != 0 && i < bytes.size() && bytes[i] != '\0');
  // OpenEXR makes room for rows when it opens a file. No compression that is a law
  // (memory_input.cpp) makes more than 2,064 bytes of one, of two or more a pixel.
  constexpr std::uint64_t kFree = 1 << 20, kPixelsPerByte = 4096;
  const std::uint64_t n_pixels = area_of(facts.width_px, facts.height_px);
  if (n_pixels > kFree)
    facts.least_bytes = std::max(facts.least_bytes, (n_pixels - kFree) / kPixelsPerByte);
  return facts;
}

}  // namespace viewcell

#include "image/picture_facts.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace viewcell {
namespace {

// Formats in which a few bytes may say any size: so many pixels are taken from any file, and so
// many more for each of its bytes.
constexpr std::uint64_t kFreePixels = 1 << 24;

std::uint64_t least_beyond_free(std::uint64_t n_pixels, std::uint64_t pixels_per_byte) {
  return n_pixels <= kFreePixels ? 0 : (n_pixels - kFreePixels) / pixels_per_byte;
}

// --- GIF ---

// Follows: GIF89a specification, 1990.
struct GifBlocks {
  std::uint64_t n_pictures = 0, n_data_bytes = 0;
};

std::size_t color_table_bytes(std::uint32_t flags) {
  return flags & 0x80 ? std::size_t{3} << ((flags & 7) + 1) : 0;
}

// Adds up sub-blocks from i; gives what follows them.
std::size_t skip_sub_blocks(const HeaderBytes& gif, std::size_t i, std::uint64_t* n_bytes) {
  while (i < gif.size() && gif.u8(i) != 0) {
    if (n_bytes != nullptr) *n_bytes += gif.u8(i);
    i += 1 + gif.u8(i);
  }
  return i + 1;
}

GifBlocks walk_gif(const HeaderBytes& gif) {
  GifBlocks blocks;
  for (std::size_t i = 13 + color_table_bytes(gif.u8(10)); i < gif.size();) {
    if (gif.u8(i) == '!') {
      i = skip_sub_blocks(gif, i + 2, nullptr);
    } else if (gif.u8(i) == ',') {
      const std::size_t data = i + 11 + color_table_bytes(gif.u8(i + 9));
      i = skip_sub_blocks(gif, data, blocks.n_pictures == 0 ? &blocks.n_data_bytes : nullptr);
      ++blocks.n_pictures;
    } else {
      break;  // the end, or what follows it
    }
  }
  return blocks;
}

}  // namespace

std::string next_header_word(std::string_view bytes, std::size_t& i) {
  constexpr std::size_t kMostHeader = 1 << 16;
  const auto is_space = [&] { return std::isspace(static_cast<unsigned char>(bytes[i])) != 0; };
  const std::size_t end = std::min(bytes.size(), i + kMostHeader);
  while (i < end && (is_space() || bytes[i] == '#')) {
    if (bytes[i] == '#')
      while (i < end && bytes[i] != '\n') ++i;
    else
      ++i;
  }
  std::string word;
  while (i < end && !is_space() && word.size() < 40) word += bytes[i++];
  return word;
}

long long parse_header_number(const std::string& word) {
  if (word.empty() || word.size() > 9) return -1;
  for (const char c : word)
    if (c < '0' || c > '9') return -1;
  return std::stoll(word);
}

std::uint64_t area_of(long long width, long long height) {
  constexpr long long kMost = 1LL << 31;
  if (width < 1 || height < 1 || width > kMost || height > kMost) return 0;  // refused by size
  return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

std::optional<PictureFacts> webp_facts(std::string_view bytes) {
  const HeaderBytes webp(bytes);
  if (bytes.size() < 30) return std::nullopt;
  PictureFacts facts{0, 0, bytes.size(), 0, false, 1};
  std::uint64_t pixels_per_byte = 4096;
  if (webp.has_at(12, "VP8 ")) {
    facts.width_px = webp.le16(26) & 0x3fff, facts.height_px = webp.le16(28) & 0x3fff;
  } else if (webp.has_at(12, "VP8L")) {
    const std::uint32_t all = webp.le32(21);
    facts.width_px = (all & 0x3fff) + 1, facts.height_px = (all >> 14 & 0x3fff) + 1;
    pixels_per_byte = 65536;  // codes of no bits, where a picture is plain
  } else if (webp.has_at(12, "VP8X")) {
    facts.width_px = webp.le24(24) + 1LL, facts.height_px = webp.le24(27) + 1LL;
    std::uint64_t n_frames = 0;
    for (std::size_t i = 12; i + 8 <= bytes.size();
         i += 8 + std::size_t{webp.le32(i + 4)} + (webp.le32(i + 4) & 1))
      n_frames += webp.has_at(i, "ANMF");
    facts.n_pictures = std::max<std::uint64_t>(n_frames, 1);
  } else {
    return std::nullopt;
  }
  facts.least_bytes = least_beyond_free(area_of(facts.width_px, facts.height_px), pixels_per_byte);
  return facts;
}

std::optional<PictureFacts> gif_facts(std::string_view bytes) {
  constexpr std::uint64_t kLzwMost = 4096;  // pixels of a byte: the longest word in 12 bits
  const HeaderBytes gif(bytes);
  if (bytes.size() < 13) return std::nullopt;
  const GifBlocks blocks = walk_gif(gif);
  if (blocks.n_pictures == 0) return std::nullopt;
  PictureFacts facts{gif.le16(6), gif.le16(8), blocks.n_data_bytes, 0, false, blocks.n_pictures};
  facts.least_bytes = least_beyond_free(area_of(facts.width_px, facts.height_px), kLzwMost);
  return facts;
}

std::optional<PictureFacts> bmp_facts(std::string_view bytes) {
  const HeaderBytes bmp(bytes);
  const std::uint32_t header = bmp.le32(14);
  if (bytes.size() < 26 || (header != 12 && header < 16)) return std::nullopt;
  const bool is_core = header == 12;
  const auto signed_32 = [&](std::size_t i) {
    return static_cast<long long>(static_cast<std::int32_t>(bmp.le32(i)));
  };
  PictureFacts facts;
  facts.width_px = is_core ? static_cast<long long>(bmp.le16(18)) : signed_32(18);
  facts.height_px = is_core ? static_cast<long long>(bmp.le16(20)) : std::abs(signed_32(22));
  const std::uint64_t bits = bmp.le16(is_core ? 24 : 28);
  const std::uint32_t compression = is_core ? 0 : bmp.le32(30);
  const std::uint64_t start = std::min<std::uint64_t>(bmp.le32(10), bytes.size());
  facts.n_bytes = bytes.size() - start;
  const std::uint64_t area = area_of(facts.width_px, facts.height_px);
  facts.is_law = compression == 0 || compression == 3 || compression == 6;
  facts.least_bytes = facts.is_law ? area * bits / 8 : least_beyond_free(area, 255);
  return facts;
}

std::optional<PictureFacts> targa_facts(std::string_view bytes) {
  const HeaderBytes tga(bytes);
  if (bytes.size() < 18) return std::nullopt;
  const std::uint32_t map_kind = tga.u8(1), kind = tga.u8(2), bits = tga.u8(16);
  const std::uint32_t map_bits = tga.u8(7), base_kind = kind & 7;
  if (map_kind > 1 || (kind & ~11U) != 0 || base_kind == 0 || (tga.u8(17) & 0xc0) != 0)
    return std::nullopt;
  const bool is_bits = base_kind == 2   ? bits == 15 || bits == 16 || bits == 24 || bits == 32
                       : base_kind == 1 ? bits == 8 || bits == 16
                                        : bits == 8 || bits == 16;
  const bool is_map = map_bits == 15 || map_bits == 16 || map_bits == 24 || map_bits == 32;
  if (!is_bits || (base_kind == 1) > (map_kind == 1) || (map_kind == 1 && !is_map))
    return std::nullopt;
  const std::uint64_t map_bytes = map_kind == 1 ? tga.le16(5) * ((map_bits + 7) / 8) : 0;
  const std::uint64_t before = 18 + tga.u8(0) + map_bytes, of_pixel = (bits + 7) / 8;
  PictureFacts facts{tga.le16(12), tga.le16(14)};
  if (before > bytes.size() || facts.width_px == 0 || facts.height_px == 0) return std::nullopt;
  facts.n_bytes = bytes.size() - before;
  const std::uint64_t area = area_of(facts.width_px, facts.height_px);
  // A packet of run lengths has up to 128 pixels.
  facts.least_bytes = kind & 8 ? area / 128 * (1 + of_pixel) : area * of_pixel;
  return facts;
}

std::optional<PictureFacts> hdr_facts(std::string_view bytes) {
  // Lines of words up to an empty one, then "-Y HEIGHT +X WIDTH".
  const std::size_t blank = bytes.find("\n\n");
  if (blank == std::string_view::npos) return std::nullopt;
  std::size_t i = blank + 2;
  const std::string first = next_header_word(bytes, i);
  const long long a = parse_header_number(next_header_word(bytes, i));
  const std::string second = next_header_word(bytes, i);
  const long long b = parse_header_number(next_header_word(bytes, i));
  if (a < 0 || b < 0 || first.size() != 2 || second.size() != 2) return std::nullopt;
  const bool is_y_first = first[1] == 'Y';
  PictureFacts facts{is_y_first ? b : a, is_y_first ? a : b};
  facts.n_bytes = bytes.size() - std::min(i, bytes.size());
  const std::uint64_t area = area_of(a, b);
  // Run lengths: two bytes for up to 127 of one of four channels.
  const bool may_run = facts.width_px >= 8 && facts.width_px <= 32767;
  facts.least_bytes = may_run ? area / 127 * 8 : area * 4;
  return facts;
}

namespace {

// What the extension area of a TGA of version 2 says of alpha; nothing without one.
std::optional<std::uint32_t> targa_alpha(std::string_view bytes) {
  // The footer points to the area, whose last byte is the kind of alpha.
  constexpr std::size_t kFooter = 26, kKindAt = 494;
  const HeaderBytes tga(bytes);
  if (bytes.size() < kFooter || !tga.has_at(bytes.size() - 18, "TRUEVISION-XFILE")) return {};
  const std::size_t extension = tga.le32(bytes.size() - kFooter);
  if (extension == 0 || extension + kKindAt >= bytes.size() - kFooter) return {};
  return tga.u8(extension + kKindAt);
}

// Of 32 bits a pixel, by masks; 0: those are told by another header.
std::uint32_t bmp_alpha_mask_at(const HeaderBytes& bmp) {
  constexpr std::uint32_t kWithAlphaMask = 56;  // bytes of the header
  return bmp.le32(30) == 3 && bmp.le32(14) >= kWithAlphaMask ? 66 : 0;
}

}  // namespace

bool targa_is_multiplied(std::string_view bytes) {
  return targa_alpha(bytes) == 4u;
}

bool targa_has_no_alpha(std::string_view bytes) {
  const std::optional<std::uint32_t> alpha = targa_alpha(bytes);
  return alpha && *alpha < 2;  // none, or undefined and to be ignored
}

bool bmp_has_no_alpha(std::string_view bytes) {
  const HeaderBytes bmp(bytes);
  const std::uint32_t at = bmp_alpha_mask_at(bmp);
  return at > 0 && bmp.le32(at) == 0;
}

UnreadParts find_unread_of_targa(std::string_view bytes) {
  const HeaderBytes tga(bytes);
  const std::uint32_t base_kind = tga.u8(2) & 7, bits = tga.u8(16), alpha_bits = tga.u8(17) & 15;
  UnreadParts out;
  if (base_kind == 1 && tga.le16(3) > 0)
    out.fault = "has a palette that does not start at 0, which is not read";
  if (base_kind == 1 && tga.u8(7) == 32) out.alpha = "alpha of a palette";
  if (base_kind == 2 && bits == 16 && alpha_bits > 0) out.alpha = "alpha of one bit";
  return out;
}

UnreadParts find_unread_of_bmp(std::string_view bytes) {
  const HeaderBytes bmp(bytes);
  const std::uint32_t at = bmp_alpha_mask_at(bmp);
  UnreadParts out;
  if (at > 0 && bmp.le16(28) == 16 && bmp.le32(at) != 0) out.alpha = "alpha of one bit";
  return out;
}

}  // namespace viewcell

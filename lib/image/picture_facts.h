// What a picture's file says of itself before it is decoded, format by format. Private to this
// room's readers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace viewcell {

struct PictureFacts {
  long long width_px = 0, height_px = 0;
  std::uint64_t n_bytes = 0;      ///< that hold the pixels
  std::uint64_t least_bytes = 0;  ///< the fewest in which the format can hold so many
  /// So few bytes are a lie; otherwise only more than pictures are known to take.
  bool is_law = true;
  std::uint64_t n_pictures = 1;
};

/// Bytes of a file as numbers. Reading past the end gives zeros.
class HeaderBytes {
 public:
  explicit HeaderBytes(std::string_view bytes) : bytes_(bytes) {}
  std::size_t size() const { return bytes_.size(); }
  std::uint32_t u8(std::size_t i) const {
    return i < bytes_.size() ? static_cast<unsigned char>(bytes_[i]) : 0;
  }
  std::uint32_t le16(std::size_t i) const { return u8(i) | u8(i + 1) << 8; }
  std::uint32_t le24(std::size_t i) const { return le16(i) | u8(i + 2) << 16; }
  std::uint32_t le32(std::size_t i) const { return le16(i) | le16(i + 2) << 16; }
  std::uint32_t be16(std::size_t i) const { return u8(i) << 8 | u8(i + 1); }
  std::uint32_t be32(std::size_t i) const { return be16(i) << 16 | be16(i + 2); }
  bool has_at(std::size_t i, std::string_view magic) const {
    return bytes_.size() >= i + magic.size() && bytes_.substr(i, magic.size()) == magic;
  }

 private:
  std::string_view bytes_;
};

/// Each: nothing when the file is malformed or cut. PNG: its chunks' sums are held, and its pixels
/// inflated to nowhere, for libpng prints on stderr what it finds.
std::optional<PictureFacts> png_facts(std::string_view bytes);
std::optional<PictureFacts> jpeg_facts(std::string_view bytes);
/// The first part of several, which others remark.
std::optional<PictureFacts> exr_facts(std::string_view bytes);
std::optional<PictureFacts> webp_facts(std::string_view bytes);
std::optional<PictureFacts> gif_facts(std::string_view bytes);
std::optional<PictureFacts> bmp_facts(std::string_view bytes);
/// A TGA has no magic number: the fields must fit together.
std::optional<PictureFacts> targa_facts(std::string_view bytes);
std::optional<PictureFacts> pnm_facts(std::string_view bytes);
std::optional<PictureFacts> hdr_facts(std::string_view bytes);

/// Whether a TGA says that its colours are multiplied by alpha, or that what stands in alpha's
/// place is none.
bool targa_is_multiplied(std::string_view bytes);
bool targa_has_no_alpha(std::string_view bytes);
/// The same of a BMP: bit masks, and none for alpha.
bool bmp_has_no_alpha(std::string_view bytes);

/// What of a TGA or BMP is there and not read: a fault ("" where there is none), or an alpha, by
/// name ("").
struct UnreadParts {
  std::string fault, alpha;
};
UnreadParts find_unread_of_targa(std::string_view bytes);
UnreadParts find_unread_of_bmp(std::string_view bytes);

/// The next word of a text header from i, which moves behind it; white space and comments (# to
/// the line's end) before it are passed over.
std::string next_header_word(std::string_view bytes, std::size_t& i);
/// A number of at most nine digits; -1 for anything else.
long long parse_header_number(const std::string& word);
/// 0 where a side is no side.
std::uint64_t area_of(long long width, long long height);

}  // namespace viewcell

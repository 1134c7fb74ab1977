#include "image/pnm.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "base/error.h"
#include "image/picture_facts.h"

namespace viewcell {
namespace {

struct PnmKind {
  std::uint64_t n_channels, bits;  // bits of a sample, at least
  bool has_maximum, is_text;
};

std::optional<PnmKind> kind_of_pnm(const std::string& magic) {
  if (magic == "P1") return PnmKind{1, 8, false, true};
  if (magic == "P2") return PnmKind{1, 16, true, true};  // a digit and a space
  if (magic == "P3") return PnmKind{3, 16, true, true};
  if (magic == "P4") return PnmKind{1, 1, false, false};
  if (magic == "P5") return PnmKind{1, 8, true, false};
  if (magic == "P6") return PnmKind{3, 8, true, false};
  if (magic == "PF") return PnmKind{3, 32, true, false};
  if (magic == "Pf") return PnmKind{1, 32, true, false};
  return std::nullopt;
}

struct PnmHeader {
  PnmKind kind{};
  long long width = 0, height = 0, maximum = 1;
  std::size_t n_bytes = 0;  // before the space that ends it
};

std::optional<PnmHeader> parse_header(std::string_view bytes) {
  PnmHeader header;
  std::size_t& i = header.n_bytes;
  const std::optional<PnmKind> kind = kind_of_pnm(next_header_word(bytes, i));
  if (!kind) return std::nullopt;
  header.kind = *kind;
  header.width = parse_header_number(next_header_word(bytes, i));
  header.height = parse_header_number(next_header_word(bytes, i));
  if (header.width < 0 || header.height < 0) return std::nullopt;
  if (kind->has_maximum) header.maximum = parse_header_number(next_header_word(bytes, i));
  if (!kind->is_text && kind->bits == 8 && header.maximum > 255) header.kind.bits = 16;
  return header;
}

// Samples one after another, as the file has them.
class SampleReader {
 public:
  SampleReader(std::string_view bytes, const PnmHeader& header, const std::string& file)
      : bytes_(bytes), header_(header), file_(file), at_(header.n_bytes) {
    if (!header.kind.is_text) ++at_;
  }
  std::uint32_t next() {
    if (header_.kind.is_text) return next_of_text();
    switch (header_.kind.bits) {
      case 1:
        return next_bit();
      case 8:
        return byte();
      default:
        break;
    }
    const std::uint32_t high = byte();
    return high << 8 | byte();
  }
  // Rows of bits end with their byte.
  void end_row() {
    if (n_bits_ > 0) ++at_, n_bits_ = 0;
  }

 private:
  [[noreturn]] void fail_cut() const {
    throw InputError(file_, "pixels", "has fewer samples than its size says");
  }
  std::uint32_t byte() {
    if (at_ >= bytes_.size()) fail_cut();
    return static_cast<unsigned char>(bytes_[at_++]);
  }
  std::uint32_t next_bit() {
    if (at_ >= bytes_.size()) fail_cut();
    const auto here = static_cast<unsigned char>(bytes_[at_]);
    const std::uint32_t is_black = here >> (7 - n_bits_) & 1;
    if (++n_bits_ == 8) end_row();
    return 1 - is_black;
  }
  std::uint32_t next_of_text() {
    skip_space();
    if (at_ >= bytes_.size()) fail_cut();
    const auto is_digit = [&] {
      return at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9';
    };
    if (!is_digit()) throw InputError(file_, "pixels", "a sample is not a number");
    if (!header_.kind.has_maximum) return '1' - static_cast<std::uint32_t>(bytes_[at_++]);
    std::uint32_t value = 0;
    while (is_digit()) value = std::min(value * 10 + (byte() - '0'), 100'000U);
    return value;
  }
  void skip_space() {
    for (; at_ < bytes_.size(); ++at_) {
      if (bytes_[at_] == '#')
        at_ = std::min(bytes_.find('\n', at_), bytes_.size() - 1);
      else if (std::isspace(static_cast<unsigned char>(bytes_[at_])) == 0)
        return;
    }
  }

  std::string_view bytes_;
  const PnmHeader& header_;
  const std::string& file_;
  std::size_t at_;
  int n_bits_ = 0;  // read of the byte at at_
};

}  // namespace

std::optional<PictureFacts> pnm_facts(std::string_view bytes) {
  const std::optional<PnmHeader> header = parse_header(bytes);
  if (!header) return std::nullopt;
  PictureFacts facts{header->width, header->height};
  const PnmKind& kind = header->kind;
  facts.n_bytes = bytes.size() - std::min(header->n_bytes, bytes.size());
  facts.least_bytes = area_of(facts.width_px, facts.height_px) * kind.n_channels * kind.bits / 8;
  if (kind.is_text && facts.least_bytes > 0) --facts.least_bytes;  // no space need end the last
  return facts;
}

Samples<std::uint16_t> decode_pnm(std::string_view bytes, const std::string& file) {
  const std::optional<PnmHeader> header = parse_header(bytes);
  if (!header || header->kind.bits == 32) throw InputError(file, "header", "is no PNM of integers");
  if (header->maximum < 1 || header->maximum > 65535)
    throw InputError(file, "header", "the maximum of its samples is not 1 to 65535");
  const auto maximum = static_cast<std::uint32_t>(header->maximum);
  const std::uint64_t n_row = static_cast<std::uint64_t>(header->width) * header->kind.n_channels;
  const auto height = static_cast<std::uint64_t>(header->height);
  Samples<std::uint16_t> samples{
      std::unique_ptr<std::uint16_t[]>(new std::uint16_t[n_row * height]), header->kind.n_channels};
  SampleReader reader(bytes, *header, file);
  for (std::uint64_t y = 0; y < height; ++y, reader.end_row())
    for (std::uint64_t i = 0; i < n_row; ++i) {
      const std::uint32_t x = reader.next();
      if (x > maximum) throw InputError(file, "pixels", "a sample is above the maximum");
      samples.data[y * n_row + i] =
          static_cast<std::uint16_t>((std::uint64_t{x} * 65535 + maximum / 2) / maximum);
    }
  return samples;
}

}  // namespace viewcell

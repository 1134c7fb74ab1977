#include "image/header.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "image/picture_facts.h"

namespace viewcell {
namespace {

using Facts = std::optional<PictureFacts> (*)(std::string_view);

struct FormatRow {
  ImageFormat format;
  const char* name;
  const char* extension;
  std::vector<std::string> endings;
  Facts facts;  // null: opened without allocating, and checked then
};

const std::vector<FormatRow>& format_rows() {
  static const std::vector<FormatRow> rows = {
      {ImageFormat::png, "png", ".png", {".png"}, png_facts},
      {ImageFormat::jpeg, "jpeg", ".jpg", {".jpg", ".jpeg"}, jpeg_facts},
      {ImageFormat::openexr, "openexr", ".exr", {".exr"}, exr_facts},
      {ImageFormat::tiff, "tiff", ".tif", {".tif", ".tiff"}, nullptr},
      {ImageFormat::webp, "webp", ".webp", {".webp"}, webp_facts},
      {ImageFormat::gif, "gif", ".gif", {".gif"}, gif_facts},
      {ImageFormat::bmp, "bmp", ".bmp", {".bmp"}, bmp_facts},
      {ImageFormat::targa, "targa", ".tga", {".tga"}, targa_facts},
      {ImageFormat::pnm, "pnm", ".ppm", {".ppm", ".pgm", ".pbm", ".pnm", ".pfm"}, pnm_facts},
      {ImageFormat::hdr, "hdr", ".hdr", {".hdr"}, hdr_facts}};
  return rows;
}

const FormatRow& row_of_format(ImageFormat format) {
  const std::vector<FormatRow>& rows = format_rows();
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const FormatRow& row) { return row.format == format; });
  VIEWCELL_CHECK(found != rows.end(), static_cast<int>(format));
  return *found;
}

bool is_pnm(const HeaderBytes& bytes) {
  const std::string_view kinds = "123456Ff", spaces = " \t\r\n#";
  const auto is_one_of = [&](std::string_view set, std::size_t i) {
    return set.find(static_cast<char>(bytes.u8(i))) != std::string_view::npos;
  };
  return bytes.size() > 2 && bytes.u8(0) == 'P' && is_one_of(kinds, 1) && is_one_of(spaces, 2);
}

std::optional<ImageFormat> format_of(std::string_view all) {
  using namespace std::string_view_literals;
  const HeaderBytes bytes(all);
  if (bytes.has_at(0, "\x89PNG\r\n\x1a\n"sv)) return ImageFormat::png;
  if (bytes.has_at(0, "\xff\xd8\xff"sv)) return ImageFormat::jpeg;
  if (bytes.has_at(0, "\x76\x2f\x31\x01"sv)) return ImageFormat::openexr;
  for (const std::string_view magic : {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv})
    if (bytes.has_at(0, magic)) return ImageFormat::tiff;
  if (bytes.has_at(0, "RIFF"sv) && bytes.has_at(8, "WEBP"sv)) return ImageFormat::webp;
  if (bytes.has_at(0, "GIF87a"sv) || bytes.has_at(0, "GIF89a"sv)) return ImageFormat::gif;
  if (bytes.has_at(0, "#?RADIANCE"sv) || bytes.has_at(0, "#?RGBE"sv)) return ImageFormat::hdr;
  if (bytes.has_at(0, "BM"sv) && bmp_facts(all)) return ImageFormat::bmp;
  if (is_pnm(bytes)) return ImageFormat::pnm;
  if (targa_facts(all)) return ImageFormat::targa;
  return std::nullopt;
}

// Pictures that people have and that are not read, to be called by their names.
const char* name_of_unread(std::string_view all) {
  using namespace std::string_view_literals;
  struct Magic {
    std::size_t at;
    std::string_view bytes;
    const char* name;
  };
  constexpr std::array<Magic, 12> kMagics{{{0, "DDS "sv, "DDS"},
                                           {0, "8BPS"sv, "Photoshop"},
                                           {0, "\xabKTX 11"sv, "KTX"},
                                           {0, "\xabKTX 20"sv, "KTX2"},
                                           {4, "jP  "sv, "JPEG 2000"},
                                           {0, "\xff\x0a"sv, "JPEG XL"},
                                           {4, "JXL "sv, "JPEG XL"},
                                           {4, "ftypavif"sv, "AVIF"},
                                           {4, "ftyphei"sv, "HEIC"},
                                           {4, "ftypmif1"sv, "HEIC"},
                                           {0, "P7\n"sv, "PAM"},
                                           {0, "<svg"sv, "SVG"}}};
  const HeaderBytes bytes(all);
  for (const Magic& magic : kMagics)
    if (bytes.has_at(magic.at, magic.bytes)) return magic.name;
  return nullptr;
}

[[noreturn]] void refuse_format(std::string_view bytes, const std::string& file) {
  if (const char* name = name_of_unread(bytes))
    throw InputError(file, "",
                     std::string("is not a PNG but a picture as ") + name +
                         ", which is not read: convert it to PNG");
  throw InputError(file, "",
                   "is not a PNG, JPEG, EXR, TIFF, WebP, GIF, BMP, TGA, PPM (PGM, PBM, PFM) or HDR "
                   "picture");
}

// Bits of a BMP's pixels that are other than blue, green and red upwards, 8, 5 or 5 and 6 each:
// OpenImageIO passes its masks over.
bool has_other_masks(const HeaderBytes& bytes) {
  const std::uint32_t compression = bytes.le32(30), bits = bytes.le16(28);
  if (bytes.le32(14) < 40 || (compression != 3 && compression != 6)) return false;
  const std::array<std::uint32_t, 3> masks{bytes.le32(54), bytes.le32(58), bytes.le32(62)};
  if (bits == 32) return masks != std::array<std::uint32_t, 3>{0xff0000, 0xff00, 0xff};
  return masks != std::array<std::uint32_t, 3>{0xf800, 0x7e0, 0x1f} &&
         masks != std::array<std::uint32_t, 3>{0x7c00, 0x3e0, 0x1f};
}

void check_unread(const UnreadParts& unread, const std::string& file, Remarks* remarks) {
  if (!unread.fault.empty()) throw InputError(file, "header", unread.fault);
  if (!unread.alpha.empty()) add_remark(remarks, unread.alpha + ", left out");
}

std::string size_in_words(long long width_px, long long height_px) {
  return std::to_string(width_px) + " x " + std::to_string(height_px) + " pixels";
}

void check_facts(const PictureFacts& facts, const std::string& file, const ImageLimits& limits) {
  check_image_size(facts.width_px, facts.height_px, file, limits);
  if (facts.n_bytes >= facts.least_bytes || (limits.max_pixels && !facts.is_law)) return;
  const std::string words = size_in_words(facts.width_px, facts.height_px) + " in " +
                            std::to_string(facts.n_bytes) + " bytes: ";
  throw InputError(
      file, "header",
      words + (facts.is_law ? "no file of its kind holds so many in so few, so it is "
                              "cut, or lies about its size"
                            : "so many in so few are decoded with --max-pixels alone"));
}

}  // namespace

const char* name_of(ImageFormat format) {
  return row_of_format(format).name;
}

const char* extension_of(ImageFormat format) {
  return row_of_format(format).extension;
}

const std::vector<std::string>& picture_endings() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> endings;
    for (const FormatRow& row : format_rows())
      endings.insert(endings.end(), row.endings.begin(), row.endings.end());
    return endings;
  }();
  return all;
}

void check_image_size(long long width_px, long long height_px, const std::string& file,
                      const ImageLimits& limits) {
  const std::string size = size_in_words(width_px, height_px);
  if (width_px < 1 || height_px < 1) throw InputError(file, "header", size);
  const long long most =
      limits.max_pixels ? static_cast<long long>(*limits.max_pixels) : kMaxImagePixels;
  if (width_px > most / height_px)
    throw InputError(file, "header",
                     size + ", more than " + std::to_string(most) + " in all (--max-pixels)");
}

ImageFormat check_image_header(std::string_view bytes, const std::string& file,
                               const ImageLimits& limits, Remarks* remarks) {
  const std::optional<ImageFormat> format = format_of(bytes);
  if (!format) refuse_format(bytes, file);
  const FormatRow& row = row_of_format(*format);
  if (row.facts == nullptr) return *format;
  const std::optional<PictureFacts> facts = row.facts(bytes);
  if (!facts) throw InputError(file, "header", std::string("malformed or cut ") + row.name);
  check_facts(*facts, file, limits);
  if (*format == ImageFormat::bmp && has_other_masks(HeaderBytes(bytes)))
    throw InputError(file, "header",
                     "a BMP with bit masks of its own, which are not read: convert it to PNG");
  if (*format == ImageFormat::bmp) check_unread(find_unread_of_bmp(bytes), file, remarks);
  if (*format == ImageFormat::targa) check_unread(find_unread_of_targa(bytes), file, remarks);
  add_remark(remarks, kFurtherPictures, facts->n_pictures - 1);
  return *format;
}

}  // namespace viewcell

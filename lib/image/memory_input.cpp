#include "image/memory_input.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

namespace viewcell {
namespace {

constexpr int kMaxChannels = 64;

// What a byte of a compressed file can turn into.
struct Inflation {
  const char* compression;
  std::uint64_t most;
};
constexpr std::array<Inflation, 11> kInflations{{{"none", 2},  // 2: colour may be stored coarser
                                                 {"packbits", 128},
                                                 {"rle", 128},
                                                 {"zip", 1032},
                                                 {"zips", 1032},
                                                 {"piz", 1032},
                                                 {"pxr24", 2064},
                                                 {"lzw", 4096},
                                                 {"jpeg", 4096},
                                                 {"b44", 64},
                                                 {"b44a", 64}}};
// Of any other (fax, zstd, lzma, dwaa), in which a few bytes may say any size: a guess.
constexpr std::uint64_t kLikelyInflation = 8192;

struct InflationBound {
  std::uint64_t most = 0;
  bool is_law = true;
};

InflationBound bound_inflation(const OIIO::ImageSpec& spec) {
  // "zip:4" names a level, too; a palette's colours come out as three channels of 8 bits, and a bit
  // as a byte.
  std::string name = spec.get_string_attribute("compression", "none");
  name = name.substr(0, name.find(':'));
  const auto bits =
      static_cast<std::uint64_t>(std::max(1, spec.get_int_attribute("oiio:BitsPerSample", 8)));
  const std::uint64_t widened = spec.get_int_attribute("tiff:PhotometricInterpretation") == 3 ? 24
                                : bits < 8 ? 8 / bits
                                           : 1;
  for (const Inflation& known : kInflations)
    if (name == known.compression) return {known.most * widened, true};
  return {kLikelyInflation * widened, false};
}

// What decoding would allocate, against what the file's bytes can hold.
void check_inflation(const OIIO::ImageSpec& spec, std::size_t n_file_bytes, const std::string& file,
                     const ImageLimits& limits) {
  const InflationBound bound = bound_inflation(spec);
  if (!bound.is_law && limits.max_pixels) return;
  if (spec.image_bytes(true) / bound.most > n_file_bytes)
    throw InputError(file, "header",
                     std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                         " pixels: " + std::to_string(spec.image_bytes(true)) +
                         " bytes of pixels in a file of " + std::to_string(n_file_bytes) +
                         (bound.is_law ? "" : ": decoded with --max-pixels alone"));
}

int rows_a_strip(const OIIO::ImageSpec& spec) {
  return spec.get_int_attribute("tiff:RowsPerStrip", spec.height);
}

// What the decoder will allocate, before it does.
void check_spec(const MemoryInput& picture, std::size_t n_file_bytes, const std::string& file,
                const ImageLimits& limits) {
  const OIIO::ImageSpec& spec = picture.spec;
  check_image_size(spec.width, spec.height, file, limits);
  if (spec.tile_width > 0)
    check_image_size(16LL * spec.tile_width, 16LL * spec.tile_height, file, limits);
  if (spec.depth > 1 || spec.deep) throw InputError(file, "header", "is not a flat picture");
  if (spec.nchannels < 1 || spec.nchannels > kMaxChannels)
    throw InputError(
        file, "header",
        std::to_string(spec.nchannels) + " channels, more than " + std::to_string(kMaxChannels));
  // OpenImageIO leaves rows of such as the memory was.
  if (picture.format == ImageFormat::tiff && spec.format == OIIO::TypeDesc::DOUBLE)
    throw InputError(file, "header", "has 64 bits a sample, which is not read: convert it to 32");
  const int photometric = spec.get_int_attribute("tiff:PhotometricInterpretation");
  if (picture.format == ImageFormat::tiff && photometric >= 8 && photometric <= 10)
    throw InputError(file, "header", "has its colours as CIE L*a*b*, which is not read");
  if (picture.format == ImageFormat::tiff && spec.tile_width == 0 &&
      spec.get_string_attribute("planarconfig") == "separate" &&
      spec.get_string_attribute("compression", "none") != "none" && rows_a_strip(spec) > 1)
    throw InputError(file, "header",
                     "has its channels apart and compressed, which is not read: convert it to "
                     "interleaved channels (tiffcp -p contig)");
  if (picture.format == ImageFormat::openexr || picture.format == ImageFormat::tiff)
    check_inflation(spec, n_file_bytes, file, limits);
}

void remark_spec(MemoryInput& picture, const std::string& file, Remarks* remarks) {
  const int orientation = picture.spec.get_int_attribute("Orientation", 1);
  if (orientation > 1 && orientation <= 8)
    add_remark(remarks, "orientation " + std::to_string(orientation) +
                            " (turned or mirrored for display), not followed: rows are as stored");
  for (const char* key : {"jpeg:ColorSpace", "tiff:ColorSpace"})
    if (const std::string space = picture.spec.get_string_attribute(key);
        space == "CMYK" || space == "YCbCrK")
      add_remark(remarks, space + ", taken as RGB without its profile");
  const OIIO::ImageSpec& s = picture.spec;
  if (s.x != s.full_x || s.y != s.full_y || s.width != s.full_width || s.height != s.full_height)
    add_remark(remarks, "the data window is taken alone: at " + std::to_string(s.x - s.full_x) +
                            ", " + std::to_string(s.y - s.full_y) + " of a display window of " +
                            std::to_string(s.full_width) + " x " + std::to_string(s.full_height));
  // The pictures of other formats are counted by check_image_header.
  const bool is_exr = picture.format == ImageFormat::openexr;
  if (remarks == nullptr || !(is_exr || picture.format == ImageFormat::tiff)) return;
  int n = picture.spec.get_int_attribute("oiio:subimages", 1);
  if (!is_exr) {  // TIFF does not count its pages
    constexpr int kMostCounted = 1000;
    const bool is_back = call_library(file, [&] {
      for (n = 1; n < kMostCounted && picture.input->seek_subimage(n, 0);) ++n;
      picture.input->geterror();  // that there are no more
      return picture.input->seek_subimage(0, 0);
    });
    if (!is_back) throw InputError(file, "", first_line(picture.input->geterror()));
  }
  add_remark(remarks, kFurtherPictures, static_cast<std::size_t>(std::max(n, 1) - 1));
}

}  // namespace

std::size_t BoundedReader::pread(void* to, std::size_t n, std::int64_t place) {
  if (place < 0 || static_cast<std::uint64_t>(place) >= n_bytes_) return 0;
  return IOMemReader::pread(to, std::min(n, n_bytes_ - static_cast<std::size_t>(place)), place);
}

std::size_t BoundedReader::read(void* to, std::size_t n) {
  const std::size_t n_read = pread(to, n, tell());
  seek(tell() + static_cast<std::int64_t>(n_read));
  return n_read;
}

MemoryInput open_memory(std::string_view bytes, const std::string& file, const ImageLimits& limits,
                        Remarks* remarks) {
  configure_openimageio();
  MemoryInput picture;
  picture.format = check_image_header(bytes, file, limits, remarks);
  picture.memory = std::make_unique<BoundedReader>(bytes);
  picture.input = OIIO::ImageInput::create(name_of(picture.format), false);
  if (!picture.input || !picture.input->set_ioproxy(picture.memory.get()))
    throw MachineError(std::string("OpenImageIO cannot read ") + name_of(picture.format));
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  if (!call_library(file, [&] { return picture.input->open(file, picture.spec, hints); }))
    throw InputError(file, "", first_line(picture.input->geterror()));
  check_spec(picture, bytes.size(), file, limits);
  remark_spec(picture, file, remarks);
  return picture;
}

// By rows or tiles, one at a time: OpenImageIO takes memory for whole strips, whatever their header
// says, decodes zip by itself, and takes what fails for black.
bool read_tiff(MemoryInput& picture, int n_channels, const OIIO::TypeDesc& type, char* out) {
  const OIIO::ImageSpec& spec = picture.spec;
  const bool is_tiled = spec.tile_width > 0;
  const int width = is_tiled ? spec.tile_width : spec.width,
            height = is_tiled ? spec.tile_height : 1;
  const std::size_t n_from = type.size() * static_cast<std::size_t>(spec.nchannels);
  const std::size_t n_to = type.size() * static_cast<std::size_t>(n_channels);
  const auto index = [](int x, int y, int row) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(row) +
           static_cast<std::size_t>(x);
  };
  std::vector<char> block(index(0, height, width) * n_from);
  for (int y = 0; y < spec.height; y += height)
    for (int x = 0; x < spec.width; x += width) {
      const bool is_read =
          is_tiled ? picture.input->read_tile(spec.x + x, spec.y + y, 0, type, block.data())
                   : picture.input->read_scanline(spec.y + y, 0, type, block.data());
      if (!is_read) return false;
      for (int j = 0; j < std::min(height, spec.height - y); ++j)
        for (int i = 0; i < std::min(width, spec.width - x); ++i)
          std::memcpy(out + n_to * index(x + i, y + j, spec.width),
                      block.data() + n_from * index(i, j, width), n_to);
    }
  return true;
}

}  // namespace viewcell

#include "image/index_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/version.h"
#include "image/library.h"
#include "image/memory_input.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNameOfU = "texcoord.u";
constexpr const char* kNameOfV = "texcoord.v";

// --- writing ---

std::string lower_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

ImageFormat format_by_ending(const fs::path& file) {
  const std::string ending = lower_ending(file);
  if (file == "-" || ending == ".exr") return ImageFormat::openexr;
  if (ending == ".tif" || ending == ".tiff") return ImageFormat::tiff;
  throw UsageError(file.string() + ": an indexing map is written as .exr or .tif");
}

OIIO::ImageSpec make_map_spec(const IndexMap& map, OIIO::TypeDesc type, const std::string& label) {
  OIIO::ImageSpec spec(map.width_px, map.height_px, 2, type);
  spec.channelnames = {kNameOfU, kNameOfV};
  spec.attribute("compression", "zip");
  spec.attribute("Software", std::string("viewcell ") + version());
  // Without a DateTime the writers add today's; one of the wrong type keeps them from doing so and
  // is itself not written.
  spec.attribute("DateTime", 0);
  if (!label.empty()) spec.attribute("ImageDescription", label);
  return spec;
}

std::vector<unsigned char> encode(const OIIO::ImageSpec& spec, ImageFormat format,
                                  const void* samples) {
  configure_openimageio();
  std::vector<unsigned char> bytes;
  bytes.reserve(spec.image_bytes());  // what is not written to takes no memory; growing takes twice
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(name_of(format), &memory);
  if (!output) throw MachineError(std::string("OpenImageIO cannot write ") + name_of(format));
  const bool written = output->open(std::string("memory") + extension_of(format), spec) &&
                       output->write_image(spec.format, samples);
  if (!output->close() || !written)
    throw MachineError("encoding an indexing map: " + first_line(output->geterror()));
  return bytes;
}

std::uint16_t code_of(float coordinate) {
  return static_cast<std::uint16_t>(std::lround(65535 * std::clamp(double(coordinate), 0.0, 1.0)));
}

std::vector<unsigned char> encode_map(const IndexMap& map, ImageFormat format,
                                      const std::string& label) {
  if (format == ImageFormat::openexr)
    return encode(make_map_spec(map, OIIO::TypeFloat, label), format, map.pixels.data());
  std::vector<std::uint16_t> codes;
  codes.reserve(2 * map.pixels.size());
  for (const glm::vec2& uv : map.pixels) codes.insert(codes.end(), {code_of(uv.x), code_of(uv.y)});
  return encode(make_map_spec(map, OIIO::TypeUInt16, label), format, codes.data());
}

// --- reading ---

[[noreturn]] void refuse_channels(const OIIO::ImageSpec& spec, const std::string& file) {
  std::string names;
  for (const std::string& name : spec.channelnames) names += (names.empty() ? "" : ", ") + name;
  throw InputError(file, "header",
                   "has channels " + names + " of " + spec.format.c_str() +
                       ", not two of an indexing map: a TIFF of 8 or 16 bits, or an EXR with " +
                       kNameOfU + " and " + kNameOfV + " as float");
}

void check_map_spec(const MemoryInput& picture, const std::string& file) {
  const OIIO::ImageSpec& spec = picture.spec;
  const OIIO::TypeDesc type = spec.format;
  bool right = spec.nchannels == 2;
  if (picture.format == ImageFormat::tiff)
    right = right && (type == OIIO::TypeUInt16 || type == OIIO::TypeUInt8);
  else if (picture.format == ImageFormat::openexr)
    right = right && spec.channelformats.empty() && type == OIIO::TypeFloat &&
            spec.channelnames == std::vector<std::string>{kNameOfU, kNameOfV};
  else
    throw InputError(file, "", "is not a TIFF or EXR picture, as indexing maps are");
  if (!right) refuse_channels(spec, file);
}

template <typename Sample, typename Convert>
IndexMap gather_map(MemoryInput& picture, const std::string& file, const Convert& convert) {
  const Samples<Sample> samples = decode<Sample>(picture, 2, file);
  IndexMap map(picture.spec.width, picture.spec.height);
  for (std::size_t p = 0; p < map.pixels.size(); ++p)
    map.pixels[p] = {convert(samples.pixel(p)[0]), convert(samples.pixel(p)[1])};
  return map;
}

void check_numbers(const IndexMap& map, const std::string& file) {
  constexpr float kMost = 1e30f;  // between such numbers samples stay finite
  for (int y = 0; y < map.height_px; ++y)
    for (int x = 0; x < map.width_px; ++x)
      if (const glm::vec2& uv = map.at(x, y);
          !(std::abs(uv.x) <= kMost) || !(std::abs(uv.y) <= kMost))
        throw InputError(file, "texel " + std::to_string(x) + ", " + std::to_string(y),
                         "holds a number that is not finite, or beyond 1e30");
}

}  // namespace

void write_index_map(const fs::path& file, const IndexMap& map, const std::string& label) {
  VIEWCELL_CHECK(!map.empty());
  for (const glm::vec2& uv : map.pixels)
    VIEWCELL_CHECK(std::isfinite(uv.x) && std::isfinite(uv.y), uv.x, uv.y);
  const std::vector<unsigned char> bytes = encode_map(map, format_by_ending(file), label);
  write_file(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

IndexMap read_index_map(const fs::path& path, std::string* hash, std::string* label,
                        const ImageLimits& limits) {
  const std::string file = path.string();
  const std::string bytes = read_file(path, kMaxImageFileBytes);
  MemoryInput picture = open_memory(bytes, file, limits);
  check_map_spec(picture, file);
  if (hash != nullptr) *hash = hash_hex(bytes);
  if (label != nullptr) *label = picture.spec.get_string_attribute("ImageDescription");
  if (picture.format == ImageFormat::tiff)  // 8 bits come out as 257 times their code
    return gather_map<std::uint16_t>(
        picture, file, [](std::uint16_t x) { return static_cast<float>(x / 65535.0); });
  IndexMap map = gather_map<float>(picture, file, [](float x) { return x; });
  check_numbers(map, file);
  return map;
}

}  // namespace viewcell

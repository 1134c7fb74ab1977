#include "formats/gltf_buffers.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "base/error.h"
#include "base/file.h"
#include "formats/byte_cursor.h"

namespace viewcell {
namespace {

constexpr std::int64_t kMostBufferBytes = 1LL << 40;

// ---- the file's parts ----

struct Parts {
  std::string_view json, binary;
  bool is_binary = false;
};

Parts split_parts(std::string_view bytes, const std::string& file) {
  if (!bytes.starts_with("glTF")) return {bytes, {}, false};
  constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;
  ByteCursor cursor(bytes, file);
  cursor.take(4);
  if (const auto version = cursor.read<std::uint32_t>(); version != 2)
    cursor.fail("glTF version " + std::to_string(version) + "; only version 2 is read");
  if (cursor.read<std::uint32_t>() > bytes.size()) cursor.fail("the file ends too early");
  Parts parts{{}, {}, true};
  const auto n_json = cursor.read<std::uint32_t>();
  if (cursor.read<std::uint32_t>() != kJsonChunk) cursor.fail("the first chunk is not JSON");
  parts.json = cursor.take(n_json);
  if (cursor.bytes_left() < 8) return parts;
  const auto n_binary = cursor.read<std::uint32_t>();
  if (cursor.read<std::uint32_t>() == kBinaryChunk) parts.binary = cursor.take(n_binary);
  return parts;
}

// Extensions that leave positions and faces as the core says, or that this room reads.
bool is_harmless(const std::string& extension) {
  static constexpr std::string_view kHarmless[] = {"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                                   "KHR_lights_", "KHR_mesh_quantization"};
  return std::any_of(std::begin(kHarmless), std::end(kHarmless),
                     [&](std::string_view prefix) { return extension.starts_with(prefix); });
}

void check_header(const JsonCursor& root) {
  const std::string version = root.at("asset").at("version").string();
  if (!version.starts_with("2."))
    root.at("asset").at("version").fail("version " + version + "; only version 2 is read");
  if (!root.has("extensionsRequired")) return;
  const JsonCursor required = root.at("extensionsRequired");
  for (std::size_t i = 0; i < required.size(); ++i)
    if (const std::string name = required.at(i).string(); !is_harmless(name))
      required.at(i).fail("the extension " + name + " is not read; export without it");
}

// ---- buffers ----

std::string decode_base64(std::string_view text, const JsonCursor& place) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  std::uint32_t bits = 0;
  int n_bits = 0;
  for (const char c : text) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) place.fail("not valid base64");
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    n_bits += 6;
    if (n_bits < 8) continue;
    n_bits -= 8;
    out += static_cast<char>(bits >> n_bits & 0xff);
  }
  return out;
}

std::string decode_percent(const std::string& uri) {
  static constexpr std::string_view kDigits = "0123456789abcdef";
  const auto digit = [](char c) { return kDigits.find(static_cast<char>(std::tolower(c))); };
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool is_code = uri[i] == '%' && i + 2 < uri.size() &&
                         digit(uri[i + 1]) != std::string_view::npos &&
                         digit(uri[i + 2]) != std::string_view::npos;
    out += is_code ? static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2])) : uri[i];
    if (is_code) i += 2;
  }
  return out;
}

std::string load_uri(const JsonCursor& place) {
  const std::string uri = place.string();
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(";base64,");
    if (comma == std::string::npos) place.fail("a data URI that is not base64");
    return decode_base64(std::string_view(uri).substr(comma + 8), place);
  }
  return read_file(resolve_inside(place.file(), place.place(), decode_percent(uri)));
}

void load_buffers(const Parts& parts, GltfFile& gltf) {
  if (!gltf.root().has("buffers")) return;
  const JsonCursor buffers = gltf.root().at("buffers");
  for (std::size_t i = 0; i < buffers.size(1024); ++i) {
    const JsonCursor buffer = buffers.at(i);
    if (buffer.has("uri"))
      gltf.buffers.push_back(load_uri(buffer.at("uri")));
    else if (i == 0 && parts.is_binary)
      gltf.buffers.emplace_back(parts.binary);
    else
      buffer.fail("has no \"uri\"");
    const std::int64_t n_bytes = buffer.at("byteLength").integer(1, kMostBufferBytes);
    if (static_cast<std::uint64_t>(n_bytes) > gltf.buffers.back().size())
      buffer.fail("says " + std::to_string(n_bytes) + " bytes and has " +
                  std::to_string(gltf.buffers.back().size()));
  }
}

// ---- accessors ----

// Elements of an accessor, inside a buffer.
struct Elements {
  const char* first = nullptr;
  std::size_t count = 0, stride = 0, n_components = 0;
  std::int64_t component_type = 0;
  bool normalized = false;
};

std::size_t component_bytes(const JsonCursor& accessor) {
  switch (accessor.at("componentType").integer(0, 1 << 20)) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      accessor.at("componentType").fail("is no component type of glTF");
  }
}

JsonCursor accessor_at(const GltfFile& gltf, std::int64_t id) {
  return gltf.root().at("accessors").at(static_cast<std::size_t>(id));
}

std::int64_t optional_integer(const JsonCursor& object, const char* key, std::int64_t fallback) {
  return object.has(key) ? object.at(key).integer(0, kMostBufferBytes) : fallback;
}

JsonCursor view_at(const GltfFile& gltf, std::int64_t id) {
  return gltf.root().at("bufferViews").at(static_cast<std::size_t>(id));
}

std::string_view bytes_of_view(const GltfFile& gltf, const JsonCursor& view) {
  const auto buffer_id = static_cast<std::size_t>(view.at("buffer").integer(0, 1 << 30));
  if (buffer_id >= gltf.buffers.size()) view.at("buffer").fail("no such buffer");
  const auto start = static_cast<std::size_t>(optional_integer(view, "byteOffset", 0));
  const auto n_bytes = static_cast<std::size_t>(view.at("byteLength").integer(1, kMostBufferBytes));
  const std::string_view buffer = gltf.buffers[buffer_id];
  if (start + n_bytes > buffer.size()) view.fail("is past its buffer's end");
  return buffer.substr(start, n_bytes);
}

Elements locate(const GltfFile& gltf, std::int64_t id) {
  const JsonCursor accessor = accessor_at(gltf, id);
  if (accessor.has("sparse")) accessor.fail("sparse accessors are not read");
  if (!accessor.has("bufferView"))
    accessor.fail("has no \"bufferView\" (compressed meshes are not read)");
  Elements e;
  e.count = static_cast<std::size_t>(accessor.at("count").integer(1, 0xffffffff));
  e.component_type = accessor.at("componentType").integer(0, 1 << 20);
  e.n_components = accessor_components(gltf, id);
  e.normalized = accessor.has("normalized") && accessor.at("normalized").boolean();
  const std::size_t element_bytes = e.n_components * component_bytes(accessor);

  const std::int64_t view_id = accessor.at("bufferView").integer(0, 1 << 30);
  const JsonCursor view = view_at(gltf, view_id);
  const std::string_view bytes = bytes_of_view(gltf, view);
  e.stride = static_cast<std::size_t>(
      optional_integer(view, "byteStride", static_cast<std::int64_t>(element_bytes)));
  if (e.stride < element_bytes || e.stride > 65536) view.at("byteStride").fail("is out of range");
  const auto start = static_cast<std::size_t>(optional_integer(accessor, "byteOffset", 0));
  if (start + (e.count - 1) * e.stride + element_bytes > bytes.size())
    accessor.fail("is past its buffer view's end");
  e.first = bytes.data() + start;
  return e;
}

template <typename T>
void gather(const Elements& e, std::vector<float>& out) {
  const float scale =
      e.normalized ? 1.0f / static_cast<float>(std::numeric_limits<T>::max()) : 1.0f;
  for (std::size_t i = 0; i < e.count; ++i)
    for (std::size_t k = 0; k < e.n_components; ++k) {
      T value;
      std::memcpy(&value, e.first + i * e.stride + k * sizeof(T), sizeof(T));
      const float x = static_cast<float>(value) * scale;
      out.push_back(e.normalized ? std::max(x, -1.0f) : x);
    }
}

}  // namespace

GltfFile parse_gltf_file(std::string_view bytes, const std::filesystem::path& file) {
  const Parts parts = split_parts(bytes, file.string());
  GltfFile gltf;
  gltf.file = file;
  gltf.json = parse_json(std::string(parts.json), file);
  check_header(gltf.root());
  load_buffers(parts, gltf);
  return gltf;
}

std::string read_image_bytes(const GltfFile& gltf, std::int64_t id) {
  const JsonCursor image = gltf.root().at("images").at(static_cast<std::size_t>(id));
  if (image.has("uri")) return load_uri(image.at("uri"));
  const std::int64_t view_id = image.at("bufferView").integer(0, 1 << 30);
  return std::string(bytes_of_view(gltf, view_at(gltf, view_id)));
}

std::size_t accessor_components(const GltfFile& gltf, std::int64_t id) {
  const JsonCursor type = accessor_at(gltf, id).at("type");
  const std::string name = type.string();
  if (name == "SCALAR") return 1;
  for (std::size_t n = 2; n <= 4; ++n)
    if (name == "VEC" + std::to_string(n)) return n;
  type.fail("expected SCALAR, VEC2, VEC3 or VEC4");
}

std::vector<float> read_float_accessor(const GltfFile& gltf, std::int64_t id,
                                       std::size_t n_components) {
  Elements e = locate(gltf, id);
  if (e.n_components != n_components)
    accessor_at(gltf, id).fail("expected " + std::to_string(n_components) + " components");
  std::vector<float> out;
  out.reserve(e.count * n_components);
  switch (e.component_type) {
    case 5120:
      gather<std::int8_t>(e, out);
      break;
    case 5121:
      gather<std::uint8_t>(e, out);
      break;
    case 5122:
      gather<std::int16_t>(e, out);
      break;
    case 5123:
      gather<std::uint16_t>(e, out);
      break;
    case 5125:
      gather<std::uint32_t>(e, out);
      break;
    default:
      e.normalized = false;
      gather<float>(e, out);
  }
  return out;
}

std::vector<std::uint32_t> read_index_accessor(const GltfFile& gltf, std::int64_t id) {
  const Elements e = locate(gltf, id);
  const JsonCursor accessor = accessor_at(gltf, id);
  const std::int64_t type = e.component_type;
  if (e.n_components != 1 || (type != 5121 && type != 5123 && type != 5125))
    accessor.fail("indices must be unsigned scalars");
  std::vector<std::uint32_t> out(e.count, 0);
  for (std::size_t i = 0; i < e.count; ++i)  // little-endian: the low bytes stand first
    std::memcpy(&out[i], e.first + i * e.stride, component_bytes(accessor));
  return out;
}

}  // namespace viewcell

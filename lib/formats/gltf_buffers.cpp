#include "formats/gltf_buffers.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "base/file.h"
#include "formats/byte_cursor.h"
#include "formats/gltf_meshopt.h"

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

// ---- extensions ----

// Of names, by how they begin: what this room applies, and what has no part in positions, faces,
// colours of vertices and texture coordinates.
constexpr std::string_view kApplied[] = {"KHR_texture_transform",
                                         "KHR_mesh_quantization",
                                         "EXT_mesh_gpu_instancing",
                                         "KHR_draco_mesh_compression",
                                         "EXT_meshopt_compression",
                                         "KHR_meshopt_compression",
                                         "KHR_node_visibility",
                                         "KHR_texture_",
                                         "EXT_texture_"};
constexpr std::string_view kHarmless[] = {
    "KHR_materials_",    "KHR_lights_",           "EXT_lights_",
    "KHR_xmp",           "KHR_animation_pointer", "EXT_structural_metadata",
    "EXT_mesh_features", "EXT_instance_features", "KHR_audio"};

bool is_known(const std::string& extension) {
  const auto starts = [&](std::string_view prefix) { return extension.starts_with(prefix); };
  return std::any_of(std::begin(kApplied), std::end(kApplied), starts) ||
         std::any_of(std::begin(kHarmless), std::end(kHarmless), starts);
}

void check_header(const JsonCursor& root, Remarks* remarks) {
  const std::string version = root.at("asset").at("version").string();
  if (!version.starts_with("2."))
    root.at("asset").at("version").fail("version " + version + "; only version 2 is read");
  const auto each_unknown = [&](const char* key, const auto& call) {
    if (!root.has(key)) return;
    const JsonCursor names = root.at(key);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (const std::string name = names.at(i).string(); !is_known(name)) call(names.at(i), name);
  };
  each_unknown("extensionsRequired", [](const JsonCursor& at, const std::string& name) {
    at.fail("the extension " + name + " is not read; export without it");
  });
  each_unknown("extensionsUsed", [&](const JsonCursor&, const std::string& name) {
    add_remark(remarks, "the extension " + name + ", not applied");
  });
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

// A file that several buffers name is loaded once.
std::string_view load_buffer(const JsonCursor& uri, GltfFile& gltf) {
  const auto [found, is_new] = gltf.loaded.try_emplace(uri.string());
  if (is_new) {
    found->second = load_uri(uri);
    gltf.n_bytes += found->second.size();
  }
  return found->second;
}

// The extension by which views are compressed, where object has it.
std::optional<JsonCursor> meshopt_extension(const JsonCursor& object) {
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
    if (has_extension(object, name)) return extension_of(object, name);
  return std::nullopt;
}

bool is_fallback(const JsonCursor& buffer) {
  const auto extension = meshopt_extension(buffer);
  return extension && extension->has("fallback") && extension->at("fallback").boolean();
}

void load_buffers(const Parts& parts, GltfFile& gltf) {
  if (!gltf.root().has("buffers")) return;
  const JsonCursor buffers = gltf.root().at("buffers");
  for (std::size_t i = 0; i < buffers.size(1024); ++i) {
    const JsonCursor buffer = buffers.at(i);
    gltf.buffers.emplace_back();
    if (is_fallback(buffer)) continue;  // what it would hold is decoded
    if (buffer.has("uri"))
      gltf.buffers.back() = load_buffer(buffer.at("uri"), gltf);
    else if (i == 0 && parts.is_binary)
      gltf.buffers.back() = parts.binary;
    else
      buffer.fail("has no \"uri\"");
    const std::int64_t n_bytes = buffer.at("byteLength").integer(1, kMostBufferBytes);
    if (static_cast<std::uint64_t>(n_bytes) > gltf.buffers.back().size())
      buffer.fail("says " + std::to_string(n_bytes) + " bytes and has " +
                  std::to_string(gltf.buffers.back().size()));
  }
}

// ---- views ----

// `place` is a view, or the extension of one: both have the keys.
std::string_view bytes_at(const GltfFile& gltf, const JsonCursor& place) {
  const auto buffer_id = static_cast<std::size_t>(gltf_index(place.at("buffer")));
  if (buffer_id >= gltf.buffers.size()) place.at("buffer").fail("no such buffer");
  const std::int64_t start =
      place.has("byteOffset") ? place.at("byteOffset").integer(0, kMostBufferBytes) : 0;
  const std::int64_t n_bytes = place.at("byteLength").integer(1, kMostBufferBytes);
  const std::string_view buffer = gltf.buffers[buffer_id];
  if (static_cast<std::size_t>(start + n_bytes) > buffer.size())
    place.fail("is past its buffer's end");
  return buffer.substr(static_cast<std::size_t>(start), static_cast<std::size_t>(n_bytes));
}

// Views of a file that means no harm share no bytes: together they hold 64 times its own at most.
GltfFile::Decoded decode_view(const GltfFile& gltf, const JsonCursor& extension) {
  const std::string_view packed = bytes_at(gltf, extension);
  const std::uint64_t most = 64 * gltf.n_bytes - std::min(64 * gltf.n_bytes, gltf.n_decoded);
  const MeshoptView view = read_meshopt_view(extension, packed.size(), most);
  gltf.n_decoded += view.count * view.stride;
  return {decode_meshopt(view, packed, extension), view.mode == "ATTRIBUTES" ? view.stride : 0};
}

}  // namespace

GltfFile parse_gltf_file(std::string_view bytes, const std::filesystem::path& file,
                         Remarks* remarks) {
  const Parts parts = split_parts(bytes, file.string());
  GltfFile gltf;
  gltf.file = file;
  gltf.n_bytes = bytes.size();
  gltf.json = parse_json(std::string(parts.json), file);
  check_header(gltf.root(), remarks);
  load_buffers(parts, gltf);
  return gltf;
}

GltfView read_view(const GltfFile& gltf, std::int64_t id) {
  const JsonCursor view = gltf.root().at("bufferViews").at(static_cast<std::size_t>(id));
  if (const auto extension = meshopt_extension(view)) {
    auto found = gltf.decoded.find(id);
    if (found == gltf.decoded.end())
      found = gltf.decoded.emplace(id, decode_view(gltf, *extension)).first;
    return {found->second.bytes, found->second.stride};
  }
  const std::int64_t stride =
      view.has("byteStride") ? view.at("byteStride").integer(1, 65536) : std::int64_t{0};
  return {bytes_at(gltf, view), static_cast<std::size_t>(stride)};
}

std::string read_image_bytes(const GltfFile& gltf, std::int64_t id) {
  const JsonCursor image = gltf.root().at("images").at(static_cast<std::size_t>(id));
  if (image.has("uri")) return load_uri(image.at("uri"));
  return std::string(read_view(gltf, gltf_index(image.at("bufferView"))).bytes);
}

std::int64_t gltf_index(const JsonCursor& value) {
  return value.integer(0, 1 << 30);
}

std::int64_t optional_gltf_index(const JsonCursor& object, const char* key) {
  return object.has(key) ? gltf_index(object.at(key)) : -1;
}

bool has_extension(const JsonCursor& object, const char* name) {
  return object.has("extensions") && object.at("extensions").has(name);
}

JsonCursor extension_of(const JsonCursor& object, const char* name) {
  return object.at("extensions").at(name);
}

}  // namespace viewcell

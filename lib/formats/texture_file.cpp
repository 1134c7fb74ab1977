#include "formats/texture_file.h"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "formats/gltf_buffers.h"
#include "image/io.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

struct Slot {
  const char* name;
  const char* key;  // in the material
  bool in_pbr;      // under "pbrMetallicRoughness"
};
constexpr std::array<Slot, 5> kSlots{{{"baseColor", "baseColorTexture", true},
                                      {"normal", "normalTexture", false},
                                      {"emissive", "emissiveTexture", false},
                                      {"occlusion", "occlusionTexture", false},
                                      {"metallicRoughness", "metallicRoughnessTexture", true}}};

bool ends_as_gltf(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name.ends_with(".glb") || name.ends_with(".gltf");
}

// Where the #SLOT begins; npos when there is none. A file that has the whole name is that file.
std::size_t find_slot(const std::string& name) {
  const std::size_t mark = name.rfind('#');
  if (mark == std::string::npos || !ends_as_gltf(name.substr(0, mark))) return std::string::npos;
  std::error_code ignored;
  return fs::exists(name, ignored) ? std::string::npos : mark;
}

const Slot& slot_of(const std::string& name) {
  const std::size_t mark = find_slot(name);
  if (mark == std::string::npos) return kSlots[0];
  std::string known;
  for (const Slot& slot : kSlots) {
    if (name.substr(mark + 1) == slot.name) return slot;
    known += (known.empty() ? "" : ", ") + std::string(slot.name);
  }
  throw InputError(name, "", "is no texture's name: after # stands one of " + known);
}

// The materials that faces have, each once, in order.
std::set<std::int64_t> used_materials(const JsonCursor& root) {
  std::set<std::int64_t> used;
  if (!root.has("meshes")) return used;
  const JsonCursor meshes = root.at("meshes");
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const JsonCursor primitives = meshes.at(m).at("primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p)
      if (primitives.at(p).has("material"))
        used.insert(primitives.at(p).at("material").integer(0, 1 << 30));
  }
  return used;
}

void check_coordinates(const JsonCursor& info) {
  if (info.has("texCoord") && info.at("texCoord").integer(0, 1 << 30) != 0)
    info.at("texCoord").fail("only texture coordinates 0 are read");
  if (info.has("extensions") && info.at("extensions").has("KHR_texture_transform"))
    info.fail("KHR_texture_transform is not read; export without it");
}

// The number of the picture behind a texture: PNG or JPEG, or else WebP by its extension.
std::int64_t image_of_texture(const JsonCursor& texture) {
  if (texture.has("source")) return texture.at("source").integer(0, 1 << 30);
  if (texture.has("extensions") && texture.at("extensions").has("EXT_texture_webp"))
    return texture.at("extensions").at("EXT_texture_webp").at("source").integer(0, 1 << 30);
  texture.fail("has no picture that is read: PNG, JPEG or WebP");
}

// The picture of a material's slot; -1 when it has none.
std::int64_t image_of_material(const JsonCursor& root, std::int64_t id, const Slot& slot) {
  JsonCursor place = root.at("materials").at(static_cast<std::size_t>(id));
  if (slot.in_pbr) {
    if (!place.has("pbrMetallicRoughness")) return -1;
    place = place.at("pbrMetallicRoughness");
  }
  if (!place.has(slot.key)) return -1;
  const JsonCursor info = place.at(slot.key);
  check_coordinates(info);
  const std::int64_t texture = info.at("index").integer(0, 1 << 30);
  return image_of_texture(root.at("textures").at(static_cast<std::size_t>(texture)));
}

ImageRgba8 decode_gltf_texture(std::string_view bytes, const fs::path& file, const Slot& slot,
                               const ReadImageOptions& options) {
  const GltfFile gltf = parse_gltf_file(bytes, file);
  std::set<std::int64_t> images;
  for (const std::int64_t material : used_materials(gltf.root()))
    if (const std::int64_t image = image_of_material(gltf.root(), material, slot); image >= 0)
      images.insert(image);
  const std::string words = std::string("in the slot ") + slot.name;
  if (images.empty()) throw InputError(file.string(), "materials", "none has a texture " + words);
  if (images.size() > 1)
    throw InputError(file.string(), "materials",
                     "have " + std::to_string(images.size()) + " different pictures " + words +
                         "; one is drawn at a time");
  const std::int64_t image = *images.begin();
  return decode_image_rgba8(read_image_bytes(gltf, image),
                            file.string() + ": images[" + std::to_string(image) + "]", options);
}

}  // namespace

fs::path texture_file(const std::string& name) {
  return name.substr(0, find_slot(name));
}

ImageRgba8 read_texture(const std::string& name, std::string* hash,
                        const ReadImageOptions& options) {
  const fs::path file = texture_file(name);
  const Slot& slot = slot_of(name);
  const std::string bytes = read_file(file);
  if (hash != nullptr) *hash = hash_hex(bytes);
  if (bytes.starts_with("glTF") || ends_as_gltf(file.string()))
    return decode_gltf_texture(bytes, file, slot, options);
  return decode_image_rgba8(bytes, file.string(), options);
}

}  // namespace viewcell

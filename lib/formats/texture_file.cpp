#include "formats/texture_file.h"

#include <algorithm>
#include <set>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "formats/gltf_materials.h"
#include "image/io.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

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

GltfSlot slot_of(const std::string& name) {
  const std::size_t mark = find_slot(name);
  if (mark == std::string::npos) return GltfSlot::base_color;
  std::string known;
  for (const GltfSlot slot : kGltfSlots) {
    if (name.substr(mark + 1) == name_of(slot)) return slot;
    known += (known.empty() ? "" : ", ") + std::string(name_of(slot));
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
        used.insert(gltf_index(primitives.at(p).at("material")));
  }
  return used;
}

// The picture of a material's slot; -1 when it has none.
std::int64_t image_of_material(const JsonCursor& root, std::int64_t id, GltfSlot slot) {
  const JsonCursor material = root.at("materials").at(static_cast<std::size_t>(id));
  const std::optional<GltfTextureUse> use = texture_of(material, slot);
  if (!use) return -1;
  if (use->texcoords != leading_texture(material)->texcoords)
    material.fail(std::string("its texture in the slot ") + name_of(slot) +
                  " has other texture coordinates, or moves them otherwise, than that of its "
                  "colour, with which meshes are read");
  return image_of_texture(root, use->texture);
}

ImageRgba8 decode_gltf_texture(std::string_view bytes, const fs::path& file, GltfSlot slot,
                               const ReadImageOptions& options) {
  const GltfFile gltf = parse_gltf_file(bytes, file);
  std::set<std::int64_t> images;
  for (const std::int64_t material : used_materials(gltf.root()))
    if (const std::int64_t image = image_of_material(gltf.root(), material, slot); image >= 0)
      images.insert(image);
  const std::string words = std::string("in the slot ") + name_of(slot);
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
  const GltfSlot slot = slot_of(name);
  const std::string bytes = read_file(file);
  if (hash != nullptr) *hash = hash_hex(bytes);
  if (bytes.starts_with("glTF") || ends_as_gltf(file.string()))
    return decode_gltf_texture(bytes, file, slot, options);
  return decode_image_rgba8(bytes, file.string(), options);
}

}  // namespace viewcell

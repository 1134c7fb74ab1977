#include "formats/texture_file.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <set>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "formats/gltf_materials.h"
#include "formats/model_pictures.h"
#include "image/io.h"
#include "image/jpeg.h"

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

// The one picture of all its materials.
ImageRgba8 decode_obj_texture(std::string_view bytes, const fs::path& file,
                              const ReadImageOptions& options, int* lossy_quality) {
  const MaterialPictures model = read_obj_pictures(bytes, file);
  for (const Remark& remark : model.remarks) add_remark(options.remarks, remark.what, remark.count);
  const std::size_t n = count_colors(model);
  if (n != 1)
    throw InputError(file.string(), "",
                     n == 0 ? "none of its materials has a picture (map_Kd)"
                            : "its materials have " + std::to_string(n) +
                                  " different pictures (map_Kd); one is drawn at a time");
  return decode_texture(model.pictures[0], options, lossy_quality);
}

ImageRgba8 decode_gltf_texture(std::string_view bytes, const fs::path& file, GltfSlot slot,
                               const ReadImageOptions& options, int* lossy_quality) {
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
  return decode_texture(
      {read_image_bytes(gltf, image), file.string() + ": images[" + std::to_string(image) + "]"},
      options, lossy_quality);
}

// WebP: the chunk of its picture is VP8L where nothing is lost. It stands first, or, in an extended
// file (VP8X), behind others.
bool is_lossy_webp(std::string_view bytes) {
  if (!bytes.starts_with("RIFF") || bytes.size() < 20 || bytes.substr(8, 4) != "WEBP") return false;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::string_view name = bytes.substr(at, 4);
    if (name == "VP8 " || name == "VP8L") return name == "VP8 ";
    std::uint32_t n_bytes = 0;
    std::memcpy(&n_bytes, bytes.data() + at + 4, sizeof n_bytes);
    at += 8 + std::size_t{n_bytes} + n_bytes % 2;
  }
  return false;
}

// 0: nothing was lost when these bytes were stored.
int measure_lossy_quality(std::string_view bytes) {
  constexpr int kUsual = 90;  // where the file does not say
  if (!bytes.starts_with("\xff\xd8\xff")) return is_lossy_webp(bytes) ? kUsual : 0;
  const int measured = measure_jpeg_quality(bytes);
  return measured > 0 ? measured : kUsual;
}

}  // namespace

fs::path texture_file(const std::string& name) {
  return name.substr(0, find_slot(name));
}

ImageRgba8 decode_texture(const ModelPicture& picture, const ReadImageOptions& options,
                          int* lossy_quality) {
  ImageRgba8 image = decode_image_rgba8(picture.bytes, picture.name, options);
  if (lossy_quality != nullptr)
    *lossy_quality = is_opaque(image) ? measure_lossy_quality(picture.bytes) : 0;
  return image;
}

ImageRgba8 read_texture(const std::string& name, std::string* hash, const ReadImageOptions& options,
                        int* lossy_quality) {
  const fs::path file = texture_file(name);
  const GltfSlot slot = slot_of(name);
  std::string bytes = read_file(file);
  if (hash != nullptr) *hash = hash_hex(bytes);
  if (bytes.starts_with("glTF") || ends_as_gltf(file.string()))
    return decode_gltf_texture(bytes, file, slot, options, lossy_quality);
  if (has_material_pictures(file)) return decode_obj_texture(bytes, file, options, lossy_quality);
  return decode_texture({std::move(bytes), file.string()}, options, lossy_quality);
}

}  // namespace viewcell

#include "formats/texture_list.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "base/error.h"
#include "base/file.h"
#include "formats/gltf_buffers.h"
#include "formats/model_pictures.h"
#include "formats/mtl.h"
#include "image/picture_size.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

// Calls get(), which gives a picture's bytes, and sets the size, or the fault.
template <typename GetBytes>
void measure_listed(const GetBytes& get, ListedTexture& texture) {
  try {
    const PictureSize size = measure_picture(get(), texture.name);
    texture.format = name_of(size.format);
    texture.width_px = size.width_px, texture.height_px = size.height_px;
  } catch (const InputError& error) {
    texture.fault = error.what();
  }
}

// A picture beside the mesh, listed once, with all that use it.
void add_file(const fs::path& mesh_file, const std::string& name, const std::string& use,
              std::vector<ListedTexture>& textures) {
  const auto found = std::find_if(textures.begin(), textures.end(),
                                  [&](const ListedTexture& t) { return t.name == name; });
  if (found != textures.end()) {
    found->used_by += (found->used_by.empty() || use.empty() ? "" : ", ") + use;
    return;
  }
  ListedTexture texture{name, use, "", 0, 0, ""};
  measure_listed([&] { return read_file(resolve_inside(mesh_file, "", name)); }, texture);
  textures.push_back(std::move(texture));
}

// --- OBJ ---

void list_library(const fs::path& obj, const std::string& name,
                  std::vector<ListedTexture>& textures) {
  std::string library;
  try {
    library = read_file(resolve_inside(obj, "mtllib", name));
  } catch (const InputError&) {
    return;  // absent, as for read_mesh
  }
  for (const MtlMaterial& material : parse_mtl(library))
    for (const MtlMap& map : material.maps)
      add_file(obj, map.file, map.keyword + " of '" + material.name + "'", textures);
}

std::vector<ListedTexture> list_of_obj(const fs::path& obj) {
  std::vector<ListedTexture> textures;
  for (const std::string& line : find_mtl_names(read_file(obj)).libraries)
    for (const std::string& name : split_words(line)) list_library(obj, name, textures);
  return textures;
}

// --- PLY ---

std::vector<ListedTexture> list_of_ply(const fs::path& ply) {
  constexpr std::string_view kKey = "comment TextureFile ";
  std::vector<ListedTexture> textures;
  std::istringstream stream(read_file(ply));
  for (std::string line; std::getline(stream, line) && !line.starts_with("end_header");) {
    while (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.starts_with(kKey)) add_file(ply, line.substr(kKey.size()), "", textures);
  }
  return textures;
}

// --- glTF ---

struct GltfUse {
  const char* slot;
  const char* key;
  bool in_pbr;
};
constexpr std::array<GltfUse, 5> kGltfUses{{{"baseColor", "baseColorTexture", true},
                                            {"metallicRoughness", "metallicRoughnessTexture", true},
                                            {"normal", "normalTexture", false},
                                            {"emissive", "emissiveTexture", false},
                                            {"occlusion", "occlusionTexture", false}}};

// The number of the picture of a slot; -1 when there is none.
std::int64_t image_of_use(const JsonCursor& root, JsonCursor place, const GltfUse& use) {
  if (use.in_pbr) {
    if (!place.has("pbrMetallicRoughness")) return -1;
    place = place.at("pbrMetallicRoughness");
  }
  if (!place.has(use.key) || !root.has("textures")) return -1;
  const auto id = place.at(use.key).at("index").integer(0, 1 << 30);
  const JsonCursor texture = root.at("textures").at(static_cast<std::size_t>(id));
  if (texture.has("source")) return texture.at("source").integer(0, 1 << 30);
  if (!texture.has("extensions") || !texture.at("extensions").has("EXT_texture_webp")) return -1;
  return texture.at("extensions").at("EXT_texture_webp").at("source").integer(0, 1 << 30);
}

void add_uses(const JsonCursor& root, std::vector<ListedTexture>& textures) {
  if (!root.has("materials")) return;
  const JsonCursor materials = root.at("materials");
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const JsonCursor material = materials.at(m);
    const std::string name =
        material.has("name") ? material.at("name").string() : std::to_string(m);
    for (const GltfUse& use : kGltfUses) {
      const std::int64_t image = image_of_use(root, material, use);
      if (image < 0 || image >= static_cast<std::int64_t>(textures.size())) continue;
      std::string& used_by = textures[static_cast<std::size_t>(image)].used_by;
      used_by += (used_by.empty() ? "" : ", ") + std::string(use.slot) + " of '" + name + "'";
    }
  }
}

std::vector<ListedTexture> list_of_gltf(const fs::path& file) {
  const std::string bytes = read_file(file);
  const GltfFile gltf = parse_gltf_file(bytes, file);
  std::vector<ListedTexture> textures;
  if (!gltf.root().has("images")) return textures;
  const JsonCursor images = gltf.root().at("images");
  for (std::size_t i = 0; i < images.size(); ++i) {
    const bool is_file =
        images.at(i).has("uri") && !images.at(i).at("uri").string().starts_with("data:");
    ListedTexture texture;
    texture.name = is_file ? images.at(i).at("uri").string() : "images[" + std::to_string(i) + "]";
    measure_listed([&] { return read_image_bytes(gltf, static_cast<std::int64_t>(i)); }, texture);
    textures.push_back(std::move(texture));
  }
  add_uses(gltf.root(), textures);
  return textures;
}

}  // namespace

std::vector<ListedTexture> list_textures(const fs::path& mesh_file) {
  const std::string ending = lower_ending_of(mesh_file);
  if (ending == ".glb" || ending == ".gltf") return list_of_gltf(mesh_file);
  if (ending == ".obj") return list_of_obj(mesh_file);
  if (ending == ".ply") return list_of_ply(mesh_file);
  return {};
}

}  // namespace viewcell

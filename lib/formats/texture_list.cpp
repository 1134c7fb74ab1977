#include "formats/texture_list.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "base/error.h"
#include "base/file.h"
#include "formats/gltf_buffers.h"
#include "image/picture_size.h"

namespace viewcell {
namespace {

namespace fs = std::filesystem;

std::string lower_ending_of(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

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

std::vector<std::string> words_of_line(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// What stands behind the first word, and behind options such as "-s 1 1 1" of it.
std::string file_of_map(const std::vector<std::string>& words) {
  std::size_t i = 1;
  while (i < words.size() && words[i].starts_with('-')) {
    ++i;
    const auto is_value = [&] {
      return i + 1 < words.size() &&
             (words[i] == "on" || words[i] == "off" || words[i].size() == 1 ||
              words[i].find_first_not_of("0123456789.+-eE") == std::string::npos);
    };
    while (is_value()) ++i;
  }
  std::string name;  // names may hold blanks
  for (; i < words.size(); ++i) name += (name.empty() ? "" : " ") + words[i];
  return name;
}

void list_library(const fs::path& obj, const std::string& name,
                  std::vector<ListedTexture>& textures) {
  std::istringstream library;
  try {
    library.str(read_file(resolve_inside(obj, "mtllib", name)));
  } catch (const InputError&) {
    return;  // absent, as for read_mesh
  }
  std::string material;
  for (std::string line; std::getline(library, line);) {
    const std::vector<std::string> words = words_of_line(line);
    if (words.size() < 2) continue;
    if (words[0] == "newmtl") material = words[1];
    const bool is_map = words[0].starts_with("map_") || words[0] == "bump" || words[0] == "norm" ||
                        words[0] == "disp" || words[0] == "decal";
    if (is_map) add_file(obj, file_of_map(words), words[0] + " of '" + material + "'", textures);
  }
}

std::vector<ListedTexture> list_of_obj(const fs::path& obj) {
  std::vector<ListedTexture> textures;
  std::istringstream stream(read_file(obj));
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("mtllib")) continue;
    const std::vector<std::string> words = words_of_line(line);
    for (std::size_t i = 1; i < words.size(); ++i) list_library(obj, words[i], textures);
  }
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

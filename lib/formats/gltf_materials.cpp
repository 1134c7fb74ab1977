#include "formats/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace viewcell {
namespace {

constexpr const char* kTransform = "KHR_texture_transform";
constexpr const char* kOldMaterial = "KHR_materials_pbrSpecularGlossiness";

// object[key], where object is there and has it.
std::optional<JsonCursor> child(const std::optional<JsonCursor>& object, const char* key) {
  if (!object || !object->has(key)) return std::nullopt;
  return object->at(key);
}

std::optional<JsonCursor> texture_info(const JsonCursor& material, GltfSlot slot) {
  const std::optional<JsonCursor> pbr = child(material, "pbrMetallicRoughness");
  switch (slot) {
    case GltfSlot::base_color:
      if (const auto info = child(pbr, "baseColorTexture")) return info;
      return child(child(child(material, "extensions"), kOldMaterial), "diffuseTexture");
    case GltfSlot::normal:
      return child(material, "normalTexture");
    case GltfSlot::emissive:
      return child(material, "emissiveTexture");
    case GltfSlot::occlusion:
      return child(material, "occlusionTexture");
    case GltfSlot::metallic_roughness:
      return child(pbr, "metallicRoughnessTexture");
  }
  return std::nullopt;
}

GltfTexcoords texcoords_of(const JsonCursor& info) {
  GltfTexcoords out;
  out.set = std::max<std::int64_t>(0, optional_gltf_index(info, "texCoord"));
  if (!has_extension(info, kTransform)) return out;
  const JsonCursor transform = extension_of(info, kTransform);
  const auto pair = [&](const char* key, glm::dvec2& to) {
    if (!transform.has(key)) return;
    const std::vector<double> numbers = transform.at(key).numbers(2, -1e6, 1e6);
    to = {numbers[0], numbers[1]};
  };
  pair("offset", out.offset);
  pair("scale", out.scale);
  if (transform.has("rotation")) out.rotation = transform.at("rotation").number(-1e6, 1e6);
  if (transform.has("texCoord")) out.set = gltf_index(transform.at("texCoord"));
  return out;
}

JsonCursor texture_at(const JsonCursor& root, std::int64_t id) {
  return root.at("textures").at(static_cast<std::size_t>(id));
}

}  // namespace

const char* name_of(GltfSlot slot) {
  switch (slot) {
    case GltfSlot::base_color:
      return "baseColor";
    case GltfSlot::normal:
      return "normal";
    case GltfSlot::emissive:
      return "emissive";
    case GltfSlot::occlusion:
      return "occlusion";
    case GltfSlot::metallic_roughness:
      return "metallicRoughness";
  }
  return "";
}

// Source: KHR_texture_transform (Khronos): scale, then rotate counter-clockwise as seen on the
// picture, whose v runs down, then move. Its first drafts had the rotation's sign the other way.
glm::dvec2 GltfTexcoords::apply(const glm::dvec2& uv) const {
  const double c = std::cos(rotation), s = std::sin(rotation);
  const glm::dvec2 scaled = scale * uv;
  return offset + glm::dvec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
}

std::optional<GltfTextureUse> texture_of(const JsonCursor& material, GltfSlot slot) {
  const std::optional<JsonCursor> info = texture_info(material, slot);
  if (!info) return std::nullopt;
  return GltfTextureUse{texcoords_of(*info), gltf_index(info->at("index"))};
}

std::optional<GltfTextureUse> leading_texture(const JsonCursor& material) {
  for (const GltfSlot slot : kGltfSlots)
    if (const auto use = texture_of(material, slot)) return use;
  return std::nullopt;
}

GlbSampler sampler_of(const JsonCursor& root, std::int64_t texture) {
  GlbSampler out;
  const std::int64_t id = optional_gltf_index(texture_at(root, texture), "sampler");
  if (id < 0) return out;
  const JsonCursor sampler = root.at("samplers").at(static_cast<std::size_t>(id));
  const auto read = [&](const char* key, std::initializer_list<int> known, int other, int& to) {
    if (!sampler.has(key)) return;
    const std::int64_t number = gltf_index(sampler.at(key));
    const bool is_known = std::find(known.begin(), known.end(), number) != known.end();
    to = is_known ? static_cast<int>(number) : other;
  };
  const auto wraps = {GlbSampler::kRepeat, GlbSampler::kClampToEdge, GlbSampler::kMirrored};
  read("wrapS", wraps, GlbSampler::kClampToEdge, out.wrap_s);
  read("wrapT", wraps, GlbSampler::kClampToEdge, out.wrap_t);
  read("magFilter", {GlbSampler::kNearest, GlbSampler::kLinear}, out.mag_filter, out.mag_filter);
  read("minFilter", {GlbSampler::kNearest, GlbSampler::kLinear, 9984, 9985, 9986, 9987},
       out.min_filter, out.min_filter);
  return out;
}

bool has_readable_image(const JsonCursor& root, std::int64_t id) {
  const JsonCursor texture = texture_at(root, id);
  return texture.has("source") || has_extension(texture, "EXT_texture_webp");
}

std::int64_t image_of_texture(const JsonCursor& root, std::int64_t id) {
  const JsonCursor texture = texture_at(root, id);
  if (texture.has("source")) return gltf_index(texture.at("source"));
  if (has_extension(texture, "EXT_texture_webp"))
    return gltf_index(extension_of(texture, "EXT_texture_webp").at("source"));
  for (const char* other : {"KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"})
    if (has_extension(texture, other))
      texture.fail(std::string("has its picture as ") + other +
                   " alone, which is not read; export it as PNG, JPEG or WebP");
  texture.fail("has no picture that is read: PNG, JPEG or WebP");
}

std::set<std::int64_t> used_materials(const JsonCursor& root) {
  std::set<std::int64_t> used;
  if (!root.has("meshes")) return used;
  const JsonCursor meshes = root.at("meshes");
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const JsonCursor primitives = meshes.at(m).at("primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p)
      if (const std::int64_t id = optional_gltf_index(primitives.at(p), "material"); id >= 0)
        used.insert(id);
  }
  return used;
}

glm::dvec4 base_color_factor(const JsonCursor& material) {
  const auto pbr = child(material, "pbrMetallicRoughness");
  auto factor = child(pbr, "baseColorFactor");
  if (!factor && has_extension(material, kOldMaterial))
    factor = child(extension_of(material, kOldMaterial), "diffuseFactor");
  if (!factor) return glm::dvec4(1);
  const std::vector<double> c = factor->numbers(4, 0, 1);
  return {c[0], c[1], c[2], c[3]};
}

std::vector<std::string> name_materials(const JsonCursor& root) {
  std::vector<std::string> out;
  if (!root.has("materials")) return out;
  const JsonCursor materials = root.at("materials");
  std::set<std::string> taken;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const JsonCursor material = materials.at(i);
    std::string name = material.has("name") ? material.at("name").string() : material.place();
    if (taken.contains(name)) name += " (" + material.place() + ")";
    taken.insert(name);
    out.push_back(name);
  }
  return out;
}

}  // namespace viewcell

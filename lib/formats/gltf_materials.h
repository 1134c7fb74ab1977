// The materials of a glTF file as far as they say what a picture shows where. Private to the room.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "formats/glb_material.h"
#include "formats/gltf_buffers.h"

namespace viewcell {

/// The textures that a material may have.
enum class GltfSlot { base_color, normal, emissive, occlusion, metallic_roughness };
inline constexpr std::array<GltfSlot, 5> kGltfSlots{GltfSlot::base_color, GltfSlot::normal,
                                                    GltfSlot::emissive, GltfSlot::occlusion,
                                                    GltfSlot::metallic_roughness};
/// "baseColor", "normal", "emissive", "occlusion" or "metallicRoughness".
const char* name_of(GltfSlot slot);

/// Which texture coordinates of a primitive a texture is looked up with, and how they are moved
/// before (KHR_texture_transform).
struct GltfTexcoords {
  std::int64_t set = 0;  ///< n of TEXCOORD_n
  glm::dvec2 offset{0}, scale{1};
  double rotation = 0;  ///< radians, as the extension has it

  bool operator==(const GltfTexcoords&) const = default;
  /// v runs down on both sides.
  glm::dvec2 apply(const glm::dvec2& uv) const;
};

/// A texture as a material uses it.
struct GltfTextureUse {
  GltfTexcoords texcoords;
  std::int64_t texture = 0;  ///< its number in the file
};

/// Nothing where the material has none in that slot. The colour of old materials
/// (KHR_materials_pbrSpecularGlossiness) counts as base colour.
std::optional<GltfTextureUse> texture_of(const JsonCursor& material, GltfSlot slot);

/// The texture whose coordinates are those of the mesh: of base colour, or else of the first slot
/// that has one.
std::optional<GltfTextureUse> leading_texture(const JsonCursor& material);

/// That of a texture; linear, and repeating as we draw it, where it has none. Of numbers that glTF
/// does not know (GL_CLAMP of old exporters) sides are clamped and filters are linear.
GlbSampler sampler_of(const JsonCursor& root, std::int64_t texture);

/// The number of the picture behind a texture. Throws InputError, with the extension's name, for
/// one that is there in a format only that is not read.
std::int64_t image_of_texture(const JsonCursor& root, std::int64_t texture);
/// Whether image_of_texture finds one.
bool has_readable_image(const JsonCursor& root, std::int64_t texture);

/// The materials that faces have, each once, in order.
std::set<std::int64_t> used_materials(const JsonCursor& root);

/// Linear, with alpha; what the material's colour is multiplied by.
glm::dvec4 base_color_factor(const JsonCursor& material);

/// A name for each material of the file, all different: its own, or else its place.
std::vector<std::string> name_materials(const JsonCursor& root);

}  // namespace viewcell

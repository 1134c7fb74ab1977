// What surfaces look like (docs/formats.md, scene.json), and the pictures on them.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/remarks.h"
#include "image/mip_texture.h"

namespace viewcell {

/// Whether a surface has holes.
enum class AlphaMode {
  opaque,  ///< none: alpha does not matter
  mask     ///< where alpha is below the material's cutoff
};

/// What a surface looks like. Colours are linear, [0, 1]. A point's base colour is base_color times
/// the picture's times the mesh's own, where these are asked for.
struct Material {
  std::string name = {};
  glm::vec3 base_color{0.5f};
  std::string base_color_texture = {};  ///< a path as in the file; empty: none
  bool double_sided = false;            ///< otherwise back faces are culled in every mode
  float opacity = 1;                    ///< times the picture's alpha
  AlphaMode alpha = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;       ///< of AlphaMode::mask
  bool has_vertex_colors = false;  ///< the mesh's colours count
  bool is_unlit = false;           ///< shows its base colour
  glm::vec3 emissive{0};           ///< added to what is lit
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  int picture = -1;  ///< place in Scene::pictures; -1: none, or not read

  std::optional<float> cutoff() const {
    return alpha == AlphaMode::mask ? std::optional(alpha_cutoff) : std::nullopt;
  }
};

/// A picture that materials share; of two cutoffs it is two.
struct ScenePicture {
  std::string file;  ///< as written in scene.json
  std::string hash;  ///< hash_hex of the bytes that were parsed
  std::optional<float> cutoff;
  std::vector<ImageRgba8> mips;  ///< empty when the scene was read without meshes
};

}  // namespace viewcell

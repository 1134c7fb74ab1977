// A material as GLB files have it, as far as we write it.
#pragma once

#include <glm/glm.hpp>
#include <string>

namespace viewcell {

struct GlbMaterial {
  std::string name = {};            ///< empty: none
  std::string base_color = {};      ///< a PNG's or JPEG's bytes (encode_png); empty: no texture
  std::string normal_map = {};      ///< the same, in tangent space, y up; empty: none
  glm::dvec4 base_color_factor{1};  ///< linear, with alpha; multiplies the texture
  double metallic = 0, roughness = 1;
  double normal_scale = 1;
  glm::dvec3 emissive{0};
  std::string alpha_mode = "OPAQUE";  ///< or "MASK", "BLEND"
  double alpha_cutoff = 0.5;          ///< of "MASK"
  bool is_double_sided = false;
};

}  // namespace viewcell

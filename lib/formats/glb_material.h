// A material as GLB files have it, as far as we write it.
#pragma once

#include <compare>
#include <glm/glm.hpp>
#include <string>

namespace viewcell {

/// How a picture is shown beyond its sides and between its texels, in glTF's own numbers.
struct GlbSampler {
  static constexpr int kRepeat = 10497, kClampToEdge = 33071, kMirrored = 33648;
  static constexpr int kNearest = 9728, kLinear = 9729, kLinearMipmapLinear = 9987;
  int wrap_s = kRepeat, wrap_t = kRepeat;
  int mag_filter = kLinear;
  int min_filter = kLinearMipmapLinear;  ///< or one of 9984 to 9986, too
  bool is_repeating() const { return wrap_s == kRepeat && wrap_t == kRepeat; }
  auto operator<=>(const GlbSampler&) const = default;
};

struct GlbMaterial {
  std::string name = {};        ///< empty: none
  std::string base_color = {};  ///< a PNG's or JPEG's bytes (encode_png); empty: no texture
  std::string normal_map = {};  ///< the same, in tangent space, y up; empty: none
  GlbSampler color_sampler = {}, normal_sampler = {};
  glm::dvec4 base_color_factor{1};  ///< linear, with alpha; multiplies the texture
  double metallic = 0, roughness = 1;
  double normal_scale = 1;
  glm::dvec3 emissive{0};
  std::string alpha_mode = "OPAQUE";  ///< or "MASK", "BLEND"
  double alpha_cutoff = 0.5;          ///< of "MASK"
  bool is_double_sided = false;
};

}  // namespace viewcell

// Pictures on surfaces: a picture and its smaller ones, looked up as graphics hardware does.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"

namespace viewcell {

/// What lies beyond a picture's sides.
enum class Wrap { repeat, clamp, mirror };

/// A picture in sRGB with straight alpha, row 0 at v = 1, and behind it each half as wide and as
/// high as the one before (rounded down, at least 1), to the one of 1 x 1. Averaged as light, each
/// texel as much as its alpha says. cutoff: alpha below it is not there; each level then gets its
/// alpha scaled so that as much of it is there as of the picture [Castano 2010]. n_threads: 0: all;
/// the same bytes for any.
std::vector<ImageRgba8> make_mips(ImageRgba8 picture, std::optional<float> cutoff = {},
                                  int n_threads = 0);

/// How far uv moves from one pixel to the next, to the right and down.
struct UvStep {
  glm::vec2 dx{0}, dy{0};
};

/// Levels of make_mips, as a surface has them. Cheap to copy.
struct MipTexture {
  const std::vector<ImageRgba8>* levels = nullptr;  ///< must outlive this
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
};

/// The level to look at: log2 of the longer step in texels of level 0; 0 for the picture itself and
/// what is nearer.
float mip_lod(const MipTexture& texture, const UvStep& step);

/// Linear colour and alpha at uv, bilinear within the two levels nearest to lod and linear between
/// them. uv that is not finite is as 0.
glm::vec4 sample(const MipTexture& texture, const glm::vec2& uv, float lod);

/// Declares  vec4 sample_mips(sampler2D mips, vec2 uv);  for fragments: the twin of sample() at
/// mip_lod(), of a texture with these levels, its filter GL_LINEAR_MIPMAP_LINEAR. Two looks at
/// whole levels, since drivers make their own of what is in between.
std::string sample_mips_glsl();

}  // namespace viewcell

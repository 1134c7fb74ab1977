// The lighting function as shader text, quick enough for a software rasteriser.
#pragma once

#include <string>

#include "scene/lighting.h"

namespace viewcell {

/// Declares  vec3 shade(vec3 base_color, vec3 normal);  vec3 srgb_encode(vec3 linear);  the twins
/// of those in scene/lighting.h, with the scene's light as constants: llvmpipe pays for every
/// uniform that a fragment reads, and with constants a lit pixel costs less than half.
std::string make_shading_glsl(const Lighting& lighting);

/// What srgb_encode of the text above computes: one square root and a polynomial in it, within
/// kQuickSrgbError of the sRGB curve. A shader's pow() costs as much as all the rest of a pixel.
float quick_srgb_encode(float linear);
inline constexpr float kQuickSrgbError = 0.25f / 255.0f;

/// A colour as GLSL text, for example "vec3(0.25, 1, 0)".
std::string glsl_vec3(const glm::vec3& v);

}  // namespace viewcell

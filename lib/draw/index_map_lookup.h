// A texture seen through an indexing map, as GLSL.
#pragma once

#include <string>

namespace viewcell {

/// Defines `Place indexed_place(vec2 uv)`, with a Place's uv and its derivatives dx and dy on the
/// screen: the map (sampler2D index_map, binding 1, two channels, rows from v = 0 up) tells where
/// to look at other textures, whose own filtering and mipmaps serve (textureGrad). Follows:
/// [Chen06 3.2.4], whose texels hold places of the original texture.
///
/// Between texels places are interpolated bilinearly. Beyond the map's sides it goes on by the
/// texture's period, M(p + n) = M(p) + n for whole n: so the identity stays the identity where a
/// mesh repeats its texture. The texture's derivatives are those of uv on the screen times the
/// Jacobian of the bilinear patch; differences of places between pixels would alias at jumps.
///
/// Where the four texels disagree, their mean is a place that none of them means: then the nearest
/// texel's place holds alone, with the derivatives of uv. They disagree when along one of the four
/// sides of their square the place steps, in u or in v, out of the range of 0 and the two steps
/// before and after it on the same line, by more than kJumpTexels texels of the map and half of the
/// larger of the two.
///
/// Known limits: a chart one texel wide between two jumps the same way is not told from a stretch;
/// the map itself is not filtered, so a map finer than the screen's pixels is sampled as it lies.
std::string index_map_glsl();

/// What places may step beyond their neighbours' steps, in texels of the map. Adapted maps bend by
/// a texel or two a texel; jumps between charts are mostly tens.
inline constexpr float kJumpTexels = 4;

}  // namespace viewcell

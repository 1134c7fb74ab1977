// A texture seen through an indexing map, as GLSL.
#pragma once

#include <string>

namespace viewcell {

/// Defines `IndexedTexcoords indexed_texcoords(vec2 uv)`: the uv, with screen derivatives dx and
/// dy, at which to sample other textures by textureGrad, with their own filtering and mipmaps. The
/// map is sampler2D index_map, binding 1, two channels, rows from v = 0 up. Follows:
/// [Chen06 3.2.4]: its texels hold texture coordinates of the original texture.
///
/// Between texels these coordinates are interpolated bilinearly. Beyond its sides the map continues
/// with the texture's period, M(p + n) = M(p) + n for whole n: so the identity stays the identity
/// where a mesh repeats its texture. The derivatives are those of uv on the screen times the
/// Jacobian of the bilinear patch; differences between pixels would alias at jumps.
///
/// Where the map jumps between the four texels, as at borders of charts, their mean is meaningless:
/// then the nearest texel's coordinates are used, with the derivatives of uv. It jumps when along
/// one of the four sides of their square the step, in u or in v, leaves the range of 0 and the two
/// steps before and after it on the same line by more than kJumpTexels texels of the map and half
/// of the larger of the two.
///
/// Known limits: a chart one texel wide between two jumps in the same direction passes for a
/// stretched one; the map itself is not filtered, so a map finer than the screen's pixels aliases.
std::string index_map_glsl();

/// By how much a step may exceed its neighbours', in texels of the map, before it is a jump.
/// Adapted maps bend by a texel or two a texel; jumps between charts are mostly tens.
inline constexpr float kJumpTexels = 4;

}  // namespace viewcell

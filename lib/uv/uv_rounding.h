// What counts as the same place in a texture.
#pragma once

namespace viewcell {

/// Coordinates of files with five digits; less than a hundredth of a texel in 1024.
inline constexpr double kUvRounding = 1e-5;

}  // namespace viewcell

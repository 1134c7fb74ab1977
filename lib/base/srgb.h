// The sRGB curve (IEC 61966-2-1).
#pragma once

#include <cstdint>

namespace viewcell {

/// Both clamp to [0, 1]; not a number counts as 0.
float srgb_encode(float linear);
float srgb_decode(float encoded);
/// 8 bits, rounded to nearest.
std::uint8_t srgb8_from_linear(float linear);

}  // namespace viewcell

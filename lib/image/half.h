// 16-bit floats (IEEE binary16) as bits. The conversions are Imath's: one instruction where the
// processor has it, the same bits elsewhere.
#pragma once

#define IMATH_HALF_NO_LOOKUP_TABLE  // a table would be one more library to link
#include <Imath/half.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "image/image.h"

namespace viewcell {

/// The nearest half, ties to even. What is too large, infinite too, becomes 65504 with its sign;
/// NaN becomes 0: no capture holds a value that is not finite.
inline std::uint16_t half_from_float(float x) {
  return x == x ? imath_float_to_half(std::clamp(x, -65504.f, 65504.f)) : std::uint16_t{0};
}

/// Exact.
inline float float_from_half(std::uint16_t half) {
  return imath_half_to_float(half);
}

inline bool is_finite_half(std::uint16_t half) {
  return (half & 0x7c00) != 0x7c00;
}

/// Four halves a pixel, row by row.
std::vector<std::uint16_t> half_from_rgba(const ImageRgbaFloat& image);
/// halves.size() must be 4 * width_px * height_px.
ImageRgbaFloat rgba_from_half(const std::vector<std::uint16_t>& halves, int width_px,
                              int height_px);

}  // namespace viewcell

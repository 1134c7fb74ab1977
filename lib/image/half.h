// 16-bit floats (IEEE binary16) as bits.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "image/image.h"

namespace viewcell {

inline constexpr std::uint16_t kLargestHalf = 0x7bff;  // 65504

/// The nearest half, ties to even. What is too large, infinite too, becomes 65504 with its sign;
/// NaN becomes 0: no capture holds a value that is not finite.
inline std::uint16_t half_from_float(float x) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
  const auto sign = static_cast<std::uint16_t>(bits >> 16 & 0x8000);
  const std::uint32_t magnitude = bits & 0x7fffffff;
  if (magnitude > 0x7f800000) return 0;
  if (magnitude >= 0x477fe000) return sign | kLargestHalf;
  if (magnitude >= 0x38800000) {  // normal: drop 13 bits, rounding; a carry runs into the exponent
    const std::uint32_t rounded = magnitude + 0xfff + (magnitude >> 13 & 1);
    return static_cast<std::uint16_t>(sign | (rounded - 0x38000000) >> 13);
  }
  // Subnormal: 0.5 has the unit of the least half, so the float addition does the rounding.
  const std::uint32_t sum = std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + 0.5f);
  return static_cast<std::uint16_t>(sign | (sum - std::bit_cast<std::uint32_t>(0.5f)));
}

/// Exact.
inline float float_from_half(std::uint16_t half) {
  const std::uint32_t sign = (half & 0x8000u) << 16, exponent = half >> 10 & 0x1f;
  const std::uint32_t mantissa = half & 0x3ffu;
  if (exponent == 0) {
    const float magnitude = static_cast<float>(mantissa) * 0x1p-24f;
    return sign ? -magnitude : magnitude;
  }
  const std::uint32_t wide = exponent == 31 ? 255 : exponent + 112;
  return std::bit_cast<float>(sign | wide << 23 | mantissa << 13);
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

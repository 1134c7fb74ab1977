#include "base/srgb.h"

#include <cmath>

namespace viewcell {
namespace {

double clamp01(float x) {
  return x > 0 ? std::fmin(static_cast<double>(x), 1.0) : 0.0;
}

double encode(double x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

}  // namespace

float srgb_encode(float linear) {
  return static_cast<float>(encode(clamp01(linear)));
}

float srgb_decode(float encoded) {
  const double x = clamp01(encoded);
  return static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

std::uint8_t srgb8_from_linear(float linear) {
  return static_cast<std::uint8_t>(std::lround(255 * encode(clamp01(linear))));
}

}  // namespace viewcell

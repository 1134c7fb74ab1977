// Directions as the colours of a tangent-space normal map.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "image/image.h"

namespace viewcell {

/// Which way a map's green points in the texture: up, as in OpenGL and glTF, or down, as in
/// Direct3D.
enum class NormalMapY { up, down };

/// Codes 0 to 255 as -1 to 1 [glTF 2.0, 3.9.3], linear, of any length; green up.
inline glm::dvec3 decode_normal(const Rgba8& p, NormalMapY y = NormalMapY::up) {
  const auto decode = [](std::uint8_t code) { return code * (2.0 / 255) - 1; };
  return {decode(p[0]), y == NormalMapY::up ? decode(p[1]) : -decode(p[1]), decode(p[2])};
}

/// The nearest codes, green up, opaque. decode_normal's values give their codes back.
inline Rgba8 encode_normal(const glm::dvec3& n) {
  Rgba8 out{0, 0, 0, 255};
  for (int k = 0; k < 3; ++k) {
    const double code = std::floor((n[k] + 1) * (255.0 / 2) + 0.5);
    out[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(glm::clamp(code, 0.0, 255.0));
  }
  return out;
}

}  // namespace viewcell

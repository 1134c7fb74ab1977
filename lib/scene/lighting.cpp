#include "scene/lighting.h"

#include <cmath>

namespace viewcell {

float srgb_encode(float linear) {
  const float x = std::fmin(std::fmax(linear, 0.0f), 1.0f);
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

float srgb_decode(float encoded) {
  const float x = std::fmin(std::fmax(encoded, 0.0f), 1.0f);
  return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

glm::vec3 srgb_encode(const glm::vec3& linear) {
  return {srgb_encode(linear.x), srgb_encode(linear.y), srgb_encode(linear.z)};
}

unsigned char srgb_encode_8bit(float linear) {
  return static_cast<unsigned char>(std::floor(srgb_encode(linear) * 255.0f + 0.5f));
}

const char* const kLightingGlsl = R"(
layout(std140, binding = 0) uniform LightingBlock {
  vec4 toward_light;
  vec4 light;
  vec4 ambient_sky;
  vec4 ambient_ground;
};
vec3 shade(vec3 base_color, vec3 normal) {
  float lambert = max(dot(normal, toward_light.xyz), 0.0);
  vec3 ambient = mix(ambient_ground.xyz, ambient_sky.xyz, 0.5 + 0.5 * normal.z);
  return base_color * (lambert * light.xyz + ambient);
}
vec3 srgb_encode(vec3 linear) {
  vec3 x = clamp(linear, 0.0, 1.0);
  return mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, 12.92 * x, lessThanEqual(x, vec3(0.0031308)));
}
)";

}  // namespace viewcell

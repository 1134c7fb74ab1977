// The one lighting function: every mode and every engine shades with it.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "base/srgb.h"

namespace viewcell {

/// One directional light and an ambient that goes from ground to sky with the normal's z.
/// All colours are linear; nothing casts shadows. The default is a low, warm sun under a clear sky:
/// lit and unlit sides differ enough for errors of a picture to show.
struct Lighting {
  glm::vec3 toward_light{0.60f, -0.64f, 0.48f};  ///< unit, from the surface to the light
  glm::vec3 light{1.12f, 0.98f, 0.76f};
  glm::vec3 ambient_sky{0.17f, 0.21f, 0.29f};
  glm::vec3 ambient_ground{0.07f, 0.06f, 0.05f};
  glm::vec3 sky_color{0.30f, 0.42f, 0.62f};     ///< behind everything
  glm::vec3 ground_color{0.12f, 0.14f, 0.09f};  ///< of the ground plane, as displayed (unlit)
};

/// Linear colour of a Lambert surface. normal: unit.
inline glm::vec3 shade(const Lighting& l, const glm::vec3& base_color, const glm::vec3& normal) {
  const float lambert = glm::max(glm::dot(normal, l.toward_light), 0.0f);
  const glm::vec3 ambient = glm::mix(l.ambient_ground, l.ambient_sky, 0.5f + 0.5f * normal.z);
  return base_color * (lambert * l.light + ambient);
}

/// What shade() needs of a Lighting, each as GLSL text: a constant, or a uniform's name.
struct LightingGlsl {
  std::string toward_light = "toward_light", light = "light";
  std::string ambient_sky = "ambient_sky", ambient_ground = "ambient_ground";
};
/// Declares  vec3 shade(vec3 base_color, vec3 normal);  the twin of shade().
std::string make_shade_glsl(const LightingGlsl& lighting = {});

glm::vec3 srgb_encode(const glm::vec3& linear);
}  // namespace viewcell

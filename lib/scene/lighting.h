// The one lighting function: every mode and every engine shades with it.
#pragma once

#include <glm/glm.hpp>

#include "base/srgb.h"

namespace viewcell {

/// One directional light and an ambient that goes from ground to sky with the normal's z.
/// All colours are linear; nothing casts shadows.
struct Lighting {
  glm::vec3 toward_light{0.48f, -0.60f, 0.64f};  ///< unit, from the surface to the light
  glm::vec3 light{1.05f, 1.0f, 0.92f};
  glm::vec3 ambient_sky{0.20f, 0.24f, 0.30f};
  glm::vec3 ambient_ground{0.09f, 0.08f, 0.06f};
  glm::vec3 sky_color{0.30f, 0.42f, 0.62f};     ///< behind everything
  glm::vec3 ground_color{0.12f, 0.14f, 0.09f};  ///< of the ground plane, as displayed (unlit)
};

/// Linear colour of a Lambert surface. normal: unit.
inline glm::vec3 shade(const Lighting& l, const glm::vec3& base_color, const glm::vec3& normal) {
  const float lambert = glm::max(glm::dot(normal, l.toward_light), 0.0f);
  const glm::vec3 ambient = glm::mix(l.ambient_ground, l.ambient_sky, 0.5f + 0.5f * normal.z);
  return base_color * (lambert * l.light + ambient);
}

glm::vec3 srgb_encode(const glm::vec3& linear);
}  // namespace viewcell

#include "scene/lighting.h"

namespace viewcell {

std::string make_shade_glsl(const LightingGlsl& l) {
  return "vec3 shade(vec3 base_color, vec3 normal) {\n"
         "  float lambert = max(dot(normal, " +
         l.toward_light +
         "), 0.0);\n"
         "  vec3 ambient = mix(" +
         l.ambient_ground + ", " + l.ambient_sky +
         ", 0.5 + 0.5 * normal.z);\n"
         "  return base_color * (lambert * " +
         l.light + " + ambient);\n}\n";
}

glm::vec3 srgb_encode(const glm::vec3& linear) {
  return {srgb_encode(linear.x), srgb_encode(linear.y), srgb_encode(linear.z)};
}

}  // namespace viewcell

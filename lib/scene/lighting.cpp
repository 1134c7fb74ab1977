#include "scene/lighting.h"

namespace viewcell {

glm::vec3 srgb_encode(const glm::vec3& linear) {
  return {srgb_encode(linear.x), srgb_encode(linear.y), srgb_encode(linear.z)};
}

}  // namespace viewcell

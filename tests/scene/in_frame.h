// Whether a camera sees a point.
#pragma once

#include <cmath>

#include "scene/camera.h"

namespace viewcell {

/// Sides and near plane included.
inline bool is_in_frame(const Camera& camera, const glm::dvec3& p) {
  const glm::dvec4 c = clip_from_world(camera) * glm::dvec4(p, 1);
  return c.w >= camera.near && std::abs(c.x) <= c.w && std::abs(c.y) <= c.w;
}

}  // namespace viewcell

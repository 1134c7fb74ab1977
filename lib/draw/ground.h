// The ground: a plain square around the area, drawn alike by every engine.
#pragma once

#include "scene/scene.h"

namespace viewcell {

/// Half its side. At an eye height of 10 its rim is half a pixel of 1024 below the horizon.
inline constexpr double kGroundReach = 20000;

inline glm::dvec3 ground_centre(const Scene& scene) {
  return {0.5 * (scene.area.lo + scene.area.hi), scene.ground_z};
}

}  // namespace viewcell

// Where a walk through a park leads.
#pragma once

#include <cstdint>
#include <vector>

#include "base/random.h"
#include "park/scatter.h"
#include "scene/convex2.h"

namespace viewcell {

/// What stands in a park, as a walker meets it.
struct Ground {
  std::vector<SceneObject> objects;  ///< of the 8M park, see scatter_statues()
  std::vector<ConvexPolygon> footprints;
  std::vector<double> radii;  ///< of the footprints, about the objects' origins
};

Ground make_ground(const std::vector<SceneMesh>& meshes, std::vector<SceneObject> objects);

/// The distance from a point to the nearest footprint, or `reach` when none is nearer than that.
double clearance(const Ground& ground, const glm::dvec2& point, double reach);

/// A smooth random route of about `length` inside the park, as points `step` apart along it: past
/// objects of the 2M park, a dragon or a bunny first. Empty when the one that was tried passes any
/// footprint of the 8M park closer than `min_clearance`.
std::vector<glm::dvec2> make_route(const Ground& ground, Random& random, double length, double step,
                                   double min_clearance);

}  // namespace viewcell

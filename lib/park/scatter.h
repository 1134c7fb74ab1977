// Statues scattered over a park.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "park/statues.h"
#include "scene/convex2.h"
#include "scene/scene.h"

namespace viewcell {

/// The three sizes of park, each a subset of the next.
enum class ParkSize { k2m, k4m, k8m };
inline constexpr int kParkSizes = 3;

/// The park of the paper: 1650 x 2035 [Chen06 5.3.1].
inline constexpr Area kParkArea{{0, 0}, {1650, 2035}};

/// Objects of a park of that size.
std::size_t count_statues(ParkSize size);

/// The objects of the 8M park, placed uniformly at random and turned about z, the 2M park's first,
/// then those that the 4M park adds, then the rest. Footprint hulls stay apart by a gap that a
/// walker fits through, and inside the area. meshes: one a kind, in the order of statue_kinds().
std::vector<SceneObject> scatter_statues(const std::vector<SceneMesh>& meshes, std::uint64_t seed);

/// The convex hull of a mesh's projection on the x-y plane, model space.
ConvexPolygon make_footprint(const TriMesh& mesh);
/// That hull where the object stands.
ConvexPolygon place_footprint(const ConvexPolygon& footprint, const SceneObject& object);

}  // namespace viewcell

// What a frame draws, as a pure function of scene, camera and mode.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "draw/mesh_levels.h"
#include "scene/camera.h"

namespace viewcell {

/// One object at one level of its mesh.
struct ObjectDraw {
  ObjectId object{};
  int level = 0;
  bool operator==(const ObjectDraw&) const = default;
};

struct FramePlan {
  std::vector<ObjectDraw> draws;  ///< in the order of drawing
  std::size_t n_triangles = 0;    ///< handed to the rasteriser, before it clips and culls
  std::size_t n_calls = 0;        ///< to draw them: one for each material of an object
};

/// What plans need to know of a scene: boxes and levels, no vertices.
struct PlanScene {
  struct Level {
    std::size_t n_triangles = 0;
    double error = 0;  ///< model units
    std::size_t n_slots = 1;
  };
  struct Mesh {
    Box box;  ///< in model space
    std::vector<Level> levels;
  };
  std::vector<Mesh> meshes;
  std::vector<SceneObject> objects;

  const Mesh& mesh_of(const SceneObject& object) const { return meshes[index(object.mesh)]; }
};

/// levels: by MeshId, as built by build_scene_levels.
PlanScene make_plan_scene(const Scene& scene, const std::vector<MeshLevels>& levels);

/// The four sides of a camera's pyramid and its near plane. A point p is inside when
/// dot(plane, (p, 1)) >= 0 for all.
struct Frustum {
  glm::dvec4 planes[5];
};
Frustum make_frustum(const Camera& camera);
using BoxCorners = std::array<glm::dvec3, 8>;
/// Conservative: false only when the whole box, or ball, lies outside one of the planes.
bool may_meet(const Frustum& frustum, const BoxCorners& corners);
bool may_meet(const Frustum& frustum, const glm::dvec3& centre, double radius);

BoxCorners make_corners(const Box& box);
/// The corners of an object's box, in the world.
BoxCorners make_corners(const SceneObject& object, const Box& box_model);
/// From a point to the nearest point of the object's box, in the world; 0 inside.
double distance_to_box(const SceneObject& object, const Box& box_model, const glm::dvec3& point);

/// Those of the objects whose boxes meet the camera's frustum, front to back (by the distance of
/// the box's middle; ties by id).
std::vector<ObjectId> select_visible(const PlanScene& scene, const Frustum& frustum,
                                     const Camera& camera, std::span<const ObjectId> objects);

/// Mode `geometry`: every object as it is, in the order of the scene.
FramePlan plan_geometry(const PlanScene& scene);
/// Mode `frustum`: what of the scene select_visible() leaves, in its order.
FramePlan plan_frustum(const PlanScene& scene, const Camera& camera);
/// Mode `lod`: as `frustum`, each object at its coarsest level whose error, at the nearest point of
/// its box, projects to at most max_error_px in a frame of height_px.
FramePlan plan_lod(const PlanScene& scene, const Camera& camera, int height_px,
                   double max_error_px = 1);
/// Mode `lod-equal`: as `lod`, with the least error for all objects that draws at most n_most
/// triangles; every object's coarsest level when none does.
FramePlan plan_lod_within(const PlanScene& scene, const Camera& camera, int height_px,
                          std::size_t n_most);

}  // namespace viewcell

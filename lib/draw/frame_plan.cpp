#include "draw/frame_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"

namespace viewcell {
namespace {

// Corners are computed with a relative error of some 1e-15 of the world's coordinates, vertices are
// floats: 1e-6 of the distance keeps the test conservative for both.
constexpr double kSlack = 1e-6;

std::vector<ObjectId> select_all_visible(const PlanScene& scene, const Camera& camera) {
  std::vector<ObjectId> all;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    all.push_back(ObjectId(static_cast<std::int32_t>(i)));
  return select_visible(scene, make_frustum(camera), camera, all);
}

int choose_level(const std::vector<PlanScene::Level>& levels, double max_error_model) {
  int level = 0;
  for (std::size_t i = 1; i < levels.size() && levels[i].error <= max_error_model; ++i)
    level = static_cast<int>(i);
  return level;
}

void add_draw(const PlanScene& scene, ObjectId object, int level, FramePlan& plan) {
  const PlanScene::Mesh& mesh = scene.mesh_of(scene.objects[index(object)]);
  plan.draws.push_back({object, level});
  plan.n_triangles += mesh.levels[static_cast<std::size_t>(level)].n_triangles;
  plan.n_calls += mesh.levels[static_cast<std::size_t>(level)].n_slots;
}

}  // namespace

PlanScene make_plan_scene(const Scene& scene, const std::vector<MeshLevels>& levels) {
  VIEWCELL_CHECK(levels.size() == scene.meshes.size(), levels.size(), scene.meshes.size());
  PlanScene out;
  out.objects = scene.objects;
  for (const MeshLevels& of_mesh : levels) {
    PlanScene::Mesh& mesh = out.meshes.emplace_back();
    mesh.box = bounding_box(of_mesh[0].mesh);
    for (const MeshLevel& level : of_mesh)
      mesh.levels.push_back({level.mesh.triangles.size(), level.error, level.slots.size()});
  }
  return out;
}

// Follows: Gribb and Hartmann 2001. A clip-space bound such as x <= w is linear in the point, so it
// is a plane: the matrix's row 3 minus row 0.
Frustum make_frustum(const Camera& camera) {
  const glm::dmat4 rows = glm::transpose(clip_from_world(camera));
  return {{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1],
           rows[3] - glm::dvec4(0, 0, 0, camera.near)}};
}

bool may_meet(const Frustum& frustum, const BoxCorners& corners) {
  return std::all_of(std::begin(frustum.planes), std::end(frustum.planes), [&](const auto& plane) {
    return std::any_of(corners.begin(), corners.end(), [&](const glm::dvec3& p) {
      const glm::dvec4 terms = plane * glm::dvec4(p, 1);
      const glm::dvec4 size = glm::abs(terms);
      return terms.x + terms.y + terms.z + terms.w >= -kSlack * (size.x + size.y + size.z + size.w);
    });
  });
}

// The planes are not of unit length.
bool may_meet(const Frustum& frustum, const glm::dvec3& centre, double radius) {
  return std::none_of(std::begin(frustum.planes), std::end(frustum.planes), [&](const auto& plane) {
    return glm::dot(plane, glm::dvec4(centre, 1)) < -radius * glm::length(glm::dvec3(plane));
  });
}

BoxCorners make_corners(const Box& box) {
  BoxCorners corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = {(i & 1) ? box.hi.x : box.lo.x, (i & 2) ? box.hi.y : box.lo.y,
                  (i & 4) ? box.hi.z : box.lo.z};
  return corners;
}

BoxCorners make_corners(const SceneObject& object, const Box& box) {
  BoxCorners corners = make_corners(box);
  for (glm::dvec3& p : corners) p = object.world_from_model(p);
  return corners;
}

double distance_to_box(const SceneObject& object, const Box& box, const glm::dvec3& point) {
  const glm::dvec3 p = object.model_from_world(point);
  return object.scale * glm::distance(p, glm::clamp(p, box.lo, box.hi));
}

std::vector<ObjectId> select_visible(const PlanScene& scene, const Frustum& frustum,
                                     const Camera& camera, std::span<const ObjectId> objects) {
  std::vector<std::pair<double, ObjectId>> visible;
  for (const ObjectId id : objects) {
    const SceneObject& object = scene.objects[index(id)];
    const Box& box = scene.mesh_of(object).box;
    if (may_meet(frustum, make_corners(object, box)))
      visible.emplace_back(glm::distance(camera.eye, object.world_from_model(box.centre())), id);
  }
  std::sort(visible.begin(), visible.end());
  std::vector<ObjectId> out;
  for (const auto& [distance, id] : visible) out.push_back(id);
  return out;
}

FramePlan plan_geometry(const PlanScene& scene) {
  FramePlan plan;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    add_draw(scene, ObjectId(static_cast<std::int32_t>(i)), 0, plan);
  return plan;
}

FramePlan plan_frustum(const PlanScene& scene, const Camera& camera) {
  FramePlan plan;
  for (const ObjectId id : select_all_visible(scene, camera)) add_draw(scene, id, 0, plan);
  return plan;
}

FramePlan plan_lod(const PlanScene& scene, const Camera& camera, int height_px,
                   double max_error_px) {
  const double focal_px = 0.5 * height_px / std::tan(glm::radians(camera.fov_y_deg) / 2);
  FramePlan plan;
  for (const ObjectId id : select_all_visible(scene, camera)) {
    const SceneObject& object = scene.objects[index(id)];
    const PlanScene::Mesh& mesh = scene.mesh_of(object);
    const double distance = distance_to_box(object, mesh.box, camera.eye);
    const double max_error_model = max_error_px * distance / focal_px / object.scale;
    add_draw(scene, id, choose_level(mesh.levels, max_error_model), plan);
  }
  return plan;
}

FramePlan plan_lod_within(const PlanScene& scene, const Camera& camera, int height_px,
                          std::size_t n_most) {
  double fine_px = 1e-6, coarse_px = 1e6;  // too many triangles; few enough, or as few as there are
  FramePlan best = plan_lod(scene, camera, height_px, fine_px);
  if (best.n_triangles <= n_most) return best;
  best = plan_lod(scene, camera, height_px, coarse_px);
  while (coarse_px > 1.001 * fine_px) {
    const double middle_px = std::sqrt(fine_px * coarse_px);
    FramePlan plan = plan_lod(scene, camera, height_px, middle_px);
    const bool fits = plan.n_triangles <= n_most;
    (fits ? coarse_px : fine_px) = middle_px;
    if (fits) best = std::move(plan);
  }
  return best;
}

}  // namespace viewcell

#include "draw/frame_plan.h"

#include <gtest/gtest.h>

#include <set>

#include "draw/small_scene.h"
#include "scene/in_frame.h"

namespace viewcell {
namespace {

constexpr double kFocal1024 = 886.8100134752652;  // 512 / tan(30 degrees)

std::set<std::size_t> drawn(const FramePlan& plan) {
  std::set<std::size_t> out;
  for (const ObjectDraw& draw : plan.draws) out.insert(index(draw.object));
  return out;
}

TEST(FramePlan, GeometryDrawsEverythingInOrder) {
  const Scene scene = make_small_scene(7);
  const FramePlan plan = plan_geometry(make_plan_scene(scene, build_scene_levels(scene, false)));
  ASSERT_EQ(plan.draws.size(), 7u);
  for (int i = 0; i < 7; ++i) EXPECT_EQ(plan.draws[i], (ObjectDraw{ObjectId(i), 0}));
  EXPECT_EQ(plan.n_triangles, count_triangles(scene));
}

TEST(FramePlan, NoObjectWithAVertexInTheFrameIsCulled) {
  std::size_t n_culled = 0, n_visible = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Scene scene = make_small_scene(30, seed, 16);
    const PlanScene plan_scene = make_plan_scene(scene, build_scene_levels(scene, false));
    Random random(seed);
    for (int k = 0; k < 40; ++k) {
      Camera camera = random_camera(random, 120);
      camera.fov_y_deg = random.uniform(5, 120);
      camera.aspect = random.uniform(0.3, 3);
      camera.near = random.uniform(0.1, 30);
      const auto in_plan = drawn(plan_frustum(plan_scene, camera));
      for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        bool visible = false;
        for (const glm::vec3& p : scene.mesh_of(scene.objects[i]).mesh.positions)
          visible |= is_in_frame(camera, scene.objects[i].world_from_model(p));
        n_visible += visible;
        n_culled += !in_plan.contains(i);
        ASSERT_TRUE(!visible || in_plan.contains(i)) << "object " << i << " view " << k;
      }
    }
  }
  EXPECT_GT(n_visible, 100u);
  EXPECT_GT(n_culled, 1000u);
}

// A triangle across the frame has no vertex in it; its box still meets the frustum.
TEST(FramePlan, WallAcrossTheFrameIsKept) {
  Scene scene = make_small_scene(0);
  scene.meshes.push_back(make_scene_mesh("wall", make_wall(1000)));
  scene.objects.push_back({"wall", MeshId(2), {0}, {50, 0, -1000}, {1, 0, 0, 0}, 1});
  Camera camera;
  camera.eye = {0, 0, 5};
  const PlanScene plan_scene = make_plan_scene(scene, build_scene_levels(scene, false));
  EXPECT_EQ(plan_frustum(plan_scene, camera).draws.size(), 1u);
  camera.forward = {-1, 0, 0};
  EXPECT_EQ(plan_frustum(plan_scene, camera).draws.size(), 0u);
}

// One object beyond each of the four sides, one behind, one ahead.
TEST(FramePlan, EverySideCulls) {
  Scene scene = make_small_scene(0);
  Camera camera;
  camera.eye = {0, 0, 5};
  const glm::dvec3 beside[] = {{30, 90, 5}, {30, -90, 5}, {30, 0, 95}, {30, 0, -85}, {-30, 0, 5}};
  for (const glm::dvec3& at : beside) {
    scene.objects = {{"torus", MeshId(0), {0}, at, {1, 0, 0, 0}, 1}};
    const PlanScene plan_scene = make_plan_scene(scene, build_scene_levels(scene, false));
    EXPECT_TRUE(plan_frustum(plan_scene, camera).draws.empty())
        << at.x << " " << at.y << " " << at.z;
  }
  scene.objects = {{"torus", MeshId(0), {0}, {30, 0, 5}, {1, 0, 0, 0}, 1}};
  const PlanScene ahead = make_plan_scene(scene, build_scene_levels(scene, false));
  EXPECT_EQ(plan_frustum(ahead, camera).draws.size(), 1u);
}

TEST(FramePlan, FrustumRunsFrontToBackWithTiesById) {
  Scene scene = make_small_scene(0);
  for (const double x : {60.0, 20.0, 40.0, 20.0})
    scene.objects.push_back({"torus", MeshId(0), {0}, {x, 0, 5}, {1, 0, 0, 0}, 1});
  Camera camera;
  camera.eye = {0, 0, 5};
  const auto plan = plan_frustum(make_plan_scene(scene, build_scene_levels(scene, false)), camera);
  std::vector<std::size_t> order;
  for (const ObjectDraw& draw : plan.draws) order.push_back(index(draw.object));
  EXPECT_EQ(order, (std::vector<std::size_t>{1, 3, 2, 0}));
}

TEST(FramePlan, DistanceToABoxByHand) {
  const Box box{{-1, -1, -1}, {1, 1, 1}};
  const SceneObject object{"box", MeshId(0), {0}, {10, 0, 0}, {1, 0, 0, 0}, 2};  // spans 8..12
  EXPECT_DOUBLE_EQ(distance_to_box(object, box, {0, 0, 0}), 8);
  EXPECT_DOUBLE_EQ(distance_to_box(object, box, {5, 6, 0}), 5);
  EXPECT_DOUBLE_EQ(distance_to_box(object, box, {11, 1, -1}), 0);
}

// An error of e at distance d covers e / d * 886.8 px of a frame of 1024.
TEST(FramePlan, LodTakesTheCoarsestLevelWithinAPixel) {
  PlanScene scene;
  scene.meshes.push_back({{{-1, -1, -1}, {1, 1, 1}}, {{800, 0}, {400, 0.01}, {200, 0.05}}});
  scene.objects.push_back({"box", MeshId(0), {0}, {0, 0, 0}, {1, 0, 0, 0}, 2});
  const auto level_at = [&](double distance_of_face) {
    Camera camera;
    camera.eye = {-distance_of_face - 2, 0, 0};
    return plan_lod(scene, camera, 1024).draws.at(0).level;
  };
  const double middle = 0.02 * kFocal1024, far = 0.1 * kFocal1024;  // scale 2
  EXPECT_EQ(level_at(middle * 0.999), 0);
  EXPECT_EQ(level_at(middle * 1.001), 1);
  EXPECT_EQ(level_at(far * 0.999), 1);
  EXPECT_EQ(level_at(far * 1.001), 2);
  Camera inside;
  EXPECT_EQ(plan_lod(scene, inside, 1024).draws.at(0).level, 0);
}

TEST(FramePlan, LodDrawsTheObjectsOfFrustumWithNoMoreTriangles) {
  const Scene scene = make_small_scene(40, 3);
  const PlanScene plan_scene = make_plan_scene(scene, build_scene_levels(scene, true));
  Random random(5);
  for (int k = 0; k < 20; ++k) {
    const Camera camera = random_camera(random);
    const FramePlan frustum = plan_frustum(plan_scene, camera);
    const FramePlan lod = plan_lod(plan_scene, camera, 1024);
    EXPECT_EQ(drawn(frustum), drawn(lod));
    EXPECT_LE(lod.n_triangles, frustum.n_triangles);
  }
}

// What lod-equal draws fits; the next finer error that changes anything does not.
TEST(FramePlan, LodWithinSpendsWhatItMay) {
  const Scene scene = make_small_scene(40, 3);
  const PlanScene plan_scene = make_plan_scene(scene, build_scene_levels(scene, true));
  Random random(6);
  for (int k = 0; k < 20; ++k) {
    const Camera camera = random_camera(random);
    const std::size_t n_frustum = plan_frustum(plan_scene, camera).n_triangles;
    const std::size_t n_coarsest = plan_lod(plan_scene, camera, 1024, 1e9).n_triangles;
    EXPECT_EQ(plan_lod_within(plan_scene, camera, 1024, n_frustum).n_triangles, n_frustum);
    EXPECT_EQ(plan_lod_within(plan_scene, camera, 1024, 0).n_triangles, n_coarsest);
    for (const double error_px : {0.3, 2.0, 20.0}) {
      const std::size_t n = plan_lod(plan_scene, camera, 1024, error_px).n_triangles;
      const FramePlan plan = plan_lod_within(plan_scene, camera, 1024, n);
      EXPECT_LE(plan.n_triangles, n);
      EXPECT_GE(plan.n_triangles, plan_lod(plan_scene, camera, 1024, 1.01 * error_px).n_triangles);
      EXPECT_EQ(drawn(plan), drawn(plan_frustum(plan_scene, camera)));
    }
  }
}

}  // namespace
}  // namespace viewcell

#include "draw/scene_renderer.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/srgb.h"
#include "draw/gl_fixture.h"
#include "draw/raycast.h"
#include "draw/shading.h"
#include "draw/small_scene.h"
#include "image/pixels.h"
#include "play/floor_quad.h"

namespace viewcell {
namespace {

constexpr int kFrameSize = 192;

struct Stage {
  explicit Stage(Scene scene_in, bool with_lod = false)
      : scene(std::move(scene_in)),
        levels(build_scene_levels(scene, with_lod)),
        plan_scene(make_plan_scene(scene, levels)),
        renderer(shared_context().gl(), scene, levels),
        target(shared_context().gl(), kFrameSize, kFrameSize) {}
  ImageRgba8 draw(const Camera& camera, const FramePlan& plan) const {
    return draw_frame(renderer, target, clip_from_world(camera), plan.draws);
  }
  Scene scene;
  std::vector<MeshLevels> levels;
  PlanScene plan_scene;
  SceneRenderer renderer;
  GlFramebuffer target;
};

TEST(Shading, QuickCurveIsWithinItsBound) {
  float worst = 0;
  for (int i = 0; i <= 1000000; ++i) {
    const float x = static_cast<float>(i) * 1e-6f;
    worst = std::max(worst, std::abs(quick_srgb_encode(x) - srgb_encode(x)));
  }
  EXPECT_LT(worst, kQuickSrgbError);
  EXPECT_EQ(quick_srgb_encode(-1), 0);
  EXPECT_EQ(quick_srgb_encode(0), 0);
  EXPECT_NEAR(quick_srgb_encode(7), 1, kQuickSrgbError);
}

// One pixel a normal: the shader's text against shade() and quick_srgb_encode().
TEST(Shading, ShaderIsTheTwinOfTheFunction) {
  const Gl& gl = shared_context().gl();
  Lighting lighting;
  lighting.toward_light = glm::normalize(glm::vec3(1, 2, -3));
  lighting.light = {2, 1, 0};  // whole numbers: GLSL must still take them for floats
  lighting.ambient_sky = {1e-7f, 0.5f, 1};
  const GlProgram program(
      gl, "twin",
      "#version 450 core\nvoid main() {\n"
      "  gl_Position = vec4((gl_VertexID & 1) * 4 - 1, (gl_VertexID >> 1) * 4 - 1, 0.5, 1);\n}\n",
      "#version 450 core\nlayout(location = 0) out vec4 color;\n" + make_shading_glsl(lighting) +
          "void main() {\n  vec3 n = normalize(vec3(gl_FragCoord.xy - 8.0, 2.0));\n"
          "  color = vec4(srgb_encode(shade(vec3(0.9, 0.5, 0.01), n)), 1);\n}\n");
  const GlFramebuffer target(gl, 16, 16, {GL_RGBA32F});
  const GlVertexArray array(gl);
  target.bind();
  target.clear({0, 0, 0, 0});
  program.use();
  array.bind();
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  const ImageRgbaFloat image = target.read_rgba_float(0);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const glm::vec3 n = glm::normalize(
          glm::vec3(static_cast<float>(x) + 0.5f - 8, 16 - static_cast<float>(y) - 0.5f - 8, 2));
      const glm::vec3 expected = shade(lighting, {0.9f, 0.5f, 0.01f}, n);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(image.at(x, y)[c], quick_srgb_encode(expected[c]), 2e-6) << x << "," << y;
    }
}

TEST(SceneRenderer, SkyAboveGroundBelow) {
  const Stage stage(make_small_scene(0));
  Camera camera;
  camera.eye = {0, 0, 10};
  const ImageRgba8 image = stage.draw(camera, {});
  for (int x = 0; x < kFrameSize; ++x) {
    for (int y = 0; y < kFrameSize / 2 - 1; ++y)
      ASSERT_EQ(image.at(x, y), encoded(stage.scene.lighting.sky_color, 0)) << x << "," << y;
    for (int y = kFrameSize / 2 + 1; y < kFrameSize; ++y)
      ASSERT_EQ(image.at(x, y), encoded(stage.scene.lighting.ground_color, 0)) << x << "," << y;
  }
}

// A wall 20 ahead, 10 high, facing the eye: x from 60 to 131, y from 60 to 131 of 192 px.
Scene make_wall_scene(double yaw_rad, bool double_sided) {
  Scene scene = make_small_scene(0);
  scene.materials[0].double_sided = double_sided;
  scene.meshes.push_back(make_scene_mesh("wall", make_wall(5)));
  SceneObject wall{"wall", MeshId(2), {0}, {20, 0, 0}, {1, 0, 0, 0}, 1};
  wall.rotation = glm::angleAxis(yaw_rad, glm::dvec3(0, 0, 1));
  scene.objects.push_back(wall);
  return scene;
}

Camera make_level_camera(double height) {
  Camera camera;
  camera.eye = {0, 0, height};
  return camera;
}

TEST(SceneRenderer, WallCoversItsPixelsInItsColour) {
  const Stage stage(make_wall_scene(0, false));
  const ImageRgba8 image = stage.draw(make_level_camera(5), plan_geometry(stage.plan_scene));
  const glm::vec3 lit =
      shade(stage.scene.lighting, stage.scene.materials[0].base_color, {-1, 0, 0});
  const double half_px = 0.5 * kFrameSize / std::tan(glm::radians(30.0)) * 5 / 20;
  for (int y = 0; y < kFrameSize; ++y)
    for (int x = 0; x < kFrameSize; ++x) {
      const double dx = std::abs(x + 0.5 - kFrameSize / 2.0),
                   dy = std::abs(y + 0.5 - kFrameSize / 2.0);
      const bool inside = dx < half_px && dy < half_px;
      ASSERT_EQ(image.at(x, y)[3], inside ? 255 : 0) << x << "," << y;
      if (inside) {
        ASSERT_LE(most_difference(image.at(x, y), encoded(lit, 255)), 1) << x << "," << y;
      }
    }
}

TEST(SceneRenderer, BacksShowOnlyWhenDoubleSidedInBothEngines) {
  for (const bool back : {false, true})
    for (const bool double_sided : {false, true}) {
      SCOPED_TRACE(testing::Message() << "back " << back << " double-sided " << double_sided);
      const Stage stage(make_wall_scene(back ? glm::pi<double>() : 0, double_sided));
      const Camera camera = make_level_camera(5);
      const ImageRgba8 raster = stage.draw(camera, plan_geometry(stage.plan_scene));
      ImageRgba8 cast(kFrameSize, kFrameSize);
      RayCaster(stage.scene).draw(camera, cast);
      const Rgba8 middle = raster.at(kFrameSize / 2, kFrameSize / 2);
      EXPECT_EQ(middle[3], back && !double_sided ? 0 : 255);
      EXPECT_LE(most_difference(middle, cast.at(kFrameSize / 2, kFrameSize / 2)), 1);
      // A back is lit as the front that faces the same way.
      if (middle[3] == 255) {
        const glm::vec3 lit =
            shade(stage.scene.lighting, stage.scene.materials[0].base_color, {-1, 0, 0});
        EXPECT_LE(most_difference(middle, encoded(lit, 255)), 1);
      }
    }
}

TEST(SceneRenderer, ObjectsUnderTheGroundShowInBothEngines) {
  Scene scene = make_wall_scene(0, false);
  scene.objects[0].translation.z = -30;
  const Stage stage(scene);
  Camera camera = make_level_camera(5);
  camera.forward = glm::normalize(glm::dvec3(20, 0, -30));
  const ImageRgba8 raster = stage.draw(camera, plan_geometry(stage.plan_scene));
  ImageRgba8 cast(kFrameSize, kFrameSize);
  RayCaster(stage.scene).draw(camera, cast);
  EXPECT_EQ(raster.at(kFrameSize / 2, kFrameSize / 2)[3], 255);
  EXPECT_EQ(cast.at(kFrameSize / 2, kFrameSize / 2)[3], 255);
}

TEST(SceneRenderer, FrustumEqualsGeometryPixelForPixel) {
  const Stage stage(make_small_scene(60, 7));
  Random random(11);
  std::size_t n_covered = 0;
  for (int k = 0; k < 12; ++k) {
    const Camera camera = random_camera(random);
    const FramePlan frustum = plan_frustum(stage.plan_scene, camera);
    EXPECT_LT(frustum.draws.size(), stage.scene.objects.size());
    const ImageRgba8 a = stage.draw(camera, plan_geometry(stage.plan_scene));
    const ImageRgba8 b = stage.draw(camera, frustum);
    EXPECT_EQ(a.pixels, b.pixels) << "view " << k;
    for (const Rgba8& p : a.pixels) n_covered += p[3] == 255;
  }
  EXPECT_GT(n_covered, 10000u);
}

TEST(SceneRenderer, LevelsLookLikeTheOriginal) {
  const Stage stage(make_small_scene(60, 7, 80), true);
  Random random(11);
  std::size_t n_original = 0, n_levels = 0;
  for (int k = 0; k < 6; ++k) {
    const Camera camera = random_camera(random);
    const FramePlan frustum = plan_frustum(stage.plan_scene, camera);
    const FramePlan lod = plan_lod(stage.plan_scene, camera, kFrameSize);
    n_original += frustum.n_triangles;
    n_levels += lod.n_triangles;
    EXPECT_GT(psnr_db(stage.draw(camera, frustum), stage.draw(camera, lod)), 30);
  }
  EXPECT_LT(3 * n_levels, n_original);
}

// The engines may differ where a pixel centre lies on a silhouette, and by rounding elsewhere.
TEST(SceneRenderer, RaysSeeWhatTheRasteriserDraws) {
  const Stage stage(make_small_scene(60, 7));
  const RayCaster caster(stage.scene);
  Random random(13);
  for (int k = 0; k < 8; ++k) {
    SCOPED_TRACE(testing::Message() << "view " << k);
    const Camera camera = random_camera(random);
    const ImageRgba8 raster = stage.draw(camera, plan_frustum(stage.plan_scene, camera));
    ImageRgba8 cast(kFrameSize, kFrameSize);
    caster.draw(camera, cast);
    std::size_t n_different = 0;
    for (std::size_t i = 0; i < raster.pixels.size(); ++i)
      n_different += most_difference(raster.pixels[i], cast.pixels[i]) > 2;
    EXPECT_LE(n_different, raster.pixels.size() / 2000);
    EXPECT_GT(psnr_db(raster, cast), 45);
  }
}

TEST(RayCaster, SamePixelsForAnyNumberOfThreads) {
  const Scene scene = make_small_scene(20, 7);
  Random random(17);
  const Camera camera = random_camera(random);
  ImageRgba8 one(101, 67), three(101, 67);  // not a multiple of a tile
  RayCaster(scene, 1).draw(camera, one);
  RayCaster(scene, 3).draw(camera, three);
  EXPECT_EQ(one.pixels, three.pixels);
}

TEST(RayCaster, WantOfMemoryIsTheMachinesFault) {
  const Scene scene = make_small_scene(20, 7);
  for (const std::size_t budget_bytes : {1u << 10, 1u << 14})
    EXPECT_THROW(RayCaster(scene, 2, budget_bytes), MachineError);
  EXPECT_NO_THROW(RayCaster(scene, 2, 1u << 28));
}

TEST(SceneRenderer, ShiftByWholePixelsMovesThePicture) {
  const Stage stage(make_small_scene(60, 7));
  Random random(19);
  const Camera camera = random_camera(random);
  const FramePlan plan = plan_geometry(stage.plan_scene);
  const ImageRgba8 still = stage.draw(camera, plan);
  const ImageRgba8 moved = draw_frame(
      stage.renderer, stage.target,
      shift_pixels(clip_from_world(camera), {3, -2}, kFrameSize, kFrameSize), plan.draws);
  std::size_t n_different = 0;
  for (int y = 2; y < kFrameSize; ++y)
    for (int x = 0; x + 3 < kFrameSize; ++x)
      n_different += most_difference(still.at(x, y), moved.at(x + 3, y - 2)) > 2;
  EXPECT_LE(n_different, 20u);
}

TEST(FloorQuad, CoversEveryPixelWithItsPattern) {
  const Gl& gl = shared_context().gl();
  const GlFramebuffer target(gl, 64, 64);
  FloorQuad(gl, 64, 64).draw(target);
  const ImageRgba8 image = target.read_rgba8();
  std::size_t n_black = 0;
  for (const Rgba8& p : image.pixels) n_black += p == Rgba8{0, 0, 0, 0};
  EXPECT_EQ(n_black, 0u);
  EXPECT_NE(image.at(3, 3), image.at(30, 40));
}

TEST(SceneRenderer, StyleReplacesMaterialColours) {
  const Stage stage(make_wall_scene(0, false));
  const Camera camera = make_level_camera(5);
  DrawStyle style;
  style.base_color = glm::vec3(0.1f, 0.9f, 0.2f);
  stage.renderer.draw_background(stage.target, clip_from_world(camera));
  stage.renderer.draw_objects(clip_from_world(camera), plan_geometry(stage.plan_scene).draws,
                              style);
  const glm::vec3 lit = shade(stage.scene.lighting, *style.base_color, {-1, 0, 0});
  EXPECT_LE(most_difference(stage.target.read_rgba8().at(kFrameSize / 2, kFrameSize / 2),
                            encoded(lit, 255)),
            1);
}

}  // namespace
}  // namespace viewcell

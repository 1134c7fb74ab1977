// Every kind of material in the engines that draw frames.
#include <gtest/gtest.h>

#include "draw/gl_fixture.h"
#include "draw/raycast.h"
#include "scene/material_scene.h"

namespace viewcell {
namespace {

constexpr int kSize = 384;

Camera camera_at(double angle, double distance, double height) {
  Camera camera;
  camera.eye = {distance * std::cos(angle), distance * std::sin(angle), height};
  camera.forward = glm::normalize(glm::dvec3(0, 0, 2) - camera.eye);
  return camera;
}

struct Engines {
  explicit Engines(Scene scene_in)
      : scene(std::move(scene_in)),
        levels(build_scene_levels(scene, false)),
        plan(make_plan_scene(scene, levels)),
        renderer(shared_context().gl(), scene, levels),
        caster(scene, 2) {}
  ImageRgba8 raster(const Camera& camera) const {
    const GlFramebuffer target(shared_context().gl(), kSize, kSize);
    return draw_frame(renderer, target, clip_from_world(camera), plan_geometry(plan).draws);
  }
  ImageRgba8 rays(const Camera& camera) const {
    ImageRgba8 image(kSize, kSize);
    caster.draw(camera, image);
    return image;
  }
  Scene scene;
  std::vector<MeshLevels> levels;
  PlanScene plan;
  SceneRenderer renderer;
  RayCaster caster;
};

// Of pixels that both cover: mean squared error of codes, as dB; and how many one alone covers.
struct Agreement {
  double db = 0;
  std::size_t n_both = 0, n_one = 0;
};

Agreement compare(const ImageRgba8& a, const ImageRgba8& b) {
  Agreement out;
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    if ((a.pixels[i][3] > 0) != (b.pixels[i][3] > 0)) ++out.n_one;
    if (a.pixels[i][3] == 0 || b.pixels[i][3] == 0) continue;
    ++out.n_both;
    for (std::size_t c = 0; c < 3; ++c) {
      const double off = double(a.pixels[i][c]) - b.pixels[i][c];
      sum += off * off;
    }
  }
  out.db = 10 * std::log10(255 * 255 * 3 * double(out.n_both) / std::max(sum, 1e-9));
  return out;
}

TEST(Materials, RaysAndRasteriserAgree) {
  const Engines all(make_material_scene());
  for (int i = 0; i < 6; ++i) {
    const Camera camera = camera_at(1.1 * i, i % 2 == 0 ? 24 : 40, 3 + 2 * i);
    const Agreement a = compare(all.raster(camera), all.rays(camera));
    std::printf("%d: %.1f dB over %zu pixels, %zu of one alone\n", i, a.db, a.n_both, a.n_one);
    EXPECT_GT(a.n_both, 4000u);
    EXPECT_GT(a.db, 45) << i;
    EXPECT_LT(a.n_one, a.n_both / 100) << i;
  }
}

// Frames of other shapes and angles: the same in both engines, and the middle of a wide frame is
// the narrow one.
TEST(Materials, WideFramesAgree) {
  const Scene scene = make_material_scene();
  const auto levels = build_scene_levels(scene, false);
  const PlanScene plan = make_plan_scene(scene, levels);
  const SceneRenderer renderer(shared_context().gl(), scene, levels);
  const RayCaster caster(scene, 2);
  const Camera camera = camera_at(0.4, 24, 6);
  const auto draw = [&](const Camera& with, int width, int height) {
    const GlFramebuffer target(shared_context().gl(), width, height);
    const ImageRgba8 raster =
        draw_frame(renderer, target, clip_from_world(with), plan_frustum(plan, with).draws);
    ImageRgba8 rays(width, height);
    caster.draw(with, rays);
    const Agreement a = compare(raster, rays);
    EXPECT_GT(a.db, 45);
    EXPECT_GT(a.n_both, 4000u);
    EXPECT_LT(a.n_one, a.n_both / 100);
    return raster;
  };
  const ImageRgba8 square = draw(with_frame(camera, 60, 1), 270, 270);
  const ImageRgba8 wide = draw(with_frame(camera, 60, 16.0 / 9), 480, 270);
  std::size_t n_same = 0;
  for (int y = 0; y < 270; ++y)
    for (int x = 0; x < 270; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        n_same += std::abs(square.at(x, y)[c] - wide.at(x + 105, y)[c]) <= 4;
  EXPECT_GT(n_same, 3 * 0.98 * 270 * 270);  // but for rounding at edges
  draw(with_frame(camera, 75, 16.0 / 9), 480, 270);
  draw(with_frame(camera, 40, 0.5), 200, 400);
}

// By clusters and a call for each material: the same pixels, in fewer calls.
TEST(Materials, BatchesDrawTheSamePixels) {
  Engines all(make_material_scene());
  std::vector<ObjectId> objects;
  for (std::size_t o = 0; o < all.scene.objects.size(); ++o) objects.push_back(ObjectId(o));
  for (int i = 0; i < 6; ++i) {
    const Camera camera = camera_at(0.9 * i, i % 2 == 0 ? 24 : 6, 3 + 2 * i);
    const GlFramebuffer target(shared_context().gl(), kSize, kSize);
    all.renderer.draw_background(target, clip_from_world(camera));
    const SceneRenderer::Drawn drawn = all.renderer.draw_clusters(camera, objects);
    EXPECT_EQ(target.read_rgba8().pixels, all.raster(camera).pixels) << i;
    EXPECT_GT(drawn.n_triangles, 0u);
    EXPECT_LE(drawn.n_calls, all.scene.materials.size());
  }
}

// Each kind by itself, so that the one at fault has a name.
TEST(Materials, RaysAndRasteriserAgreeOnEach) {
  const Scene scene = make_material_scene();
  for (const SceneObject& object : scene.objects) {
    Scene one = scene;
    one.objects = {object};
    const Engines engines(std::move(one));
    Camera camera = camera_at(0.7, 9, 3);
    camera.eye += object.translation,
        camera.forward = glm::normalize(object.translation - camera.eye);
    const Agreement a = compare(engines.raster(camera), engines.rays(camera));
    std::printf("%s: %.1f dB over %zu pixels, %zu of one alone\n", object.name.c_str(), a.db,
                a.n_both, a.n_one);
    EXPECT_GT(a.db, 45) << object.name;
    EXPECT_GT(a.n_both, 5000u) << object.name;
    EXPECT_LT(a.n_one, a.n_both / 100) << object.name;
  }
}

// A wall 8 wide before an eye 8 away: the picture's four quarters stand where they should.
TEST(Materials, PictureStandsUpright) {
  Scene scene;
  scene.area = {{-10, -10}, {10, 10}};
  ImageRgba8 quarters(2, 2);
  quarters.pixels = {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {255, 255, 0, 255}};
  scene.materials = {{.base_color = glm::vec3(1),
                      .is_unlit = true,
                      .wrap_u = Wrap::clamp,
                      .wrap_v = Wrap::clamp,
                      .picture = add_picture(scene, quarters)}};
  TriMesh wall;  // seen from -x: left is +y
  wall.positions = {{8, 4, -4}, {8, -4, -4}, {8, -4, 4}, {8, 4, 4}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  wall.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
  scene.meshes = {make_dressed_mesh(wall, "wall")};
  scene.objects.resize(1);
  const Engines engines(std::move(scene));
  Camera camera;
  camera.eye = {0, 0, 0.01};
  for (const ImageRgba8& image : {engines.raster(camera), engines.rays(camera)}) {
    const int a = kSize / 2 - 120, b = kSize / 2 + 120;
    EXPECT_EQ(image.at(a, a), (Rgba8{255, 0, 0, 255}));
    EXPECT_EQ(image.at(b, a), (Rgba8{0, 255, 0, 255}));
    EXPECT_EQ(image.at(a, b), (Rgba8{0, 0, 255, 255}));
    EXPECT_EQ(image.at(b, b), (Rgba8{255, 255, 0, 255}));
  }
}

// A floor of fine stripes, far away: it is the stripes' mean, not some of them.
TEST(Materials, PicturesDoNotAlias) {
  Scene scene;
  scene.area = {{-10, -10}, {10, 10}};
  ImageRgba8 stripes(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      stripes.at(x, y) = x % 2 ? Rgba8{255, 255, 255, 255} : Rgba8{0, 0, 0, 255};
  scene.materials = {
      {.base_color = glm::vec3(1), .is_unlit = true, .picture = add_picture(scene, stripes)}};
  TriMesh wall;
  wall.positions = {{60, 40, -40}, {60, -40, -40}, {60, -40, 40}, {60, 40, 40}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  wall.texcoords = {{0, 0}, {37, 0}, {37, 37}, {0, 0}, {37, 37}, {0, 37}};
  scene.meshes = {make_dressed_mesh(wall, "wall")};
  scene.objects.resize(1);
  const Engines engines(std::move(scene));
  Camera camera;
  camera.eye = {0, 0, 0.01};
  for (const ImageRgba8& image : {engines.raster(camera), engines.rays(camera)})
    for (int y = kSize / 2 - 60; y < kSize / 2 + 60; ++y)
      for (int x = kSize / 2 - 60; x < kSize / 2 + 60; ++x)
        ASSERT_NEAR(image.at(x, y)[0], 188, 3) << x << ' ' << y;
}

// What `lod` draws of a papered box is that box: its picture keeps its seams.
TEST(Materials, LevelsKeepTheirPictures) {
  Scene scene = make_material_scene();
  const VertexLooks looks = scene.meshes[0].looks;
  const MeshLevels levels =
      build_mesh_levels(scene.meshes[0].mesh, {}, scene.meshes[0].weld, looks);
  const MeshLevel& first = levels[0];
  ASSERT_EQ(first.texcoords.size(), first.mesh.positions.size());
  ASSERT_EQ(first.mesh.positions.size(), 24u);
  ASSERT_EQ(first.slots.size(), 1u);
  EXPECT_EQ(first.slots[0].n_triangles, 12u);
  const SceneMesh& two = scene.meshes.back();
  const MeshLevels of_two = build_mesh_levels(two.mesh, {}, two.weld, two.looks);
  ASSERT_EQ(of_two[0].slots.size(), 2u);
  EXPECT_EQ(of_two[0].slots[0].n_triangles, 6u);
  EXPECT_EQ(of_two[0].slots[1].slot, 1);
  EXPECT_EQ(of_two[0].slots[1].first_triangle, 6u);
}

}  // namespace
}  // namespace viewcell

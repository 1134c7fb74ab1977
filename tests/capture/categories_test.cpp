#include "capture/categories.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "capture/ray_capture.h"
#include "capture/shapes.h"
#include "image/fill.h"

namespace viewcell {
namespace {

using Category = PixelCategory;

CaptureTile capture_one(const Scene& scene, const glm::dvec3& eye) {
  const auto viewed =
      choose_view(eye, world_points(scene, scene.objects[0]), {.resolution_px = 512});
  return RayCapture(scene, 1).capture(ObjectId(0), viewed->view, viewed->crop);
}

std::map<Category, std::size_t> count(const Image<Category>& image) {
  std::map<Category, std::size_t> counts;
  for (const Category c : image.pixels) ++counts[c];
  return counts;
}

// Squares that look towards -x.
void add_square(TriMesh& mesh, const glm::dvec3& corner, const glm::dvec3& to_right,
                const glm::dvec3& upward) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::dvec3& p :
       {corner, corner + to_right, corner + to_right + upward, corner + upward})
    mesh.positions.emplace_back(p);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

Scene make_scene_with(TriMesh mesh) {
  mesh.normals = make_vertex_normals(mesh);
  return make_scene_of(std::move(mesh));
}

// A plane has silhouettes only where it ends, however steeply it is seen.
TEST(ClassifyPixels, PlaneAtAGrazingAngleHasNoInnerEdges) {
  for (const double height : {1.0, 4.0, 18.0}) {
    SCOPED_TRACE(height);
    TriMesh mesh;
    add_square(mesh, {20, 30, 0}, {0, -60, 0}, {300, 0, 0});  // level, seen from above
    const CaptureTile tile = capture_one(make_scene_with(mesh), {0, 0, height});
    const auto categories = classify_pixels(tile);
    auto counts = count(categories);
    EXPECT_GT(counts[Category::exterior_silhouette], 100u);
    EXPECT_EQ(counts[Category::sharp_edge], 0u);
    EXPECT_EQ(counts[Category::interior_silhouette], 0u);
    for (int y = 0; y < tile.crop.height_px; ++y)
      for (int x = 0; x < tile.crop.width_px; ++x) {
        const auto sees = [&](int i, int j) {
          return i >= 0 && j >= 0 && i < tile.crop.width_px && j < tile.crop.height_px &&
                 tile.is_seen(i, j);
        };
        if (!tile.is_seen(x, y)) {
          EXPECT_EQ(categories.at(x, y), Category::background);
          continue;
        }
        const bool is_rim =
            !sees(x - 1, y) || !sees(x + 1, y) || !sees(x, y - 1) || !sees(x, y + 1);
        EXPECT_EQ(categories.at(x, y) == Category::exterior_silhouette, is_rim);
      }
  }
}

//        far, x = 100          the row in the middle runs  far ... far near ... near far ... far
//    +-----------------+
//    |    +-------+    |
//    |    | near  |    |
TEST(ClassifyPixels, StepIsASilhouetteOnItsNearSideOnly) {
  TriMesh mesh;
  add_square(mesh, {100, 40, -40}, {0, -80, 0}, {0, 0, 80});
  add_square(mesh, {50, 8, -8}, {0, -16, 0}, {0, 0, 16});
  const CaptureTile tile = capture_one(make_scene_with(mesh), {0, 0, 0});
  const auto categories = classify_pixels(tile);
  std::size_t n_edge = 0;
  for (int y = 1; y + 1 < tile.crop.height_px; ++y)
    for (int x = 1; x + 1 < tile.crop.width_px; ++x) {
      if (!tile.is_seen(x, y) || categories.at(x, y) == Category::exterior_silhouette) continue;
      const auto is_near = [&](int i, int j) { return tile.inverse_depth.at(i, j) > 0.015f; };
      const bool is_rim_of_near = is_near(x, y) && !(is_near(x - 1, y) && is_near(x + 1, y) &&
                                                     is_near(x, y - 1) && is_near(x, y + 1));
      EXPECT_EQ(categories.at(x, y) == Category::interior_silhouette, is_rim_of_near)
          << x << " " << y;
      n_edge += is_rim_of_near;
    }
  EXPECT_GT(n_edge, 200u);
}

// Two planes that meet at a ridge before the eye, x = 40 + 6 |y|: 1/depth changes by 3.4e-4 a pixel
// on either side, so its second difference at the ridge is at least that.
TEST(ClassifyPixels, RidgeIsASharpEdge) {
  for (const double slope : {6.0, -6.0}) {  // a ridge, and a valley from behind it
    SCOPED_TRACE(slope);
    const double x0 = slope > 0 ? 40 : 52, x1 = x0 + 2 * slope;
    TriMesh mesh;
    add_square(mesh, {x1, 2, -6}, {x0 - x1, -2, 0}, {0, 0, 12});
    add_square(mesh, {x0, 0, -6}, {x1 - x0, -2, 0}, {0, 0, 12});
    const CaptureTile tile = capture_one(make_scene_with(mesh), {0, 0, 0});
    const auto categories = classify_pixels(tile);
    const int ridge = static_cast<int>(std::floor(
                          choose_view({0, 0, 0}, world_points(make_scene_with(mesh), SceneObject{}),
                                      {.resolution_px = 512})
                              ->view.project({x0, 0, 0})
                              .x)) -
                      tile.crop.x;
    std::size_t n_rows = 0;
    for (int y = 0; y < tile.crop.height_px; ++y) {
      bool has_edge = false;
      for (int x = 0; x < tile.crop.width_px; ++x) {
        if (categories.at(x, y) == Category::sharp_edge) {
          EXPECT_NEAR(x, ridge, 1);
          has_edge = true;
        }
        EXPECT_NE(categories.at(x, y), Category::interior_silhouette);
      }
      n_rows += has_edge;
    }
    EXPECT_GT(n_rows, 60u);
  }
}

// What is behind the object, or filled in there, does not matter; nor does the unit.
TEST(ClassifyPixels, DependsOnTheObjectAlone) {
  const Scene scene = make_scene_of(make_noisy_torus(40, 20, 0.5, 1));
  const CaptureTile tile = capture_one(scene, {50, 20, 8});
  const auto expected = classify_pixels(tile);
  auto counts = count(expected);
  EXPECT_GT(counts[Category::sharp_edge], 0u);
  EXPECT_GT(counts[Category::interior_silhouette], 0u);
  EXPECT_GT(counts[Category::interior], 100u);

  CaptureTile filled = tile;
  push_pull_fill(filled.color, filled.inverse_depth);
  EXPECT_EQ(classify_pixels(filled).pixels, expected.pixels);

  Random random(2);
  CaptureTile noisy = tile;
  for (std::size_t i = 0; i < noisy.color.pixels.size(); ++i)
    if (noisy.color.pixels[i][3] == 0)
      noisy.inverse_depth.pixels[i] = static_cast<float>(random.uniform(0, 1));
  EXPECT_EQ(classify_pixels(noisy).pixels, expected.pixels);

  CaptureTile scaled = tile;  // the scene in units 1/8 as long, the near plane with it
  for (float& w : scaled.inverse_depth.pixels) w /= 8;
  EXPECT_EQ(classify_pixels(scaled, {.near = 8}).pixels, expected.pixels);
}

TEST(ClassifyPixels, SmallObjectsAreAllRim) {
  CaptureTile tile;
  tile.crop = {0, 0, 3, 3};
  tile.color = ImageRgbaFloat(3, 3);
  tile.inverse_depth = Image<float>(3, 3);
  EXPECT_EQ(count(classify_pixels(tile))[Category::background], 9u);
  tile.color.at(1, 1) = {1, 1, 1, 1};
  tile.inverse_depth.at(1, 1) = 0.01f;
  EXPECT_EQ(classify_pixels(tile).at(1, 1), Category::exterior_silhouette);
  for (RgbaFloat& pixel : tile.color.pixels) pixel[3] = 1;  // fills its crop: still a rim
  for (float& w : tile.inverse_depth.pixels) w = 0.01f;
  EXPECT_EQ(classify_pixels(tile).at(0, 1), Category::exterior_silhouette);
  EXPECT_EQ(classify_pixels(tile).at(1, 1), Category::interior);
}

}  // namespace
}  // namespace viewcell

#include "capture/ray_capture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "capture/shapes.h"
#include "common/same_every_time.h"

namespace viewcell {
namespace {

ViewedObject look_at(const Scene& scene, const glm::dvec3& eye) {
  const auto viewed =
      choose_view(eye, world_points(scene, scene.objects[0]), {.resolution_px = 256});
  if (!viewed) throw std::runtime_error("no view");
  return *viewed;
}

CaptureTile capture(const Scene& scene, const ViewedObject& viewed) {
  return RayCapture(scene, 1).capture(ObjectId(0), viewed.view, viewed.crop);
}

int code(float linear) {
  return srgb8_from_linear(linear);
}

void expect_color(const RgbaFloat& found, const glm::vec3& expected, int codes) {
  EXPECT_NEAR(code(found[0]), code(expected.x), codes);
  EXPECT_NEAR(code(found[1]), code(expected.y), codes);
  EXPECT_NEAR(code(found[2]), code(expected.z), codes);
}

// The nearer root of |o + t d - c| = r, or the farther.
double hit_sphere(const glm::dvec3& o, const glm::dvec3& d, const glm::dvec3& c, double r,
                  int sign) {
  const glm::dvec3 m = o - c;
  const double a = glm::dot(d, d), b = glm::dot(m, d), q = glm::dot(m, m) - r * r;
  const double root = b * b - a * q;
  return root < 0 ? -1 : (-b + sign * std::sqrt(root)) / a;
}

struct SphereCase {
  Scene scene;
  glm::dvec3 centre{700, -300, 25};
  double radius = 0;
  glm::dvec3 eye{640, -290, 18};

  SphereCase(bool inside_out, bool double_sided) {
    TriMesh mesh = make_sphere(5, 240, 120);
    if (inside_out)
      for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    scene = make_scene_of(mesh, double_sided);
    scene.objects[0].translation = centre;
    scene.objects[0].rotation = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    scene.objects[0].scale = 3;
    radius = 15;
  }
};

// Depth and colour at every pixel well inside the disc, and nothing outside it.
void expect_sphere(const SphereCase& c, int root_sign, double normal_sign) {
  const ViewedObject viewed = look_at(c.scene, c.eye);
  const CaptureTile tile = capture(c.scene, viewed);
  std::size_t n_seen = 0;
  for (int y = 0; y < tile.crop.height_px; ++y)
    for (int x = 0; x < tile.crop.width_px; ++x) {
      const glm::dvec3 ray = viewed.view.ray(tile.crop.x + x + 0.5, tile.crop.y + y + 0.5);
      EXPECT_FALSE(tile.is_seen(x, y) &&
                   hit_sphere(c.eye, ray, c.centre, c.radius * 1.001, -1) < 0);
      if (hit_sphere(c.eye, ray, c.centre, c.radius * 0.99, -1) < 0) continue;
      ASSERT_TRUE(tile.is_seen(x, y));
      ++n_seen;
      const double depth = hit_sphere(c.eye, ray, c.centre, c.radius, root_sign);
      EXPECT_NEAR(1 / tile.inverse_depth.at(x, y), depth, 0.05);
      const glm::vec3 normal(normal_sign * (c.eye + depth * ray - c.centre) / c.radius);
      expect_color(tile.color.at(x, y),
                   shade(c.scene.lighting, c.scene.materials[0].base_color, normal), 2);
    }
  EXPECT_GT(n_seen, 5000u);
}

TEST(RayCapture, SphereAsTheClosedFormHasIt) {
  expect_sphere(SphereCase(false, false), -1, 1);
}

// Turned inside out, its near side is back-facing: the eye sees the far side from within. (The
// vertex normals stay as they were.)
TEST(RayCapture, InsideOutSphereShowsItsFarSide) {
  expect_sphere(SphereCase(true, false), +1, 1);
}

// Double-sided, the near side's back is seen, lit as if its normal looked at the eye.
TEST(RayCapture, DoubleSidedBackIsSeenWithTheNormalTurned) {
  expect_sphere(SphereCase(true, true), -1, -1);
  expect_sphere(SphereCase(false, true), -1, 1);
}

//  A square in the plane x = 0, counter-clockwise seen from -x.
Scene make_wall(bool double_sided) {
  TriMesh mesh;
  mesh.positions = {{0, 10, 0}, {0, -10, 0}, {0, -10, 20}, {0, 10, 20}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.normals.assign(4, {-1, 0, 0});
  return make_scene_of(mesh, double_sided);
}

std::size_t count_seen(const CaptureTile& tile) {
  std::size_t n = 0;
  for (const RgbaFloat& pixel : tile.color.pixels) n += pixel[3] > 0.5f;
  return n;
}

TEST(RayCapture, WallIsSeenFromItsFrontOnlyUnlessDoubleSided) {
  for (const bool double_sided : {false, true}) {
    const Scene scene = make_wall(double_sided);
    const CaptureTile front = capture(scene, look_at(scene, {-40, 3, 12}));
    const CaptureTile back = capture(scene, look_at(scene, {40, 3, 12}));
    EXPECT_GT(count_seen(front), 5000u);
    EXPECT_TRUE(double_sided ? count_seen(back) > 5000 : count_seen(back) == 0);
    const auto middle = [](const CaptureTile& tile) {
      return tile.color.at(tile.crop.width_px / 2, tile.crop.height_px / 2);
    };
    const glm::vec3 base = scene.materials[0].base_color;
    expect_color(middle(front), shade(scene.lighting, base, {-1, 0, 0}), 0);
    if (double_sided) expect_color(middle(back), shade(scene.lighting, base, {1, 0, 0}), 0);
  }
}

// 1/depth of a plane is affine in the image, whatever the angle.
TEST(RayCapture, InverseDepthIsAffineOnAPlane) {
  const Scene scene = make_wall(false);
  const glm::dvec3 eye{-9, 40, 15};
  const ViewedObject viewed = look_at(scene, eye);
  const CaptureTile tile = capture(scene, viewed);
  for (int y = 0; y < tile.crop.height_px; ++y)
    for (int x = 0; x < tile.crop.width_px; ++x) {
      if (!tile.is_seen(x, y)) continue;
      const glm::dvec3 ray = viewed.view.ray(tile.crop.x + x + 0.5, tile.crop.y + y + 0.5);
      EXPECT_NEAR(tile.inverse_depth.at(x, y), -ray.x / eye.x, 1e-6);
    }
  EXPECT_GT(count_seen(tile), 1000u);
}

// Outside the object all is zero, which push_pull_fill counts on.
TEST(RayCapture, UnseenPixelsAreZero) {
  const SphereCase c(false, false);
  const CaptureTile tile = capture(c.scene, look_at(c.scene, c.eye));
  for (std::size_t i = 0; i < tile.color.pixels.size(); ++i)
    if (tile.color.pixels[i][3] == 0) {
      EXPECT_EQ(tile.color.pixels[i], (RgbaFloat{0, 0, 0, 0}));
      EXPECT_EQ(tile.inverse_depth.pixels[i], 0);
    }
}

// A part of a crop is that part of the whole: packets at its edges do not matter.
TEST(RayCapture, CropsAgree) {
  const SphereCase c(false, false);
  const ViewedObject viewed = look_at(c.scene, c.eye);
  const CaptureTile whole = capture(c.scene, viewed);
  const Crop part{viewed.crop.x + 13, viewed.crop.y + 6, 41, 37};
  const CaptureTile tile = capture(c.scene, {viewed.view, part});
  for (int y = 0; y < part.height_px; ++y)
    for (int x = 0; x < part.width_px; ++x) {
      EXPECT_EQ(tile.is_seen(x, y), whole.is_seen(x + 13, y + 6));
      EXPECT_NEAR(tile.inverse_depth.at(x, y), whole.inverse_depth.at(x + 13, y + 6), 1e-8);
    }
}

TEST(RayCapture, ManyThreadsGiveTheSameBytes) {
  const SphereCase c(false, false);
  const ViewedObject viewed = look_at(c.scene, c.eye);
  const auto pixels = same_for_any_threads([&](int n_threads) {
    const RayCapture rays(c.scene, n_threads);
    return same_every_time([&](std::size_t) {
      const CaptureTile tile = rays.capture(ObjectId(0), viewed.view, viewed.crop);
      return std::pair(tile.color.pixels, tile.inverse_depth.pixels);
    });
  });
  EXPECT_GT(
      std::count_if(pixels.second.begin(), pixels.second.end(), [](float z) { return z > 0; }),
      1000);
}

// Not captures of nothing.
TEST(RayCapture, WantOfMemoryIsTheMachinesFault) {
  const SphereCase c(false, false);
  for (const std::size_t budget_bytes : {1u << 10, 1u << 20})
    EXPECT_THROW(RayCapture(c.scene, 2, budget_bytes), MachineError);
  EXPECT_NO_THROW(RayCapture(c.scene, 2, 1u << 28));
}

}  // namespace
}  // namespace viewcell

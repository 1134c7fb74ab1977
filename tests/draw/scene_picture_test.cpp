#include "draw/scene_picture.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "draw/frame_plan.h"

namespace viewcell {
namespace {

void extent_of(const glm::dmat4& clip, const Box& box, glm::dvec2& lo, glm::dvec2& hi) {
  lo = glm::dvec2(1e300), hi = glm::dvec2(-1e300);
  for (const glm::dvec3& corner : make_corners(box)) {
    const glm::dvec4 p = clip * glm::dvec4(corner, 1);
    EXPECT_GT(p.w, 0);
    lo = glm::min(lo, glm::dvec2(p) / p.w), hi = glm::max(hi, glm::dvec2(p) / p.w);
  }
}

// Boxes of any shape fill frames of any shape in one direction, from edge to edge.
TEST(ScenePicture, ShowsAllAndNotMuchElse) {
  Random random(3);
  for (int k = 0; k < 60; ++k) {
    Box box;
    const glm::dvec3 at(random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4), random.uniform(0, 9));
    box.add(at);
    box.add(at + glm::dvec3(std::exp(random.uniform(-1, 7)), std::exp(random.uniform(-1, 7)),
                            std::exp(random.uniform(-1, 5))));
    const double aspect = random.uniform(0.4, 2.5), fov = random.uniform(30, 90);
    glm::dvec2 lo, hi;
    for (const glm::dmat4& clip :
         {clip_from_world(look_from_corner(box, fov, aspect)), clip_from_above(box, aspect)}) {
      extent_of(clip, box, lo, hi);
      EXPECT_GE(std::min(lo.x, lo.y), -1.0 / 1.039) << k;
      EXPECT_LE(std::max(hi.x, hi.y), 1.0 / 1.039) << k;
      const bool is_wide = lo.x < -0.96 && hi.x > 0.96, is_high = lo.y < -0.96 && hi.y > 0.96;
      EXPECT_TRUE(is_wide || is_high) << k;
    }
  }
}

TEST(ScenePicture, FromAboveIsAMap) {
  Box box;
  box.add({10, 20, -3}), box.add({110, 70, 5});
  const glm::dmat4 clip = clip_from_above(box, 2);
  const glm::dvec4 middle = clip * glm::dvec4(60, 45, 0, 1), east = clip * glm::dvec4(70, 45, 0, 1);
  const glm::dvec4 north = clip * glm::dvec4(60, 55, 0, 1), up = clip * glm::dvec4(60, 45, 4, 1);
  EXPECT_NEAR(middle.x, 0, 1e-12);
  EXPECT_NEAR(middle.y, 0, 1e-12);
  EXPECT_GT(east.x, 0);
  EXPECT_NEAR(east.y, 0, 1e-12);
  EXPECT_GT(north.y, 0);
  EXPECT_NEAR(north.x, 0, 1e-12);
  EXPECT_NEAR(2 * east.x, north.y, 1e-12);  // a frame twice as wide as high
  EXPECT_GT(up.z, middle.z);                // what is higher is nearer
  for (const double z : {-3.0, 5.0}) {
    const glm::dvec4 p = clip * glm::dvec4(60, 45, z, 1);
    EXPECT_GT(p.z, 0);
    EXPECT_LT(p.z, 1);
  }
}

// A line through the middle, level: as wide as asked for, and nowhere else.
TEST(ScenePicture, LinesAreAsWideAsAskedFor) {
  const glm::dmat4 same(1);
  for (const double width : {1.0, 2.0, 5.0}) {
    ImageRgba8 image(64, 64, {0, 0, 0, 255});
    draw_over(image, same, std::vector<glm::dvec3>{{-2, 0, 0}, {2, 0, 0}}, false,
              {255, 255, 255, 255}, width);
    for (int x = 0; x < 64; ++x) {
      double sum = 0;
      for (int y = 0; y < 64; ++y) sum += image.at(x, y)[0] / 255.0;
      EXPECT_NEAR(sum, width, 0.02);
    }
  }
  // Closed, it comes back; what is behind the eye is not drawn.
  ImageRgba8 image(64, 64, {0, 0, 0, 255});
  const std::vector<glm::dvec3> triangle{{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0, 0.5, 0}};
  draw_over(image, same, triangle, false, {255, 0, 0, 255}, 1);
  const ImageRgba8 open = image;
  draw_over(image, same, triangle, true, {255, 0, 0, 255}, 1);
  EXPECT_NE(open.pixels, image.pixels);
  Camera camera;
  ImageRgba8 empty(64, 64, {0, 0, 0, 255});
  draw_over(empty, clip_from_world(camera), std::vector<glm::dvec3>{{-5, 1, 0}, {-9, -1, 0}}, true,
            {255, 255, 255, 255}, 3);
  EXPECT_EQ(empty.pixels, ImageRgba8(64, 64, {0, 0, 0, 255}).pixels);
}

}  // namespace
}  // namespace viewcell

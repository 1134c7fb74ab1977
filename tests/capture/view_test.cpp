#include "capture/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.h"

namespace viewcell {
namespace {

using Points = std::vector<glm::dvec3>;

Points make_box_points(const glm::dvec3& middle, const glm::dvec3& half) {
  Points points;
  for (int i = 0; i < 8; ++i)
    points.push_back(middle + half * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  return points;
}

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::degrees(std::acos(glm::dot(a, b) / glm::length(a) / glm::length(b)));
}

void expect_orthonormal(const CaptureView& view) {
  EXPECT_NEAR(glm::length(view.forward), 1, 1e-12);
  EXPECT_NEAR(glm::length(view.right), 1, 1e-12);
  EXPECT_NEAR(glm::length(glm::cross(view.right, view.up) + view.forward), 0, 1e-12);
  EXPECT_NEAR(view.right.z, 0, 1e-12);
  EXPECT_GT(view.up.z, 0);
}

void expect_all_inside(const ViewedObject& viewed, const Points& points) {
  for (const glm::dvec3& p : points) {
    const glm::dvec3 at = viewed.view.project(p);
    EXPECT_GT(at.z, 0);
    EXPECT_GE(at.x, viewed.crop.x + kCropMargin_px);
    EXPECT_LE(at.x, viewed.crop.x + viewed.crop.width_px - kCropMargin_px);
    EXPECT_GE(at.y, viewed.crop.y + kCropMargin_px);
    EXPECT_LE(at.y, viewed.crop.y + viewed.crop.height_px - kCropMargin_px);
  }
}

TEST(CaptureView, RayIsTheInverseOfProject) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    const glm::dvec3 eye{random.uniform(-900, 900), random.uniform(-900, 900), 18};
    const Points points =
        make_box_points(eye + glm::dvec3(random.uniform(-200, 200), random.uniform(-200, 200),
                                         random.uniform(-9, 9)),
                        glm::dvec3(random.uniform(1, 10)));
    const auto viewed = choose_view(eye, points, {});
    if (!viewed) continue;
    const double x = random.uniform(-500, 1500), y = random.uniform(-500, 1500);
    const double depth = random.uniform(0.1, 1000);
    const glm::dvec3 at = viewed->view.project(eye + depth * viewed->view.ray(x, y));
    EXPECT_NEAR(at.x, x, 1e-8);
    EXPECT_NEAR(at.y, y, 1e-8);
    EXPECT_NEAR(at.z, depth, 1e-9 * depth);
  }
}

// A side face spans 60 degrees of azimuth: resolution = 2 focal tan 30.
TEST(ChooseView, FaceIsSixtyDegreesWide) {
  const Points points = make_box_points({100, 60, 18}, glm::dvec3(2));
  const auto viewed = choose_view({0, 0, 18}, points, {.resolution_px = 1000});
  ASSERT_TRUE(viewed);
  EXPECT_EQ(viewed->view.source_px, 1000);
  EXPECT_NEAR(viewed->view.focal_px, 500 * std::sqrt(3.0), 1e-9);
  const double angle = glm::radians(59.999);  // all but the face's edge, at the eye's height
  const glm::dvec3 edge = viewed->view.project({std::cos(angle), std::sin(angle), 18});
  EXPECT_NEAR(edge.x, 0, 0.1);
  EXPECT_NEAR(edge.y, 500, 1e-9);
  EXPECT_NEAR(viewed->view.project({1, 0, 18}).x, 1000, 1e-9);
}

TEST(ChooseView, LooksThroughTheFaceOfTheObjectsMiddle) {
  for (int deg = 5; deg < 365; deg += 10) {
    SCOPED_TRACE(deg);
    const double angle = glm::radians(static_cast<double>(deg));
    const Points points =
        make_box_points({100 * std::cos(angle), 100 * std::sin(angle), 18}, glm::dvec3(1));
    const auto viewed = choose_view({0, 0, 18}, points, {});
    ASSERT_TRUE(viewed);
    expect_orthonormal(viewed->view);
    EXPECT_EQ(viewed->view.forward.z, 0);
    const double axis =
        glm::degrees(std::atan2(viewed->view.forward.y, viewed->view.forward.x)) + 360;
    EXPECT_NEAR(std::fmod(axis, 60), 30, 1e-9);
    EXPECT_LT(angle_deg(viewed->view.forward, glm::dvec3(std::cos(angle), std::sin(angle), 0)), 30);
  }
}

// Tall, near and straddling objects too, points of their sides included.
TEST(ChooseView, CropHoldsAllOfTheObject) {
  std::size_t n_turned = 0, n_overflowing = 0, n_viewed = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const glm::dvec3 eye{random.uniform(-99, 99), random.uniform(-99, 99), random.uniform(10, 20)};
    const double distance = random.uniform(15, 200), angle = random.uniform(0, 7);
    const glm::dvec3 half{random.uniform(1, 14), random.uniform(1, 14), random.uniform(1, 60)};
    const glm::dvec3 middle =
        eye + glm::dvec3(distance * std::cos(angle), distance * std::sin(angle), half.z - eye.z);
    Points points = make_box_points(middle, half);
    const auto viewed = choose_view(eye, points, {});
    if (!viewed) continue;
    ++n_viewed;
    for (int i = 0; i < 50; ++i)
      points.push_back(middle + half * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1),
                                                  random.uniform(-1, 1)));
    expect_all_inside(*viewed, points);
    expect_orthonormal(viewed->view);
    const double axis = glm::degrees(std::atan2(viewed->view.forward.y, viewed->view.forward.x));
    const bool is_turned = std::abs(std::fmod(axis + 360, 60) - 30) > 1e-6;
    n_turned += is_turned;
    n_overflowing += viewed->crop.y < 0 || viewed->crop.x < 0;
    for (const glm::dvec3& p : points)
      EXPECT_LE(angle_deg(p - eye, viewed->view.forward), is_turned ? kMostDeg : kTurnDeg);
  }
  EXPECT_GT(n_viewed, 900u);
  EXPECT_GT(n_turned, 20u);
  EXPECT_GT(n_overflowing, 100u);
}

// The crop is no larger than it must be.
TEST(ChooseView, CropIsTight) {
  const auto viewed = choose_view({0, 0, 18}, make_box_points({100, 60, 18}, glm::dvec3(2)), {});
  ASSERT_TRUE(viewed);
  glm::dvec2 lo(1e9), hi(-1e9);
  for (const glm::dvec3& p : make_box_points({100, 60, 18}, glm::dvec3(2))) {
    lo = glm::min(lo, glm::dvec2(viewed->view.project(p)));
    hi = glm::max(hi, glm::dvec2(viewed->view.project(p)));
  }
  EXPECT_GT(viewed->crop.x + kCropMargin_px + 1, lo.x);
  EXPECT_GT(viewed->crop.y + kCropMargin_px + 1, lo.y);
  EXPECT_LT(viewed->crop.x + viewed->crop.width_px - kCropMargin_px - 1, hi.x);
  EXPECT_LT(viewed->crop.y + viewed->crop.height_px - kCropMargin_px - 1, hi.y);
}

TEST(ChooseView, PlaneTurnsToWhatReachesFarFromTheAxis) {
  // 60 units high and 20 away: its top is 66 degrees up from the face's axis, less from its
  // middle's
  const Points tall = make_box_points({20, 10, 30}, {2, 2, 30});
  const auto viewed = choose_view({0, 0, 10}, tall, {});
  ASSERT_TRUE(viewed);
  const glm::dvec3 toward = glm::normalize(glm::dvec3(20, 10, 20));
  EXPECT_NEAR(angle_deg(viewed->view.forward, toward), 0, 1e-5);
  expect_all_inside(*viewed, tall);
}

TEST(ChooseView, NothingFromInsideOrFromTooNear) {
  EXPECT_FALSE(choose_view({0, 0, 0}, make_box_points({0, 0, 0}, glm::dvec3(5)), {}));
  EXPECT_FALSE(choose_view({0, 0, 0}, make_box_points({3, 1, 0}, glm::dvec3(5)), {}));
  EXPECT_FALSE(choose_view({0, 0, 0}, make_box_points({5.2, 0, 0}, glm::dvec3(5)), {}));
  EXPECT_FALSE(choose_view({0, 0, 0}, make_box_points({0, 0, 50}, glm::dvec3(1)), {}));  // overhead
  EXPECT_FALSE(choose_view({0, 0, 0}, {}, {}));
  EXPECT_FALSE(choose_view({1, 2, 3}, Points{{1, 2, 3}}, {}));  // at the eye itself
}

// Density: far objects have `far_scale` times the pixels; far means every point.
TEST(ChooseView, FarObjectsAreSampledDenser) {
  const CaptureDensity density{.resolution_px = 512, .far_scale = 2, .far_distance = 300};
  const double focal = 256 * std::sqrt(3.0);
  const auto at = [&](double x) {
    const auto viewed =
        choose_view({0, 0, 18}, make_box_points({x, x / 2, 18}, glm::dvec3(5)), density);
    EXPECT_TRUE(viewed);
    EXPECT_EQ(viewed->view.source_px, 512);
    expect_all_inside(*viewed, make_box_points({x, x / 2, 18}, glm::dvec3(5)));
    return viewed->view.focal_px;
  };
  EXPECT_NEAR(at(100), focal, 1e-9);
  EXPECT_NEAR(at(268), focal, 1e-9);  // its middle is at 300, a part of it nearer
  EXPECT_NEAR(at(290), 2 * focal, 1e-9);
}

}  // namespace
}  // namespace viewcell

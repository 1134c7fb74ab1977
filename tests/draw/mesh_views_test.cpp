#include "draw/mesh_views.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/random.h"

namespace viewcell {
namespace {

double angle_deg(const Camera& a, const Camera& b) {
  return glm::degrees(std::acos(glm::clamp(glm::dot(a.forward, b.forward), -1.0, 1.0)));
}

TEST(MeshViews, OneIsTheFrontThreeQuarter) {
  const std::vector<Camera> views = make_views(1);
  ASSERT_EQ(views.size(), 1u);
  EXPECT_NEAR(angles_of(views[0]).elevation_deg, 20, 1e-9);
  EXPECT_NEAR(angles_of(views[0]).azimuth_deg, 35, 1e-9);
  // From the front (-y), above, and on the side of +x, the left hand of what faces -y.
  EXPECT_LT(views[0].eye.y, 0);
  EXPECT_GT(views[0].eye.x, 0);
  EXPECT_GT(views[0].eye.z, 0);
}

TEST(MeshViews, TwoByHand) {
  const std::vector<Camera> views = make_views(2);  // heights 1/2 and -1/2
  EXPECT_NEAR(angles_of(views[0]).elevation_deg, 30, 1e-9);
  EXPECT_NEAR(angles_of(views[1]).elevation_deg, -30, 1e-9);
  EXPECT_NEAR(angles_of(views[1]).azimuth_deg, 35 + 137.50776405, 1e-6);
}

TEST(MeshViews, CoverTheSphereEvenlyFromOneDistance) {
  for (std::size_t n = 1; n <= kMostViews; n = n < 24 ? n + 1 : 2 * n - 8) {
    SCOPED_TRACE(n);
    const std::vector<Camera> views = make_views(n);
    ASSERT_EQ(views.size(), n);
    EXPECT_NEAR(angles_of(views[0]).azimuth_deg, 35, 1e-9);
    EXPECT_GE(angles_of(views[0]).elevation_deg, 0);
    EXPECT_LE(angles_of(views[0]).elevation_deg, 42);
    glm::dvec3 sum(0);
    double nearest_deg = 360;
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(glm::length(views[i].eye), glm::length(views[0].eye), 1e-12);
      EXPECT_NEAR(glm::dot(views[i].forward, glm::normalize(views[i].eye)), -1, 1e-12);
      EXPECT_LT(std::abs(views[i].forward.z), 0.999);
      sum += views[i].forward;
      for (std::size_t j = 0; j < i; ++j)
        nearest_deg = std::min(nearest_deg, angle_deg(views[i], views[j]));
    }
    if (n > 3) {
      EXPECT_LT(glm::length(sum) / static_cast<double>(n), 0.15);
    }
    if (n > 1) {
      // A disc of 60 % of each view's share of the sphere is free of others.
      EXPECT_GT(nearest_deg, glm::degrees(std::acos(1 - 2 * 0.6 / static_cast<double>(n))));
    }
  }
}

TEST(MeshViews, PictureHoldsTheSphereJustSo) {
  Random random(5);
  for (const Camera& view : make_views(20)) {
    const glm::dmat4 clip = clip_from_world(view);
    double most = 0;
    for (int i = 0; i < 4000; ++i) {
      const glm::dvec3 p = glm::normalize(
          glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
      const glm::dvec4 c = clip * glm::dvec4(p, 1);
      EXPECT_LT(c.z, c.w);  // beyond the near plane
      most = std::max({most, std::abs(c.x / c.w), std::abs(c.y / c.w)});
    }
    EXPECT_LT(most, 1);
    EXPECT_GT(most, 0.96);
  }
}

TEST(MeshViews, LightTurnsWithTheEyeAndUpStaysUp) {
  for (const Camera& view : make_views(20)) {
    const glm::dmat3 turn = turn_eye_to_front(view);
    const glm::dvec3 eye = turn * view.eye;
    EXPECT_NEAR(eye.x, 0, 1e-12);
    EXPECT_LT(eye.y, 0);
    EXPECT_NEAR(eye.z, view.eye.z, 1e-12);
    EXPECT_NEAR(glm::determinant(turn), 1, 1e-12);
    EXPECT_NEAR(glm::distance(turn * glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 1)), 0, 1e-12);
  }
}

TEST(MeshFrame, IsTheSphereAroundTheBoxOfWhatIsDrawn) {
  TriMesh mesh;
  mesh.positions = {{900, 0, 0}, {1, 2, 3}, {3, 2, 3}, {3, 5, 9}};  // the first is of no triangle
  mesh.triangles = {{1, 2, 3}};
  const MeshFrame frame = make_frame(box_of_triangles(mesh), "z", "m.ply");
  EXPECT_EQ(frame.centre, glm::dvec3(2, 3.5, 6));
  EXPECT_DOUBLE_EQ(frame.radius, 3.5);  // half of sqrt(4 + 9 + 36)
  EXPECT_DOUBLE_EQ(measure_reach(mesh, frame), 1);
  mesh.positions[3] = {3, 5, 16};
  EXPECT_NEAR(measure_reach(mesh, frame), std::sqrt(1 + 2.25 + 100) / 3.5, 1e-12);
}

TEST(MeshFrame, APointIsRefused) {
  TriMesh mesh;
  mesh.positions.assign(3, {1, 2, 3});
  mesh.triangles = {{0, 1, 2}};
  try {
    make_frame(box_of_triangles(mesh), "z", "m.ply");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "m.ply: has no extent: its triangles are one point");
  }
}

TEST(MeshFrame, UpAxisByHand) {
  const glm::dvec3 top(0, 0, 1);
  EXPECT_EQ(frame_from_mesh({{1, 1, 1}, 2, "x"}, {3, 1, 1}), top);
  EXPECT_EQ(frame_from_mesh({{1, 1, 1}, 2, "y"}, {1, 3, 1}), top);
  EXPECT_EQ(frame_from_mesh({{1, 1, 1}, 2, "z"}, {1, 1, 3}), top);
  // What faces +z in a mesh with y up comes to face the front.
  EXPECT_EQ(frame_from_mesh({{1, 1, 1}, 2, "y"}, {1, 1, 3}), glm::dvec3(0, -1, 0));
}

TEST(MeshFrame, ThereAndBack) {
  Random random(9);
  const auto point = [&](double r) {
    return glm::dvec3(random.uniform(-r, r), random.uniform(-r, r), random.uniform(-r, r));
  };
  for (const char* up : {"x", "y", "z"})
    for (int i = 0; i < 100; ++i) {
      const MeshFrame frame{point(100), random.uniform(0.01, 50), up};
      const glm::dvec3 p = point(100), d = point(1);
      EXPECT_LT(glm::distance(mesh_from_frame(frame, frame_from_mesh(frame, p)), p), 1e-10);
      // A direction is a point's difference without the scale.
      const glm::dvec3 moved = mesh_from_frame(frame, d) - mesh_from_frame(frame, glm::dvec3(0));
      EXPECT_LT(glm::distance(mesh_from_frame_direction(frame, d), moved / frame.radius), 1e-10);
    }
}

TEST(MeshFrame, BoxesAreParsed) {
  const Box box = parse_box("-1,2,3e1:4,2.5,60");
  EXPECT_EQ(box.lo, glm::dvec3(-1, 2, 30));
  EXPECT_EQ(box.hi, glm::dvec3(4, 2.5, 60));
  for (const char* bad : {"", "1,2,3", "0,0,0:1,1", "0,0,0:1,1,1,", "0,0,0:1,1,nan",
                          "0,0,0:1,1,inf", "0,0,2:1,1,1", "0;0;0:1;1;1"})
    EXPECT_THROW(parse_box(bad), UsageError) << bad;
}

TEST(MeshFrame, FormatsHaveTheirUpAxis) {
  for (const char* file : {"a.obj", "b/c.OBJ", "d.glb", "e.gltf"}) EXPECT_EQ(up_axis_of(file), "y");
  for (const char* file : {"a.ply", "a.obj.ply.gz", "a.off", "a.stl", "a.3ds"})
    EXPECT_EQ(up_axis_of(file), "z");
}

}  // namespace
}  // namespace viewcell

#include "bake/view_metric.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "capture/shapes.h"

namespace viewcell {
namespace {

constexpr double kFocal = 887;

ViewMetricOptions make_options(double radius = 0) {
  ViewMetricOptions options;
  options.samples = {glm::dvec3(0)};
  options.radius = radius;
  options.focal_px = kFocal;
  return options;
}

ViewVertices make_vertices(std::vector<glm::vec3> positions, const glm::vec3& normal,
                           float weight) {
  ViewVertices out;
  out.normals.assign(positions.size(), normal);
  out.weights.assign(positions.size(), weight);
  out.views.assign(positions.size(), 1);
  out.positions = std::move(positions);
  return out;
}

// A triangle 0, 1, 2 in the plane x = 100, and a vertex 3 of no triangle, nearer by h than 0.
ViewVertices make_step(double h, const glm::vec3& normal, float weight) {
  return make_vertices({{100, 0, 0}, {100, 0, 5}, {100, 5, 0}, {static_cast<float>(100 - h), 0, 0}},
                       normal, weight);
}
const std::vector<Triangle> kStep{{0, 1, 2}};

// The fourth root of the patch's pixels over 50: vertex 0 stands for a third of kStep's triangle.
double patch_factor(double px_per_unit, double show = 1) {
  return std::pow(12.5 / 3 * show * px_per_unit * px_per_unit / 50, 0.25);
}

TEST(ViewMetric, FlatPairCostsWhatThePaperSays) {
  const ViewVertices v = make_vertices({{100, 0, 0}, {100, 1, 0}, {100, 0, 1}}, {-1, 0, 0}, 0.125f);
  const ViewMetricOptions options = make_options();
  const ViewMetric metric(v, std::vector<Triangle>{{0, 2, 1}}, options);
  EXPECT_NEAR(metric.cost(0, 1), 0.25 * (kFocal / 100) * 0.25, 1e-5);
  EXPECT_NEAR(metric.cost(0, 2), 0.25 * (kFocal / 100) * 0.25, 1e-5);
}

// (1.5 - n_u . n_v)^2 l (w_u + w_v), l across the line of sight from u; nothing drifts, since no
// triangle spans a plane.
TEST(ViewMetric, AnyPairCostsWhatThePaperSays) {
  Random random(3);
  for (int k = 0; k < 500; ++k) {
    const auto point = [&] {
      return glm::vec3(random.uniform(20, 200), random.uniform(-90, 90), random.uniform(-20, 20));
    };
    const auto unit = [&] {
      return glm::normalize(glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0.3));
    };
    ViewVertices v = make_vertices({point(), point()}, {}, 0);
    v.normals = {unit(), unit()};
    v.weights = {0.05f, 0.4f};
    const double radius = random.uniform(0, 15);
    const ViewMetricOptions options = make_options(radius);
    const ViewMetric metric(v, {}, options);
    const glm::dvec3 u(v.positions[0]), edge = glm::dvec3(v.positions[1]) - u;
    const double d = glm::length(u), along = glm::dot(edge, u / d);
    const double across = glm::length(glm::cross(edge, u / d)), turned = along * radius / d;
    const double away = 1.5 - glm::dot(glm::dvec3(v.normals[0]), glm::dvec3(v.normals[1]));
    const double expected = away * away * 0.45 * kFocal / d * std::hypot(across, turned);
    ASSERT_NEAR(metric.cost(0, 1), expected, 1e-4 * expected + 1e-4) << "case " << k;
  }
}

// The root of the mean of 1 / d^2; an eye nearer than 5 counts as 5 away.
TEST(ViewMetric, PixelsAreAveragedOverTheCell) {
  const ViewVertices v = make_vertices({{100, 0, 0}, {100, 0, 1}}, {-1, 0, 0}, 0.5f);
  ViewMetricOptions options = make_options();
  options.samples = {{0, 0, 0}, {50, 0, 0}, {99.9, 0, 0}};
  const ViewMetric metric(v, {}, options);
  const double mean = (1 / 1e4 + 1 / 2500.0 + 1 / 25.0) / 3;
  EXPECT_NEAR(metric.cost(0, 1), 0.25 * kFocal * std::sqrt(mean), 1e-3);
}

TEST(ViewMetric, OnlyTheSmallerWeightCollapses) {
  ViewVertices v = make_step(0, {-1, 0, 0}, 0.125f);
  const ViewMetricOptions options = make_options();
  for (const float w : {0.05f, 0.125f, 0.25f, 0.4f, 0.5f}) {
    v.weights[1] = w;
    const ViewMetric metric(v, kStep, options);
    EXPECT_EQ(std::isinf(metric.cost(0, 1)), w < 0.125f) << w;
    EXPECT_EQ(std::isinf(metric.cost(1, 0)), w > 0.125f) << w;
  }
}

TEST(ViewMetric, PairsOfAnMVMeshShareAViewOrNobodySeesThem) {
  ViewVertices v = make_step(0, {-1, 0, 0}, 0.125f);
  ViewMetricOptions options = make_options();
  for (const bool keep : {false, true})
    for (unsigned a = 0; a < 8; ++a)
      for (unsigned b = 0; b < 8; ++b) {
        v.views[0] = static_cast<std::uint8_t>(a), v.views[1] = static_cast<std::uint8_t>(b);
        options.keep_common_views = keep;
        const ViewMetric metric(v, kStep, options);
        const bool apart = (a & b) == 0 && a + b > 0;
        EXPECT_EQ(std::isinf(metric.cost(0, 1)), keep && apart) << a << " " << b;
      }
}

// By making the collapse: no triangle that shared a view comes to share none.
TEST(ViewMetric, AllowsWhatKeepsEveryTrianglesCommonView) {
  // u = 0 amid a hexagon 1..6
  std::vector<glm::vec3> positions{{100, 0, 0}};
  std::vector<Triangle> fan;
  for (std::uint32_t i = 0; i < 6; ++i) {
    const double a = glm::radians(60.0 * i);
    positions.emplace_back(100, std::cos(a), std::sin(a));
    fan.push_back({0, 1 + (i + 1) % 6, 1 + i});
  }
  ViewVertices v = make_vertices(positions, {-1, 0, 0}, 0.125f);
  ViewMetricOptions options = make_options();
  options.keep_common_views = true;
  Random random(11);
  int n_allowed = 0;
  for (int k = 0; k < 400; ++k) {
    for (std::uint8_t& views : v.views) views = static_cast<std::uint8_t>(1 + random.below(7));
    const CollapseMesh mesh(v.positions, fan);
    const ViewMetric metric(v, fan, options);
    const std::uint32_t to = 1 + random.below(6);
    bool expected = true;
    for (const Triangle& t : fan) {
      if (t[1] == to || t[2] == to) continue;
      const unsigned others = v.views[t[1]] & v.views[t[2]];
      expected &= !((others & v.views[0]) && !(others & v.views[to]));
    }
    ASSERT_EQ(metric.allows(mesh, 0, to), expected) << "case " << k;
    n_allowed += expected;
  }
  EXPECT_GT(n_allowed, 30);
  EXPECT_LT(n_allowed, 370);
  options.keep_common_views = false;
  v.views.assign(7, 0);
  v.views[0] = v.views[2] = v.views[3] = 1;
  const CollapseMesh mesh(v.positions, fan);
  EXPECT_TRUE(ViewMetric(v, fan, options).allows(mesh, 0, 6));
}

// A vertex 3 that lies h before the plane, along the line of sight: the paper's length is 0.
TEST(ViewMetric, DriftGrowsWithHeightAndEndsAtTl) {
  ViewMetricOptions options = make_options();
  for (const double max_drift : {0.25, 0.5, 2.0})
    for (const double h : {0.01, 0.1, 1.0, 10.0, 40.0}) {
      options.max_drift_px = max_drift;
      const ViewVertices v = make_step(h, {-1, 0, 0}, 0.5f);
      const ViewMetric metric(v, kStep, options);
      const double h_float = 100.0 - static_cast<double>(v.positions[3].x);
      const double px = kFocal / (100 - h_float);
      const double expected = 4.5 / max_drift * h_float * px * patch_factor(px);
      EXPECT_NEAR(metric.cost(0, 3), expected, 1e-5 * expected) << h;
    }
}

// A small patch that collapses into a large one counts by its own drift.
TEST(ViewMetric, LargePatchesDoNotHideSmallOnes) {
  for (const float size : {10.0f, 100.0f, 1000.0f}) {
    // 0, 1, 2: small, in the plane x = 100; 3, 4, 5: large, in the plane x = 99
    const ViewVertices v = make_vertices(
        {{100, 0, 0}, {100, 0, 0.1f}, {100, 0.1f, 0}, {99, 0, 0}, {99, 0, size}, {99, size, 0}},
        {-1, 0, 0}, 0.5f);
    const std::vector<Triangle> both{{0, 1, 2}, {3, 4, 5}};
    const ViewMetricOptions options = make_options();
    const double own_px = kFocal / 99;
    EXPECT_GE(ViewMetric(v, both, options).cost(0, 3), 0.99 * 4.5 / 0.5 * 0.5 * own_px) << size;
  }
}

TEST(ViewMetric, NothingDriftsInAPlane) {
  Random random(4);
  for (int k = 0; k < 50; ++k) {
    const glm::dmat3 axes(glm::mat3_cast(random_rotation(random)));
    const glm::dvec3 middle(random.uniform(60, 300), random.uniform(-60, 60), 0);
    std::vector<glm::vec3> positions;
    for (int i = 0; i < 4; ++i)
      positions.emplace_back(middle +
                             axes * glm::dvec3(random.uniform(-9, 9), random.uniform(-9, 9), 0));
    ViewVertices v = make_vertices(positions, glm::vec3(axes[2]), 0.5f);
    const ViewMetricOptions options = make_options(40);
    const std::vector<Triangle> triangles{{0, 1, 2}, {1, 2, 3}};
    const ViewMetric metric(v, triangles, options), paper(v, {}, options);
    for (std::uint32_t a = 0; a < 4; ++a)
      for (std::uint32_t b = 0; b < 4; ++b)
        if (a != b) {
          EXPECT_NEAR(metric.cost(a, b), paper.cost(a, b), 1e-3) << "case " << k;
        }
    for (std::uint32_t a = 0; a < 4; ++a) EXPECT_NEAR(metric.offset(a), 0, 1e-4) << "case " << k;
  }
}

// Facing: s = 0.5 * 20 / 100, the parallax; edge-on or silhouette: s = 1. drift =
// sqrt(s) h px times the patch's factor, which has s^(1/4).
TEST(ViewMetric, DisplacementsShowAtSilhouettes) {
  const ViewMetricOptions options = make_options(20);
  const auto cost = [&](const glm::vec3& normal, float weight) {
    const ViewVertices v = make_step(1, normal, weight);
    return ViewMetric(v, kStep, options).cost(0, 3);
  };
  const double edge_on = cost({0, 1, 0}, 0.125f);
  EXPECT_NEAR(edge_on, 9 * kFocal / 99 * patch_factor(kFocal / 99), 0.01);
  EXPECT_NEAR(cost({-1, 0, 0}, 0.5f), edge_on, 0.01);
  EXPECT_NEAR(cost({-1, 0, 0}, 0.4f), edge_on, 0.01);
  const double facing = std::pow(0.1, 0.75) * edge_on;
  EXPECT_NEAR(cost({-1, 0, 0}, 0.25f), facing, 0.01);
  double last = edge_on;
  for (int deg = 0; deg <= 90; deg += 5) {
    const double a = glm::radians(90.0 - deg);
    const double c = cost(glm::vec3(-std::cos(a), std::sin(a), 0), 0.125f);
    EXPECT_LE(c, last + 1e-6) << deg;
    last = c;
  }
  EXPECT_NEAR(last, facing, 0.01);
}

TEST(ViewMetric, AVertexRemembersWhatCollapsedIntoIt) {
  // 3 lies in the plane and has no triangle; 4 lies 1 before it.
  ViewVertices v = make_vertices({{100, 0, 0}, {100, 0, 5}, {100, 5, 0}, {100, -1, 0}, {99, -1, 0}},
                                 {-1, 0, 0}, 0.5f);
  const ViewMetricOptions options = make_options();
  ViewMetric metric(v, kStep, options);
  const double before = metric.cost(3, 4);
  metric.collapsed(0, 3);
  EXPECT_LT(before, 1);
  const double px = kFocal / glm::length(glm::dvec3(99, -1, 0));
  EXPECT_NEAR(metric.cost(3, 4), 9 * px * patch_factor(px), 0.01);
}

// Vertices of a ball lie on their own planes; one that stands for a neighbour lies inside the
// neighbour's and moves out, by max_drift_px at most.
TEST(ViewMetric, ChordsOfConvexSurfacesMoveOut) {
  TriMesh ball = make_sphere(6, 24, 12);
  for (glm::vec3& p : ball.positions) p.x += 100;
  ViewVertices v = make_vertices(ball.positions, {}, 0.5f);
  v.normals = ball.normals;
  ViewMetricOptions options = make_options(30);
  for (const double most : {0.01, 100.0}) {
    options.max_drift_px = most;
    for (const Triangle& t : ball.triangles) {
      ViewMetric metric(v, std::span(ball.triangles), options);
      ASSERT_NEAR(metric.offset(t[1]), 0, 1e-3);
      metric.collapsed(t[0], t[1]);
      const double offset = metric.offset(t[1]);
      const double bound = most * glm::length(glm::dvec3(v.positions[t[1]])) / kFocal;
      EXPECT_GT(offset, 0);
      EXPECT_LE(offset, bound * (1 + 1e-5));
      if (most < 1) {
        EXPECT_NEAR(offset, bound, 0.01 * bound);
      }
      EXPECT_LT(offset, 1);
    }
  }
}

}  // namespace
}  // namespace viewcell

#include "mesh/closest_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "mesh/closest_on_segment.h"
#include "mesh/knot.h"

namespace viewcell {
namespace {

glm::dvec3 random_point(Random& random, double size = 1) {
  const double x = random.uniform(-size, size), y = random.uniform(-size, size);
  return {x, y, random.uniform(-size, size)};
}

TEST(ClosestOnSegment, InPlaneAndSpace) {
  EXPECT_EQ(closest_on_segment(glm::dvec2(1, 7), {0, 0}, {4, 0}), 0.25);
  EXPECT_EQ(closest_on_segment(glm::dvec2(-1, 7), {0, 0}, {4, 0}), 0);
  EXPECT_EQ(closest_on_segment(glm::dvec3(9, 7, 1), {0, 0, 0}, {4, 0, 0}), 1);
  EXPECT_EQ(closest_on_segment(glm::dvec3(9, 7, 1), {4, 0, 0}, {4, 0, 0}), 0);
}

//  c            The regions around a triangle with its right angle at a, seen from +z.
//  |`.
//  a--b
TEST(ClosestPointOnTriangle, EveryRegion) {
  const glm::dvec3 a(0, 0, 0), b(2, 0, 0), c(0, 2, 0);
  const auto nearest = [&](double x, double y, double z) {
    return closest_point_on_triangle({x, y, z}, a, b, c);
  };
  EXPECT_EQ(nearest(0.5, 0.5, 3), glm::dvec3(0.5, 0.5, 0));
  EXPECT_EQ(nearest(0.5, 0.5, -3), glm::dvec3(0.5, 0.5, 0));
  EXPECT_EQ(nearest(-1, -1, 1), a);
  EXPECT_EQ(nearest(4, -1, 1), b);
  EXPECT_EQ(nearest(-1, 5, 1), c);
  EXPECT_EQ(nearest(1, -1, 1), glm::dvec3(1, 0, 0));
  EXPECT_EQ(nearest(-1, 0.5, 1), glm::dvec3(0, 0.5, 0));
  EXPECT_EQ(nearest(2, 2, 1), glm::dvec3(1, 1, 0));
  EXPECT_EQ(nearest(3, 0.5, 0), b);  // beyond two edges' lines, nearest to their corner
}

TEST(ClosestPointOnTriangle, SegmentsAndPoints) {
  const glm::dvec3 a(1, 1, 1), b(3, 1, 1), middle(2, 1, 1);
  EXPECT_EQ(closest_point_on_triangle({2, 5, 1}, a, b, middle), middle);
  EXPECT_EQ(closest_point_on_triangle({2.5, 5, 1}, a, middle, b), glm::dvec3(2.5, 1, 1));
  EXPECT_EQ(closest_point_on_triangle({9, 5, 1}, a, a, b), b);
  EXPECT_EQ(closest_point_on_triangle({0, 5, 1}, b, a, b), a);
  EXPECT_EQ(closest_point_on_triangle({7, 8, 9}, a, a, a), a);
}

TEST(CornerWeights, GiveThePointBack) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const glm::dvec3 a = random_point(random), b = random_point(random);
    const double thin = seed % 2 ? 1 : 1e-12;
    const glm::dvec3 c = glm::mix(a, b, random.uniform()) + thin * random_point(random);
    const glm::dvec3 p = closest_point_on_triangle(random_point(random), a, b, c);
    const glm::dvec3 w = corner_weights(p, a, b, c);
    EXPECT_GE(std::min({w.x, w.y, w.z}), 0);
    EXPECT_NEAR(w.x + w.y + w.z, 1, 1e-12);
    EXPECT_LT(glm::distance(w.x * a + w.y * b + w.z * c, p), 1e-9);
  }
  const glm::dvec3 a(1, 1, 1), b(3, 1, 1);
  EXPECT_EQ(corner_weights({1.5, 1, 1}, a, {2, 1, 1}, b), glm::dvec3(0.75, 0, 0.25));
  EXPECT_EQ(corner_weights(a, a, a, a), glm::dvec3(1, 0, 0));
}

// No point of a fine grid on the triangle is nearer, and the point found is on the triangle: it is
// reproduced by its own barycentric coordinates. Needles among the triangles.
TEST(ClosestPointOnTriangle, NoGridPointIsNearer) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const glm::dvec3 a = random_point(random), b = random_point(random);
    glm::dvec3 c = random_point(random);
    if (seed % 3 == 0) c = glm::mix(a, b, random.uniform(-0.5, 1.5)) + 1e-5 * c;
    const glm::dvec3 p = random_point(random, 2);
    const double found = glm::distance(p, closest_point_on_triangle(p, a, b, c));
    double best = 1e300;
    constexpr int kSteps = 60;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; i + j <= kSteps; ++j)
        best = std::min(best, glm::distance(p, a + i / double(kSteps) * (b - a) +
                                                   j / double(kSteps) * (c - a)));
    EXPECT_LE(found, best + 1e-9);
    EXPECT_GE(found, best - 3.5 / kSteps);
  }
}

// A soup with repeated corners, segments, needles and equal triangles.
TriMesh random_soup(Random& random) {
  TriMesh mesh;
  const std::uint32_t n_vertices = 3 + random.below(30);
  for (std::uint32_t v = 0; v < n_vertices; ++v)
    mesh.positions.push_back(glm::vec3(random_point(random)));
  if (n_vertices > 5) mesh.positions[5] = 0.5f * (mesh.positions[3] + mesh.positions[4]);
  const std::uint32_t n_triangles = 1 + random.below(60);
  for (std::uint32_t t = 0; t < n_triangles; ++t)
    mesh.triangles.push_back(
        {random.below(n_vertices), random.below(n_vertices), random.below(n_vertices)});
  return mesh;
}

// Every triangle tried, in the mesh's own coordinates.
ClosestPoint try_every_triangle(const TriMesh& mesh, const glm::dvec3& p) {
  ClosestPoint best;
  best.distance = 1e300;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto corner = [&](std::size_t k) {
      return glm::dvec3(mesh.positions[mesh.triangles[t][k]]);
    };
    const glm::dvec3 q = closest_point_on_triangle(p, corner(0), corner(1), corner(2));
    if (glm::distance(p, q) < best.distance) best = {q, glm::distance(p, q), t};
  }
  return best;
}

Box box_with(const TriMesh& mesh, const std::vector<glm::dvec3>& points) {
  Box box = bounding_box(mesh);
  for (const glm::dvec3& p : points) box.add(p);
  return box;
}

// size: of the coordinates; offset: of all, in sizes.
void expect_as_if_every_triangle_were_tried(double size, double offset) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriMesh mesh = random_soup(random);
    const auto place = [&](const glm::dvec3& p) { return size * (p + offset); };
    for (glm::vec3& p : mesh.positions) p = glm::vec3(place(glm::dvec3(p)));
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 50; ++i) points.push_back(place(random_point(random, 2)));
    for (const glm::vec3& p : mesh.positions) points.push_back(glm::dvec3(p));
    const ClosestPointFinder finder(mesh, box_with(mesh, points), 1);
    std::uint32_t hint = 0;
    for (const glm::dvec3& p : points) {
      const ClosestPoint expected = try_every_triangle(mesh, p), found = finder.find(p, hint);
      const double rounding = size * 1e-13 * (1 + std::abs(offset));
      ASSERT_NEAR(found.distance, expected.distance, rounding);
      ASSERT_NEAR(glm::distance(found.point, p), found.distance, rounding);
      const ClosestPoint without_hint = finder.find(p);
      ASSERT_EQ(found.triangle, without_hint.triangle);
      ASSERT_EQ(found.distance, without_hint.distance);
      hint = found.triangle;
    }
  }
}

TEST(ClosestPointFinder, AsIfEveryTriangleWereTried) {
  expect_as_if_every_triangle_were_tried(1, 0);
}
TEST(ClosestPointFinder, HugeAndTinyCoordinates) {
  expect_as_if_every_triangle_were_tried(1e30, 0);
  expect_as_if_every_triangle_were_tried(1e-30, 0);
}
TEST(ClosestPointFinder, FarFromTheOrigin) {
  expect_as_if_every_triangle_were_tried(1, 1e5);
  expect_as_if_every_triangle_were_tried(1e30, -1e4);
}

// The mesh is a millionth of the domain: the hierarchy's floats cannot tell its triangles apart.
TEST(ClosestPointFinder, AMeshThatIsSmallInItsDomain) {
  const TriMesh mesh = make_bumpy_torus(8, 12, glm::vec3(0), 1e-6f);
  Random random(1);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 100; ++i) points.push_back(random_point(random, i % 2 ? 1 : 2e-6));
  const ClosestPointFinder finder(mesh, box_with(mesh, points), 1);
  for (const glm::dvec3& p : points)
    EXPECT_NEAR(finder.find(p).distance, try_every_triangle(mesh, p).distance, 1e-15);
}

// All corners lie on one sphere around the query: equally far, the lowest number is named.
TEST(ClosestPointFinder, TiesGoToTheLowestNumber) {
  TriMesh mesh;
  for (int k = 0; k < 40; ++k) {
    const float s = k % 2 ? 1.0f : -1.0f;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& p : {glm::vec3(s, -9, -9), glm::vec3(s, 9, -9), glm::vec3(s, 0, 9)})
      mesh.positions.push_back(p);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const ClosestPointFinder finder(mesh, bounding_box(mesh), 1);
  for (std::uint32_t hint = 0; hint < 40; ++hint) {
    EXPECT_EQ(finder.find(glm::dvec3(0), hint).triangle, 0u);
    EXPECT_EQ(finder.find(glm::dvec3(0.5, 0, 0), hint).triangle, 1u);
  }
}

// A vertex that no triangle uses may lie anywhere, even where a float of the domain has no end.
// As if every triangle that faces the direction were tried.
TEST(ClosestPointFinder, FindsTheSideThatFaces) {
  const TriMesh knot = make_bumpy_torus(12, 24);
  const ClosestPointFinder finder(knot, {glm::dvec3(-2), glm::dvec3(2)}, 1);
  std::size_t n_found = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const glm::dvec3 p = random_point(random, 1.5), direction = random_point(random);
    const double within = random.uniform(0, 1.5);
    double nearest = within;
    std::int64_t expected = -1;
    for (std::uint32_t t = 0; t < knot.triangles.size(); ++t) {
      const auto& [a, b, c] = knot.triangles[t];
      if (!(glm::dot(area_normal(knot, knot.triangles[t]), direction) > 0)) continue;
      const double d = glm::distance(
          p, closest_point_on_triangle(p, knot.positions[a], knot.positions[b], knot.positions[c]));
      if (d < nearest - 1e-12) nearest = d, expected = t;
    }
    const auto found = finder.find_facing(p, direction, within);
    ASSERT_EQ(found.has_value(), expected >= 0);
    if (!found) continue;
    ++n_found;
    EXPECT_NEAR(found->distance, nearest, 1e-12);
    EXPECT_NEAR(glm::distance(found->point, p), nearest, 1e-12);
    EXPECT_GT(glm::dot(area_normal(knot, knot.triangles[found->triangle]), direction), 0);
  }
  EXPECT_GT(n_found, 200u);
  EXPECT_LT(n_found, 450u);
}

TEST(ClosestPointFinder, UnusedVerticesDoNotMatter) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1e-30f, 0, 0}, {0, 1e-30f, 0}, {1e30f, -1e30f, 1e30f}};
  mesh.triangles = {{0, 1, 2}};
  Box box;
  for (int v = 0; v < 3; ++v) box.add(glm::dvec3(mesh.positions[static_cast<std::size_t>(v)]));
  box.add(glm::dvec3(0, 0, 1e-30));
  const ClosestPointFinder finder(mesh, box, 1);
  EXPECT_NEAR(finder.find({1e-31, 1e-31, 1e-30}).distance, 1e-30, 1e-40);
}

TEST(ClosestPointFinder, WantOfMemoryIsTheMachinesFault) {
  const TriMesh mesh = make_bumpy_torus(40, 60);
  for (const std::size_t budget_bytes : {1u << 10, 1u << 16})
    EXPECT_THROW(ClosestPointFinder(mesh, bounding_box(mesh), 1, budget_bytes), MachineError);
  EXPECT_NO_THROW(ClosestPointFinder(mesh, bounding_box(mesh), 1, 1u << 28));
}

}  // namespace
}  // namespace viewcell

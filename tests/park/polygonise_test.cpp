#include "park/polygonise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/topology.h"
#include "park/random_figure.h"

namespace viewcell {
namespace {

double area_of(const TriMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) sum += 0.5 * glm::length(area_normal(mesh, t));
  return sum;
}

double volume_of(const TriMesh& mesh) {  // signed: positive when triangles turn outward
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += glm::dot(glm::dvec3(mesh.positions[t[0]]), area_normal(mesh, t)) / 6;
  return sum;
}

TEST(Implicit, DistancesByHand) {
  Figure figure;
  const auto value = [&](const Solid& solid, const glm::vec3& p) {
    figure.limbs.clear();
    figure.unite(0, {solid});
    return FigureView(figure).value(p);
  };
  EXPECT_NEAR(value(make_round_cone({0, 0, 0}, 1, {4, 0, 0}, 1), {2, 3, 0}), 2, 1e-6);
  EXPECT_NEAR(value(make_round_cone({0, 0, 0}, 1, {4, 0, 0}, 2), {9, 0, 0}), 3, 1e-6);
  EXPECT_NEAR(value(make_round_cone({0, 0, 0}, 1, {0.5f, 0, 0}, 3), {0, 0, 5}),
              std::sqrt(25.25) - 3, 1e-5);
  EXPECT_NEAR(value(make_ball({1, 1, 1}, 2), {1, 1, 6}), 3, 1e-6);
  EXPECT_NEAR(value(make_box({0, 0, 0}, {1, 2, 3}, 0.5f), {5, 6, 3}),
              std::sqrt(4.5 * 4.5 * 2 + 0.25) - 0.5, 1e-5);
  EXPECT_NEAR(value(make_box({0, 0, 0}, {1, 2, 3}, 0.5f, turn_z(90)), {0, 3, 0}), 2, 1e-5);
  EXPECT_NEAR(value(make_drum({0, 0, 0}, 2, {0, 0, 4}, 2, 0.1f), {5, 0, 1}), 3, 1e-5);
  EXPECT_NEAR(value(make_drum({0, 0, 4}, 2, {0, 0, 0}, 2, 0.1f), {0, 0, 6}), 2,
              1e-5);  // from top down
  EXPECT_NEAR(value(mirror(make_ball({3, 0, 0}, 1), 0), {-5, 0, 0}), 1, 1e-6);
}

TEST(Implicit, AViewNearAPointDecidesTheSurfaceThere) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Figure figure = random_figure(seed);
    const FigureView whole(figure);
    Random random(seed + 1000);
    const glm::vec3 group = random_point(random, 9);
    const float reach = static_cast<float>(random.uniform(1, 5)), radius = 0.4f * reach;
    const glm::vec3 centre = group + 0.3f * random_point(random, reach);
    const FigureView view = whole.near(group, reach).near(centre, radius);
    for (int i = 0; i < 100; ++i) {
      const glm::vec3 p = centre + 0.57f * random_point(random, radius);
      const float expected = whole.value(p), found = view.value(p);
      EXPECT_EQ(found < 0, expected < 0) << expected << " " << found;
      if (std::abs(expected) < 0.15f * radius) {
        EXPECT_NEAR(found, expected, 1e-5);
      }
    }
  }
}

TEST(Implicit, AChainPassesThroughItsKnots) {
  const Knot knots[] = {{{0, 0, 0}, 1}, {{4, 1, 0}, 2}, {{7, -2, 3}, 0.5f}};
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(glm::length(point_on_chain(knots, static_cast<float>(i)).point - knots[i].point),
              1e-6);
    EXPECT_NEAR(point_on_chain(knots, static_cast<float>(i)).radius, knots[i].radius, 1e-6);
  }
  EXPECT_EQ(make_chain(knots, 5).size(), 10u);
}

TEST(Polygonise, ABallIsABall) {
  Figure figure;
  figure.unite(0, {make_ball({1, 2, 13}, 10)});
  const TriMesh mesh = polygonise(figure, {.cell = 0.5});
  const MeshTopology topology = measure_topology(mesh);
  EXPECT_TRUE(topology.is_closed_manifold());
  EXPECT_EQ(topology.n_components, 1u);
  EXPECT_EQ(topology.euler_characteristic, 2);
  for (const glm::vec3& p : mesh.positions)
    EXPECT_NEAR(glm::length(p - glm::vec3(1, 2, 13)), 10, 0.01);
  EXPECT_NEAR(area_of(mesh) / (400 * std::numbers::pi), 1, 0.005);
  EXPECT_NEAR(volume_of(mesh) / (4000 * std::numbers::pi / 3), 1, 0.005);
}

TEST(Polygonise, ARingHasOneHoleAndAShellTwoSides) {
  std::vector<Knot> knots;
  for (int i = 0; i <= 12; ++i)
    knots.push_back({{5 * std::cos(0.5236f * static_cast<float>(i)),
                      5 * std::sin(0.5236f * static_cast<float>(i)), 8},
                     1});
  Figure ring;
  ring.unite(0, make_chain(knots, 4));
  EXPECT_EQ(measure_topology(polygonise(ring, {.cell = 0.4})).euler_characteristic, 0);
  Figure shell;
  shell.unite(0, {make_ball({0, 0, 5}, 4)});
  shell.cut(0, {make_ball({0, 0, 5}, 3)});
  const MeshTopology topology = measure_topology(polygonise(shell, {.cell = 0.4}));
  EXPECT_EQ(topology.n_components, 2u);
  EXPECT_EQ(topology.euler_characteristic, 4);
}

TEST(Polygonise, StandsFlatOnTheFloor) {
  Figure figure;
  figure.unite(0, {make_drum({0, 0, -3}, 9, {0, 0, 6}, 9, 0.5f)});
  const TriMesh mesh = polygonise(figure, {.cell = 0.5, .floor_z = 0});
  EXPECT_TRUE(measure_topology(mesh).is_closed_manifold());
  EXPECT_NEAR(bounding_box(mesh).lo.z, 0, 1e-5);
  double floor_area = 0;
  for (const Triangle& t : mesh.triangles)
    if (std::max({mesh.positions[t[0]].z, mesh.positions[t[1]].z, mesh.positions[t[2]].z}) < 1e-4f)
      floor_area += 0.5 * glm::length(area_normal(mesh, t));
  EXPECT_NEAR(floor_area / (81 * 3.14159), 0.9, 0.1);  // but for a cell at the rim, cut off
}

TEST(Polygonise, RandomFiguresAreClosedManifoldsWhateverTheThreads) {
  int n_empty = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const Figure figure = random_figure(seed);
    const TriMesh mesh = polygonise(figure, {.cell = 0.35, .floor_z = -4, .n_threads = 1});
    const MeshTopology topology = measure_topology(mesh);
    EXPECT_TRUE(topology.is_closed_manifold());
    EXPECT_EQ(topology.n_unreferenced_vertices, 0u);
    EXPECT_EQ(mesh.triangles.size() % 2, 0u);
    EXPECT_TRUE(mesh.triangles.empty() || volume_of(mesh) > 0);
    n_empty += mesh.triangles.empty();
    for (const int n_threads : {2, 7}) {
      const TriMesh again =
          polygonise(figure, {.cell = 0.35, .floor_z = -4, .n_threads = n_threads});
      EXPECT_EQ(again.positions, mesh.positions);
      EXPECT_EQ(again.triangles, mesh.triangles);
    }
  }
  EXPECT_LT(n_empty, 4);
}

TEST(Polygonise, VerticesLieOnTheSurface) {
  const Figure figure = random_figure(7);
  const FigureView view(figure);
  const TriMesh mesh = polygonise(figure, {.cell = 0.2, .floor_z = -20});
  double sum = 0;
  for (const glm::vec3& p : mesh.positions) sum += std::abs(view.value(p));
  EXPECT_LT(sum / static_cast<double>(mesh.positions.size()), 0.004);
}

}  // namespace
}  // namespace viewcell

#include "mesh/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/random.h"
#include "common/models.h"
#include "formats/mesh_file.h"
#include "mesh/cube.h"
#include "mesh/knot.h"

namespace viewcell {
namespace {

std::vector<Triangle> sorted_by_turn(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

void expect_partition(const TriMesh& mesh, const ClusteredMesh& clustered) {
  EXPECT_EQ(sorted_by_turn(clustered.triangles), sorted_by_turn(mesh.triangles));
  std::uint32_t next = 0;
  for (const Cluster& cluster : clustered.clusters) {
    EXPECT_EQ(cluster.first_triangle, next);
    EXPECT_GT(cluster.n_triangles, 0u);
    next += cluster.n_triangles;
  }
  EXPECT_EQ(next, clustered.triangles.size());
}

void expect_spheres(const TriMesh& mesh, const ClusteredMesh& clustered) {
  for (const Cluster& c : clustered.clusters)
    for (std::uint32_t t = c.first_triangle; t < c.first_triangle + c.n_triangles; ++t)
      for (const std::uint32_t v : clustered.triangles[t])
        EXPECT_LE(glm::distance(c.centre, glm::dvec3(mesh.positions[v])), c.radius);
}

// The cosine, seen from the triangle, of the angle between its normal and the eye.
double facing(const TriMesh& mesh, const Triangle& t, const glm::dvec3& eye) {
  const glm::dvec3 normal = area_normal(mesh, t), sight = eye - glm::dvec3(mesh.positions[t[0]]);
  const double length = glm::length(normal) * glm::length(sight);
  return length > 0 ? glm::dot(normal, sight) / length : 0;
}

// No triangle that faces a random eye is in a cluster that was culled. Returns the share of
// triangles that turn their back and were culled.
double expect_conservative(const TriMesh& mesh, const ClusteredMesh& clustered, int n_eyes,
                           std::uint64_t seed) {
  Random random(seed);
  const Box box = bounding_box(mesh);
  const double reach = glm::length(box.size());
  std::size_t n_culled = 0, n_back = 0;
  for (int i = 0; i < n_eyes; ++i) {
    const double distance = reach * std::pow(10.0, random.uniform(-1.5, 2));
    const glm::dvec3 way(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const glm::dvec3 eye = box.centre() + distance * way;
    for (const Cluster& c : clustered.clusters) {
      const bool is_culled = is_back_facing(c, eye);
      for (std::uint32_t t = c.first_triangle; t < c.first_triangle + c.n_triangles; ++t) {
        const double cosine = facing(mesh, clustered.triangles[t], eye);
        n_back += cosine <= 0;
        n_culled += is_culled;
        EXPECT_FALSE(is_culled && cosine > 1e-7) << "seed " << seed << " eye " << i << " tri " << t;
      }
    }
  }
  return static_cast<double>(n_culled) / static_cast<double>(n_back);
}

TEST(Clusters, PartitionBoundAndCullATorus) {
  const TriMesh mesh = make_bumpy_torus(80, 200);
  const ClusteredMesh clustered = build_clusters(mesh);
  expect_partition(mesh, clustered);
  expect_spheres(mesh, clustered);
  EXPECT_LT(clustered.clusters.size(), 400u);
  EXPECT_GT(expect_conservative(mesh, clustered, 100, 1), 0.5);
}

TEST(Clusters, SmallThingsFarFromTheOrigin) {
  const TriMesh mesh = make_bumpy_torus(30, 60, glm::vec3(1000, -2000, 500), 0.5f);
  const ClusteredMesh clustered = build_clusters(mesh, {.most_triangles = 32});
  expect_partition(mesh, clustered);
  expect_spheres(mesh, clustered);
  EXPECT_GT(expect_conservative(mesh, clustered, 100, 2), 0.2);
}

// Returns the share of triangles turned away that were culled.
double expect_clusters_of_scan(const TriMesh& mesh) {
  const ClusteredMesh clustered = build_clusters(mesh, {.most_vertices = 64, .most_triangles = 64});
  expect_partition(mesh, clustered);
  expect_spheres(mesh, clustered);
  return expect_conservative(mesh, clustered, 50, 3);
}

TEST(Clusters, AScanWithLooseEnds) {
  EXPECT_GT(expect_clusters_of_scan(make_rough_scan(53).mesh), 0.1);
}

TEST(OutsideClusters, ADragonWithLooseEnds) {
  const std::filesystem::path file =
      std::filesystem::path(VIEWCELL_SHARED_DATA) / "dragon-11k/dragon_vrip_res4.ply.gz";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  EXPECT_GT(expect_clusters_of_scan(read_mesh(file)), 0.01);
}

//  eye o---->  |: one triangle, seen from behind or from in front
TEST(Clusters, OneTriangleHasAPlaneForACone) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const ClusteredMesh clustered = build_clusters(mesh);
  ASSERT_EQ(clustered.clusters.size(), 1u);
  const Cluster& c = clustered.clusters[0];
  EXPECT_TRUE(is_back_facing(c, {0.3, 0.3, -1}));
  EXPECT_TRUE(is_back_facing(c, {90, -50, -0.01}));
  EXPECT_FALSE(is_back_facing(c, {90, -50, 0.01}));
  EXPECT_FALSE(is_back_facing(c, {0.3, 0.3, 1}));
  EXPECT_FALSE(is_back_facing(c, c.cone_apex));
}

TEST(Clusters, AClosedOrFlatThingHasNoCone) {
  TriMesh mesh;
  mesh.positions = cube_positions();
  mesh.triangles = cube_triangles();
  const ClusteredMesh cube = build_clusters(mesh, {.cone_weight = 0});
  ASSERT_EQ(cube.clusters.size(), 1u);
  expect_conservative(mesh, cube, 200, 4);
  EXPECT_GT(cube.clusters[0].cone_cutoff, 1);
  mesh.triangles = {{0, 0, 1}, {1, 1, 2}};  // nothing to see
  for (const Cluster& c : build_clusters(mesh).clusters) EXPECT_FALSE(is_back_facing(c, {5, 5, 5}));
  EXPECT_TRUE(build_clusters({}).clusters.empty());
}

}  // namespace
}  // namespace viewcell

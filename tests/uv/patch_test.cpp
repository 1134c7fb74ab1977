#include "uv/patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/error.h"
#include "common/models.h"
#include "formats/mesh_file.h"
#include "mesh/cube.h"
#include "mesh/knot.h"
#include "mesh/surfaces.h"
#include "mesh/topology.h"

namespace viewcell {
namespace {

bool is_disk(const TriMesh& mesh) {
  const MeshTopology t = measure_topology(mesh);
  return t.n_components == 1 && t.euler_characteristic == 1 && t.n_nonmanifold_edges == 0 &&
         t.n_opposed_edges == 0 && t.n_nonmanifold_vertices == 0;
}

// A disk, one loop around it, its vertices and triangles those of the input.
void expect_disk_of(const TriMesh& input, const Patch& patch) {
  const TriMesh& mesh = patch.mesh;
  EXPECT_TRUE(is_disk(mesh));
  const MeshTopology topology = measure_topology(mesh);
  EXPECT_EQ(topology.n_unreferenced_vertices, 0u);
  EXPECT_EQ(find_boundary_loop(mesh).size(), topology.n_boundary_edges);
  ASSERT_EQ(patch.source_vertex.size(), mesh.positions.size());
  ASSERT_EQ(patch.source_triangle.size(), mesh.triangles.size());
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  EXPECT_TRUE(std::is_sorted(patch.source_vertex.begin(), patch.source_vertex.end()));
  EXPECT_TRUE(std::is_sorted(patch.source_triangle.begin(), patch.source_triangle.end()));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    ASSERT_EQ(mesh.positions[v], input.positions[patch.source_vertex[v]]);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_EQ(mesh.positions[mesh.triangles[t][k]],
                input.positions[input.triangles[patch.source_triangle[t]][k]]);
}

// Five triangles in a row: 0 takes them from left to right.
//   1---3---5
//  / \ / \ / .
// 0---2---4---6
TEST(CutPatch, TakesTheNearestFirst) {
  TriMesh strip;
  for (int v = 0; v < 7; ++v) strip.positions.emplace_back(0.5f * static_cast<float>(v), v % 2, 0);
  strip.triangles = {{4, 6, 5}, {4, 5, 3}, {2, 4, 3}, {2, 3, 1}, {0, 2, 1}};
  for (std::uint32_t n = 1; n <= 5; ++n) {
    const Patch patch = cut_patch(strip, 0, n);
    expect_disk_of(strip, patch);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t t = 5 - n; t < 5; ++t) expected.push_back(t);
    EXPECT_EQ(patch.source_triangle, expected);
    EXPECT_EQ(patch.n_component_faces, 5u);
  }
  EXPECT_EQ(find_boundary_loop(cut_patch(strip, 0, 5).mesh),
            (std::vector<std::uint32_t>{0, 2, 4, 6, 5, 3, 1}));
}

TEST(CutPatch, LeavesATriangleOfAClosedSurface) {
  const TriMesh ball = make_ball(4);
  for (std::size_t n = 1; n <= ball.triangles.size(); ++n) {
    const Patch patch = cut_patch(ball, 7, n);
    expect_disk_of(ball, patch);
    EXPECT_EQ(patch.mesh.triangles.size(), std::min(n, ball.triangles.size() - 1));
  }
}

TEST(CutPatch, TakesAllOfADisk) {
  const TriMesh grid = make_grid(9);
  for (const std::uint32_t around : {0u, 44u, 99u}) {
    const Patch patch = cut_patch(grid, around, kAllFaces);
    expect_disk_of(grid, patch);
    EXPECT_EQ(patch.mesh.triangles, grid.triangles);
  }
}

TEST(CutPatch, DoesNotSwallowAHandle) {
  const TriMesh torus = make_bumpy_torus(12, 24);
  for (std::size_t n = 1; n < 576; n += 23) expect_disk_of(torus, cut_patch(torus, 5, n));
  const Patch patch = cut_patch(torus, 5, kAllFaces);
  expect_disk_of(torus, patch);
  EXPECT_LT(patch.mesh.triangles.size(), 576u);
  EXPECT_GT(patch.mesh.triangles.size(), 450u);
  EXPECT_EQ(patch.n_component_faces, 576u);
}

TEST(CutPatch, StaysInItsComponent) {
  const TriMesh both = join_meshes(make_ball(4), make_ball(5, {5, 0, 0}));
  const Patch patch = cut_patch(both, 60, kAllFaces);
  expect_disk_of(both, patch);
  EXPECT_EQ(patch.n_component_faces, 80u);
  EXPECT_EQ(patch.source_triangle.front(), 48u);
}

// A tower stands on the plane. When the patch has closed behind it, it is taken in, up to its top,
// which is farther than what lies behind.
TEST(CutPatch, TakesInWhatItEncloses) {
  TriMesh grid = make_grid(20);
  const std::uint32_t top = 12 + 21 * 10;
  grid.positions[top].z = 0.45f;
  std::size_t with_top = 0;
  for (std::size_t n = 100; n < 700; n += 50) {
    const Patch patch = cut_patch(grid, 6 + 21 * 10, n);
    expect_disk_of(grid, patch);
    EXPECT_EQ(patch.mesh.triangles.size(), n);
    const auto& v = patch.source_vertex;
    const auto has = [&v](std::uint32_t id) { return std::binary_search(v.begin(), v.end(), id); };
    if (has(15 + 21 * 10)) {  // well behind the tower
      EXPECT_TRUE(has(top)) << n;
      ++with_top;
    }
  }
  EXPECT_GE(with_top, 3u);
}

TEST(CutPatch, CountsEqualPositionsAsOne) {
  TriMesh cube;  // every corner of every triangle a vertex of its own
  for (const Triangle& t : cube_triangles()) {
    const auto n = static_cast<std::uint32_t>(cube.positions.size());
    for (const std::uint32_t v : t) cube.positions.push_back(cube_positions()[v]);
    cube.triangles.push_back({n, n + 1, n + 2});
  }
  const Patch patch = cut_patch(cube, 35, kAllFaces);
  expect_disk_of(cube, patch);
  EXPECT_EQ(patch.mesh.triangles.size(), 11u);
  EXPECT_EQ(patch.mesh.positions.size(), 8u);
  EXPECT_EQ(patch.source_vertex[0], 0u);
  EXPECT_EQ(patch.source_vertex[3], 5u);  // the corner's first, of the second triangle
}

TEST(CutPatch, NormalsAreThoseOfTheWholeSurface) {
  const TriMesh ball = make_ball(6);
  const Patch patch = cut_patch(ball, 0, 30);
  const std::vector<glm::vec3> whole = make_vertex_normals(ball);
  for (std::size_t v = 0; v < patch.source_vertex.size(); ++v)
    EXPECT_EQ(patch.mesh.normals[v], whole[patch.source_vertex[v]]);
}

//  Three wings on the edge 0-1: two of them make a patch. A bow tie: one side.
TEST(CutPatch, GoesAroundWhatIsNotManifold) {
  TriMesh wings;
  wings.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}};
  wings.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 1, 4}};
  Patch patch = cut_patch(wings, 2, kAllFaces);
  expect_disk_of(wings, patch);
  EXPECT_EQ(patch.source_triangle, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(patch.n_component_faces, 3u);
  wings.triangles = {{0, 2, 1}, {0, 3, 4}};
  patch = cut_patch(wings, 0, kAllFaces);
  expect_disk_of(wings, patch);
  EXPECT_EQ(patch.mesh.triangles.size(), 1u);
  wings.triangles = {{0, 2, 1}, {0, 1, 2}, {1, 3, 1}};  // two sides of a sheet; a repeated index
  patch = cut_patch(wings, 0, kAllFaces);
  EXPECT_EQ(patch.source_triangle, (std::vector<std::uint32_t>{0}));
}

// Random soups: a disk, and nothing more could have been joined to it.
TEST(CutPatch, RandomSoupsGiveDisksThatAreMaximal) {
  std::size_t largest = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    TriMesh soup;
    for (int v = 0; v < 8; ++v)
      soup.positions.emplace_back(random.uniform(), random.uniform(), random.uniform());
    for (int t = 0; t < 30; ++t)
      soup.triangles.push_back({random.below(8), random.below(8), random.below(8)});
    const std::uint32_t around = find_top_vertex(soup, {0, 0, 1}).value();
    const Patch patch = cut_patch(soup, around, kAllFaces);
    expect_disk_of(soup, patch);
    largest = std::max(largest, patch.mesh.triangles.size());
    TriMesh more;
    more.positions = soup.positions;
    for (const std::uint32_t t : patch.source_triangle) more.triangles.push_back(soup.triangles[t]);
    const std::size_t n_edges = measure_topology(more).n_edges;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
      const Triangle& c = soup.triangles[t];
      if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
      more.triangles.push_back(c);
      // A disk by an edge of its own would have three new ones.
      EXPECT_FALSE(is_disk(more) && measure_topology(more).n_edges < n_edges + 3) << t;
      more.triangles.pop_back();
    }
  }
  EXPECT_GE(largest, 5u);
}

TEST(TopVertex, IsTheFirstOfTheFarthestThatIsUsed) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 9}, {0, 0, 1}, {1, 0, 1}, {0, 1, 0}, {-5, 0, 0}};
  mesh.triangles = {{1, 2, 3}, {4, 4, 1}};
  EXPECT_EQ(find_top_vertex(mesh, {0, 0, 1}), 1u);
  EXPECT_EQ(find_top_vertex(mesh, {1, 0, 0}), 2u);
  EXPECT_EQ(find_top_vertex(mesh, {-1, 0, 0}), 1u);
  EXPECT_FALSE(is_patch_start(mesh, 0));
  EXPECT_TRUE(is_patch_start(mesh, 3));
  EXPECT_FALSE(is_patch_start(mesh, 4));
  EXPECT_FALSE(is_patch_start(mesh, 5));
  EXPECT_THROW(cut_patch(mesh, 4, 1), BugError);
  mesh.triangles = {{4, 4, 1}};
  EXPECT_FALSE(find_top_vertex(mesh, {0, 0, 1}));
}

TEST(BoundaryLoop, OfWhatIsNoDisk) {
  EXPECT_THROW(find_boundary_loop(make_ball(4)), BugError);
  TriMesh ring = make_grid(3);
  ring.triangles.erase(ring.triangles.begin() + 8, ring.triangles.begin() + 10);  // its middle
  EXPECT_THROW(find_boundary_loop(ring), BugError);
  TriMesh bow_tie;
  bow_tie.positions.resize(5);
  bow_tie.triangles = {{0, 2, 1}, {0, 3, 4}};
  EXPECT_THROW(find_boundary_loop(bow_tie), BugError);
}

void expect_disks_of_model(const TriMesh& mesh) {
  const std::uint32_t around = find_top_vertex(mesh, {0, 1, 0}).value();
  for (const std::size_t n : {500u, 2000u}) {
    const Patch patch = cut_patch(mesh, around, n);
    expect_disk_of(mesh, patch);
    EXPECT_EQ(patch.mesh.triangles.size(), n);
  }
  expect_disk_of(mesh, cut_patch(mesh, around, kAllFaces));
}

// Holes, fins, and edges of four triangles.
TEST(CutPatch, OfWhatScansAre) {
  expect_disks_of_model(make_lumpy_figure(40));
  expect_disks_of_model(make_rough_scan(53).mesh);
}

TEST(OutsideCutPatch, RealModels) {
  const std::filesystem::path folder = VIEWCELL_SHARED_DATA;
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  for (const char* file : {"bunny-69k/bunny70k.ply", "dragon-11k/dragon_vrip_res4.ply.gz",
                           "elephant-holes-4k/elephant-with-holes.off", "cow-6k/cow.off"}) {
    SCOPED_TRACE(file);
    expect_disks_of_model(read_mesh(folder / file));
  }
}

}  // namespace
}  // namespace viewcell

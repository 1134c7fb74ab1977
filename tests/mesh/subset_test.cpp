#include "mesh/subset.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "mesh/cube.h"

namespace viewcell {
namespace {

TEST(Subset, CornersAndMaterialsGoWithTheirTriangles) {
  TriMesh mesh;
  mesh.positions = cube_positions();
  mesh.triangles = cube_triangles();
  mesh.material_names = {"a", "b"};
  mesh.offset = {1, 2, 3};
  std::vector<bool> is_kept;
  for (std::size_t t = 0; t < 12; ++t) {
    mesh.materials.push_back(t % 2);
    is_kept.push_back(t == 3 || t == 8);
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.texcoords.emplace_back(t, k);
      mesh.corner_normals.emplace_back(k, t, 0);
    }
  }
  const TriMesh part = keep_triangles(mesh, is_kept);
  EXPECT_EQ(part.triangles, (std::vector<Triangle>{mesh.triangles[3], mesh.triangles[8]}));
  EXPECT_EQ(part.materials, (std::vector<std::int32_t>{1, 0}));
  EXPECT_EQ(part.texcoords,
            (std::vector<glm::vec2>{{3, 0}, {3, 1}, {3, 2}, {8, 0}, {8, 1}, {8, 2}}));
  ASSERT_EQ(part.corner_normals.size(), 6u);
  EXPECT_EQ(part.corner_normals[4], glm::vec3(1, 8, 0));
  EXPECT_EQ(part.positions, mesh.positions);
  EXPECT_EQ(part.material_names, mesh.material_names);
  EXPECT_EQ(part.offset, mesh.offset);
}

TEST(Subset, AllOrNoneAndNoOtherLength) {
  TriMesh mesh;
  mesh.positions = cube_positions();
  mesh.triangles = cube_triangles();
  EXPECT_EQ(keep_triangles(mesh, std::vector<bool>(12, true)).triangles, mesh.triangles);
  EXPECT_TRUE(keep_triangles(mesh, std::vector<bool>(12, false)).triangles.empty());
  EXPECT_THROW(keep_triangles(mesh, std::vector<bool>(11, true)), BugError);
}

}  // namespace
}  // namespace viewcell

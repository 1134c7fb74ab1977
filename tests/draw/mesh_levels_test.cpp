#include "draw/mesh_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "draw/small_scene.h"

namespace viewcell {
namespace {

using Corner = std::array<float, 6>;
using Face = std::array<Corner, 3>;

// Faces as positions and normals, each turned so that its least corner comes first: what stays the
// same when vertices and triangles are put in another order.
std::vector<Face> sorted_faces(const TriMesh& mesh) {
  std::vector<Face> faces;
  for (const Triangle& t : mesh.triangles) {
    Face face;
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 &p = mesh.positions[t[k]], &n = mesh.normals[t[k]];
      face[k] = {p.x, p.y, p.z, n.x, n.y, n.z};
    }
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    faces.push_back(face);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

TEST(MeshLevels, OrderChangesNoFace) {
  TriMesh mesh = make_torus(30, 20);
  mesh.positions.push_back({9, 9, 9});  // used by no triangle
  mesh.normals.push_back({0, 0, 1});
  const TriMesh ordered = optimize_order(mesh).mesh;
  EXPECT_EQ(ordered.positions.size(), mesh.positions.size() - 1);
  EXPECT_EQ(sorted_faces(ordered), sorted_faces(mesh));
}

TEST(MeshLevels, EmptyMeshStaysEmpty) {
  EXPECT_TRUE(optimize_order(TriMesh{}).mesh.positions.empty());
}

TEST(MeshLevels, LevelsShrinkAndErrorsGrow) {
  const TriMesh mesh = make_torus(80, 40);
  const MeshLevels levels = build_mesh_levels(mesh);
  ASSERT_GE(levels.size(), 6u);
  EXPECT_EQ(levels[0].error, 0);
  EXPECT_EQ(sorted_faces(levels[0].mesh), sorted_faces(mesh));
  for (std::size_t i = 1; i < levels.size(); ++i) {
    EXPECT_GE(levels[i].error, levels[i - 1].error) << i;
    EXPECT_LT(levels[i].mesh.triangles.size(), levels[i - 1].mesh.triangles.size()) << i;
    EXPECT_LE(levels[i].mesh.positions.size(), 3 * levels[i].mesh.triangles.size());
  }
  EXPECT_GT(levels.back().error, 0.01);  // in model units: the torus is 8 wide
  EXPECT_LT(levels.back().error, 4);
}

TEST(MeshLevels, LevelsKeepTheOriginalsVertices) {
  const TriMesh mesh = make_torus(24, 12);
  const MeshLevels levels = build_mesh_levels(mesh);
  for (const MeshLevel& level : levels)
    for (const glm::vec3& p : level.mesh.positions)
      EXPECT_NE(std::find(mesh.positions.begin(), mesh.positions.end(), p), mesh.positions.end());
}

}  // namespace
}  // namespace viewcell

#include "mesh/backs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/cube.h"
#include "mesh/topology.h"

namespace viewcell {
namespace {

// A sheet of n x n quads with vertices of its own for each side; the back's quads are cut along the
// other diagonals, or as the front's.
TriMesh make_sheet(std::uint32_t n, bool is_other, float height) {
  TriMesh mesh;
  for (int side = 0; side < 2; ++side)
    for (std::uint32_t y = 0; y <= n; ++y)
      for (std::uint32_t x = 0; x <= n; ++x) {
        mesh.positions.emplace_back(x, y, height * std::sin(0.3 * x * y));
        mesh.normals.emplace_back(0, 0, side == 0 ? 1 : -1);
      }
  const std::uint32_t back = (n + 1) * (n + 1);
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 2, d = a + n + 1;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      if (is_other)
        mesh.triangles.insert(mesh.triangles.end(),
                              {{back + d, back + c, back + b}, {back + d, back + b, back + a}});
      else
        mesh.triangles.insert(mesh.triangles.end(),
                              {{back + c, back + b, back + a}, {back + d, back + c, back + a}});
    }
  // Each side has its half of the picture.
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      mesh.texcoords.emplace_back(
          mesh.positions[v].x / (2.0f * static_cast<float>(n)) + (v >= back ? 0.5f : 0.0f),
          mesh.positions[v].y / static_cast<float>(n));
  return mesh;
}

std::size_t count_twins(const TriMesh& mesh) {
  const std::vector<std::uint32_t> place = match_positions(mesh);
  std::vector<Triangle> welded = mesh.triangles;
  for (Triangle& t : welded)
    for (std::uint32_t& v : t) v = place[v];
  std::size_t n = 0;
  for (const std::uint32_t twin : match_twins(welded, mesh.positions.size())) n += twin != kNoTwin;
  return n;
}

TEST(Backs, AreCutAsTheirFronts) {
  for (const std::uint32_t n : {1u, 2u, 7u})
    for (const float height : {0.0f, 0.3f}) {
      TriMesh mesh = make_sheet(n, true, height);
      EXPECT_EQ(count_twins(mesh), 0u);
      EXPECT_EQ(cut_backs_alike(mesh, match_positions(mesh)), 2 * n * n);
      EXPECT_EQ(count_twins(mesh), 4 * n * n) << n;
      // Corners have kept what belongs to their vertices.
      const TriMesh alike = make_sheet(n, false, height);
      for (std::size_t c = 0; c < mesh.texcoords.size(); ++c) {
        const std::uint32_t v = mesh.triangles[c / 3][c % 3];
        const bool is_back = v >= mesh.positions.size() / 2;
        EXPECT_EQ(mesh.normals[v].z, is_back ? -1 : 1);
        EXPECT_FLOAT_EQ(mesh.texcoords[c].x,
                        mesh.positions[v].x / (2.0f * static_cast<float>(n)) + 0.5f * is_back);
        EXPECT_FLOAT_EQ(mesh.texcoords[c].y, mesh.positions[v].y / static_cast<float>(n));
      }
      double area = 0;
      for (const Triangle& t : mesh.triangles) area += area_normal(mesh, t).z;
      EXPECT_NEAR(area, 0, 1e-5);
      EXPECT_EQ(cut_backs_alike(mesh, match_positions(mesh)), 0u);
    }
}

TEST(Backs, WhatIsNoneStays) {
  TriMesh alike = make_sheet(4, false, 0.3f), cube;
  cube.positions = cube_positions(), cube.triangles = cube_triangles();
  const std::vector<Triangle> before = alike.triangles;
  EXPECT_EQ(cut_backs_alike(alike), 0u);
  EXPECT_EQ(alike.triangles, before);
  EXPECT_EQ(cut_backs_alike(cube), 0u);
  EXPECT_EQ(cut_backs_alike(cube, match_positions(cube)), 0u);
  EXPECT_FALSE(may_have_backs(12, 8));
}

// Where two materials meet along a side's diagonal, or its texture has a seam there, the other side
// is cut; where both have one, neither.
TEST(Backs, SeamsAlongTheDiagonalStay) {
  TriMesh materials = make_sheet(1, true, 0), seam = materials;
  materials.material_names = {"a", "b"};
  materials.materials = {0, 1, 0, 1};
  EXPECT_EQ(cut_backs_alike(materials, match_positions(materials)), 0u);
  materials.materials = {0, 0, 0, 1};
  EXPECT_EQ(cut_backs_alike(materials, match_positions(materials)), 2u);
  EXPECT_EQ(materials.triangles[2], make_sheet(1, true, 0).triangles[2]);
  EXPECT_EQ(count_twins(materials), 4u);
  seam.texcoords[0].x += 0.01f;  // corner a of the first triangle of the front
  seam.texcoords[6].x += 0.01f;  // corner d of the first triangle of the back
  EXPECT_EQ(cut_backs_alike(seam, match_positions(seam)), 0u);
}

}  // namespace
}  // namespace viewcell

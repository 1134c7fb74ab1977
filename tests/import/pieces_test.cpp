#include "import/pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "capture/shapes.h"
#include "mesh/topology.h"

namespace viewcell {
namespace {

double area_of(const TriMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) sum += 0.5 * glm::length(area_normal(mesh, t));
  return sum;
}

double area_of(const LevelPieces& pieces) {
  double sum = 0;
  for (const TriMesh& piece : pieces.pieces) sum += area_of(piece);
  return sum;
}

void append(const TriMesh& from, TriMesh& to) {
  const auto first = static_cast<std::uint32_t>(to.positions.size());
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  for (const Triangle& t : from.triangles)
    to.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

// All pieces as one mesh, welded.
TriMesh join(const LevelPieces& pieces) {
  TriMesh out;
  for (const TriMesh& piece : pieces.pieces) append(piece, out);
  const std::vector<std::uint32_t> place = match_positions(out);
  for (Triangle& t : out.triangles)
    for (std::uint32_t& v : t) v = place[v];
  return out;
}

// A closed surface that is cut stays closed: the new vertices of both sides are the same.
TEST(Pieces, CutsCloseToTheBit) {
  // Of 3.7 edges go through corners of the grid, next to planes that floats round.
  for (const double size : {3.7, 3.0, 2.9, 1.3}) {
    const TriMesh sphere = make_sphere(10, 40, 20, 0.02, 3);
    const LevelPieces cut = cut_into_pieces(sphere, {.size = size});
    EXPECT_GT(cut.pieces.size(), 30u);
    EXPECT_EQ(cut.n_components, 1u);
    EXPECT_EQ(cut.n_cut, 1u);
    EXPECT_NEAR(area_of(cut), area_of(sphere), 1e-4 * area_of(sphere));
    const MeshTopology topology = measure_topology(join(cut));
    EXPECT_EQ(topology.n_boundary_edges, 0u) << size;
    EXPECT_EQ(topology.n_opposed_edges, 0u) << size;
  }
}

TEST(Pieces, EachLiesInItsPlace) {
  const double size = 3;
  const LevelPieces cut = cut_into_pieces(make_sphere(10, 40, 20), {.size = size});
  for (const TriMesh& piece : cut.pieces) {
    const Box box = bounding_box(piece);
    for (int axis = 0; axis < 3; ++axis) {
      const double first = std::floor(box.centre()[axis] / size);
      EXPECT_GE(box.lo[axis], first * size - 1e-5);
      EXPECT_LE(box.hi[axis], (first + 1) * size + 1e-5);
    }
  }
}

// What is not wide stays whole, and what lies in one place becomes one piece.
TEST(Pieces, SmallPartsArePutTogetherWhole) {
  TriMesh level;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 at(i < 5 ? 0.5 * i : 20 + 0.5 * i, 1, 1);
    append(make_box(at, at + 0.4), level);
  }
  const LevelPieces cut = cut_into_pieces(level, {.size = 8});
  ASSERT_EQ(cut.pieces.size(), 2u);
  EXPECT_EQ(cut.n_components, 8u);
  EXPECT_EQ(cut.n_cut, 0u);
  EXPECT_EQ(cut.pieces[0].triangles.size(), 60u);
  EXPECT_EQ(cut.pieces[1].triangles.size(), 36u);
  EXPECT_NEAR(area_of(cut), area_of(level), 1e-4);
}

// A floor of two triangles whose texture coordinates and colours are linear in its places keeps
// them so.
TEST(Pieces, AttributesAreMixed) {
  TriMesh floor;
  floor.positions = {{0, 0, 0}, {32, 0, 0}, {32, 16, 0}, {0, 16, 0}};
  floor.normals.assign(4, {0, 0, 1});
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  floor.material_names = {"a", "b"};
  floor.materials = {1, 0};
  for (const glm::vec3& p : floor.positions) floor.colors.push_back(p / 32.0f);
  for (const Triangle& t : floor.triangles)
    for (const std::uint32_t v : t) floor.texcoords.push_back(glm::vec2(floor.positions[v]) / 4.0f);
  const LevelPieces cut = cut_into_pieces(floor, {.size = 5});
  EXPECT_EQ(cut.pieces.size(), 28u);
  EXPECT_NEAR(area_of(cut), 32 * 16, 1e-2);
  std::map<std::string, double> areas;
  for (const TriMesh& piece : cut.pieces) {
    ASSERT_EQ(piece.texcoords.size(), 3 * piece.triangles.size());
    ASSERT_EQ(piece.materials.size(), piece.triangles.size());
    for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
      areas[piece.material_names[static_cast<std::size_t>(piece.materials[t])]] +=
          0.5 * glm::length(area_normal(piece, piece.triangles[t]));
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = piece.triangles[t][k];
        const glm::vec3& p = piece.positions[v];
        EXPECT_NEAR(piece.texcoords[3 * t + k].x, p.x / 4, 1e-5);
        EXPECT_NEAR(piece.texcoords[3 * t + k].y, p.y / 4, 1e-5);
        EXPECT_NEAR(piece.colors[v].x, p.x / 32, 1e-6);
        EXPECT_EQ(piece.corner_normals[3 * t + k], glm::vec3(0, 0, 1));
      }
    }
  }
  EXPECT_NEAR(areas["a"], 256, 1e-2);
  EXPECT_NEAR(areas["b"], 256, 1e-2);
}

TEST(Pieces, TrianglesWithoutAreaAreDropped) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 1, 3}};
  const LevelPieces cut = cut_into_pieces(mesh, {.size = 10});
  ASSERT_EQ(cut.pieces.size(), 1u);
  EXPECT_EQ(cut.pieces[0].triangles.size(), 1u);
  EXPECT_EQ(cut.n_dropped, 2u);
}

}  // namespace
}  // namespace viewcell

// Faces of any number of corners, out of files.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "base/srgb.h"
#include "common/expect_input_error.h"
#include "common/mutate.h"
#include "formats/mesh_bytes.h"
#include "formats/read_bytes.h"
#include "formats/readers.h"
#include "formats/remarks_of.h"

namespace viewcell {
namespace {

TEST(Faces, OfFewerThanThreeCornersAreCounted) {
  const std::string off = replaced(cube_off(), "4 4 5 6 7", "2 4 5");
  const std::string ply = replaced(cube_ply(), "4 4 5 6 7", "2 4 5");
  for (const auto& [name, bytes] : {std::pair("m.off", off), {"m.ply", ply}}) {
    const auto [mesh, remarks] = read_bytes(name, bytes);
    EXPECT_EQ(mesh.triangles.size(), 10u) << name;
    EXPECT_EQ(count_of(remarks, "faces of fewer than three corners"), 1u) << name;
  }
  for (const char* row : {"0", "1 4"})
    EXPECT_EQ(parse_off(replaced(cube_off(), "4 4 5 6 7", row), "m").triangles.size(), 10u);
}

// The L, from each corner on, by every format that has polygons; texture coordinates go with the
// corners.
TEST(Faces, ThatAreNotConvex) {
  const float x[] = {0, 2, 2, 1, 1, 0}, y[] = {0, 0, 1, 1, 2, 2};
  std::string obj, off = "OFF 6 1 0\n", vertices;
  for (int k = 0; k < 6; ++k) {
    const std::string row = std::to_string(x[k]) + " " + std::to_string(y[k]);
    obj += "v " + row + " 0\nvt " + row + "\n";
    vertices += row + " 0\n";
  }
  for (int start = 0; start < 6; ++start) {
    std::string face = "f", row = "6", texcoords = " 12";
    for (int k = 0; k < 6; ++k) {
      const int v = (start + k) % 6;
      const std::string one = std::to_string(v + 1);
      face += " " + one + "/" + one;
      row += " " + std::to_string(v);
      texcoords += " " + std::to_string(x[v]) + " " + std::to_string(y[v]);
    }
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
        "property list uchar double texcoord\nend_header\n" +
        vertices + row + texcoords + "\n";
    for (const TriMesh& mesh : {parse_obj(obj + face + "\n", "m"), parse_ply_mesh(ply, "m"),
                                parse_off(off + vertices + row + "\n", "m")}) {
      ASSERT_EQ(mesh.triangles.size(), 4u);
      double area = 0;
      for (const Triangle& t : mesh.triangles) {
        EXPECT_GE(area_normal(mesh, t).z, 0);
        area += area_normal(mesh, t).z / 2;
      }
      EXPECT_DOUBLE_EQ(area, 3);
      for (std::size_t c = 0; c < mesh.texcoords.size(); ++c)
        EXPECT_EQ(mesh.texcoords[c], glm::vec2(mesh.positions[mesh.triangles[c / 3][c % 3]]));
    }
  }
}

// As 3D scanners write grids with holes.
// Alpha behind the colour, or a weight before it.
// Exporters leave blanks or a signature behind the facets.
// A sheet of quads and one of hexagons, told from each side: from any corner on, on vertices of
// their own or not, three times over. Whatever is on a back is on its front, too.
TEST(Faces, SheetsOfTwoSidesAreCutAlike) {
  Random random(1);
  for (const std::size_t n : {4u, 6u})
    for (const bool has_own : {false, true}) {
      SCOPED_TRACE(std::to_string(n) + (has_own ? ", own vertices" : ""));
      std::string text;
      std::vector<glm::vec3> corners;
      for (int face = 0; face < 30; ++face)
        for (std::size_t k = 0; k < n; ++k) {
          const double angle = 2 * 3.14159265 * static_cast<double>(k) / static_cast<double>(n);
          corners.emplace_back(3 * face + std::cos(angle), std::sin(angle), random.uniform(-1, 1));
        }
      const int n_sides = 3;
      for (int side = 0; side < (has_own ? n_sides : 1); ++side)
        for (const glm::vec3& p : corners)
          text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
                  std::to_string(p.z) + "\n";
      for (int side = 0; side < n_sides; ++side)
        for (std::size_t face = 0; face < 30; ++face) {
          text += "f";
          const std::size_t first = random.below(static_cast<std::uint32_t>(n));
          for (std::size_t k = 0; k < n; ++k) {
            const std::size_t at = (side == 1 ? first + n - k : first + k) % n;
            text += " " + std::to_string(1 + face * n + at +
                                         (has_own ? corners.size() * std::size_t(side) : 0));
          }
          text += "\n";
        }
      const TriMesh mesh = parse_obj(text, "m");
      const std::size_t n_side = mesh.triangles.size() / n_sides;
      ASSERT_EQ(n_side, 30 * (n - 2));
      const auto at = [&](std::size_t t, std::size_t k) {
        return mesh.triangles[t][k] % corners.size();
      };
      for (std::size_t t = 0; t < n_side; ++t) {
        std::array<std::size_t, 3> sorted[3];
        for (std::size_t side = 0; side < 3; ++side) {
          const std::size_t other = t + side * n_side;
          sorted[side] = {at(other, 0), at(other, 1), at(other, 2)};
          const auto& c = sorted[side];
          const glm::dvec3 normal = glm::cross(glm::dvec3(corners[c[1]] - corners[c[0]]),
                                               glm::dvec3(corners[c[2]] - corners[c[0]]));
          EXPECT_EQ(normal.z > 0, side != 1);
          std::sort(sorted[side].begin(), sorted[side].end());
        }
        EXPECT_EQ(sorted[0], sorted[1]);
        EXPECT_EQ(sorted[0], sorted[2]);
      }
    }
}

TEST(Faces, ThatCrossThemselvesAreSaid) {
  Remarks remarks;
  const TriMesh mesh =
      parse_obj("v 0 0 0\nv 3 3 0\nv 3 0 0\nv 0 1 0\nf 1 2 3 4\nf 1 2 3\n", "m", &remarks);
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(count_of(remarks, "polygons that cross themselves"), 1u);
}

TEST(Faces, PointsAloneAreNoSurface) {
  const TemporaryFolder folder;
  const auto off = folder.add("a.off", "OFF 2 0 0\n0 0 0\n1 2 3\n");
  EXPECT_INPUT_ERROR(read_mesh(off), "has no faces");
  EXPECT_EQ(read_surface_or_points(off).positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 2, 3}}));
  EXPECT_INPUT_ERROR(read_surface_or_points(folder.add("n.off", "OFF 0 0 0\n")), "no vertices");
  EXPECT_EQ(read_surface_or_points(folder.add("a.obj", "v 1 2 3\np 1\n")).positions.size(), 1u);
}

}  // namespace
}  // namespace viewcell

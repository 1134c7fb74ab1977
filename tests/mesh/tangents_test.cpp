#include "mesh/tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "base/random.h"

namespace viewcell {
namespace {

std::vector<glm::vec4> tangents_of(const TriMesh& mesh) {
  return make_corner_tangents(mesh, make_corner_normals(mesh));
}

void expect_near(const glm::vec4& a, const glm::dvec4& b, double within = 1e-6) {
  for (int k = 0; k < 4; ++k)
    EXPECT_NEAR(a[k], b[k], within) << k << " of " << a.x << " " << a.y << " " << a.z << " " << a.w;
}

// A triangle in the plane z = 0 with the texture coordinates uv at its corners.
void add_triangle(TriMesh& mesh, const std::array<glm::vec2, 3>& p,
                  const std::array<glm::vec2, 3>& uv) {
  Triangle t;
  for (std::size_t k = 0; k < 3; ++k) {
    t[k] = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.emplace_back(p[k], 0);
    mesh.normals.emplace_back(0, 0, 1);
    mesh.texcoords.push_back(uv[k]);
  }
  mesh.triangles.push_back(t);
}

const std::array<glm::vec2, 3> kHalf{{{0, 0}, {1, 0}, {0, 1}}};

TEST(Tangents, PointWhereUGrows) {
  TriMesh mesh;
  add_triangle(mesh, kHalf, {{{0, 0}, {3, 0}, {0, 0.1}}});
  add_triangle(mesh, kHalf, {{{5, 0}, {4, 0}, {5, 1}}});     // mirrored
  add_triangle(mesh, kHalf, {{{9, 9}, {9, 10}, {8, 9}}});    // turned by 90 degrees
  add_triangle(mesh, kHalf, {{{0, 20}, {1, 20}, {1, 21}}});  // sheared: u grows along y, too
  const std::vector<glm::vec4> tangents = tangents_of(mesh);
  for (std::size_t k = 0; k < 3; ++k) {
    expect_near(tangents[k], {1, 0, 0, 1});
    expect_near(tangents[3 + k], {-1, 0, 0, -1});
    expect_near(tangents[6 + k], {0, -1, 0, 1});
    expect_near(tangents[9 + k], {1, 0, 0, 1});
  }
}

//   C---B       around O the triangle OAB has 90 degrees and u along x,
//    \  |\      OBC 45 degrees and u along (1, -1)
//      \O-A
TEST(Tangents, AreWeightedByAngle) {
  TriMesh mesh;
  add_triangle(mesh, kHalf, kHalf);
  add_triangle(mesh, {{{0, 0}, {0, 1}, {-1, 1}}}, {{{0, 0}, {0, 1}, {-1, 0}}});
  const std::vector<glm::vec4> tangents = tangents_of(mesh);
  const glm::dvec2 at_o =
      glm::normalize(2.0 * glm::dvec2(1, 0) + glm::normalize(glm::dvec2(1, -1)));
  expect_near(tangents[0], {at_o, 0, 1});
  expect_near(tangents[3], {at_o, 0, 1});
  expect_near(tangents[1], {1, 0, 0, 1});
  expect_near(tangents[5], {glm::normalize(glm::dvec2(1, -1)), 0, 1});
}

// Where u turns back at x = 0, and where a chart ends, nothing is mixed.
TEST(Tangents, EndAtMirrorsAndSeams) {
  for (const float shift : {0.f, 7.f}) {
    TriMesh mesh;
    add_triangle(mesh, kHalf, kHalf);
    const float u = shift + 1;
    add_triangle(mesh, {{{0, 0}, {0, 1}, {-1, 0}}}, {{{shift, 0}, {shift, 1}, {u, 0}}});
    const std::vector<glm::vec4> tangents = tangents_of(mesh);
    const glm::dvec2 right(1, 0), left(-1, 0);
    expect_near(tangents[0], {right, 0, 1});
    expect_near(tangents[3], {left, 0, -1});
    expect_near(tangents[4], {left, 0, -1});
  }
}

TEST(Tangents, WithoutAreaInTheTextureTheNeighboursServe) {
  TriMesh mesh;
  add_triangle(mesh, kHalf, {{{5, 0}, {4, 0}, {5, 1}}});
  add_triangle(mesh, {{{0, 0}, {0, 1}, {-1, 1}}}, {{{5, 0}, {5, 1}, {5, 2}}});
  const std::vector<glm::vec4> tangents = tangents_of(mesh);
  expect_near(tangents[3], {-1, 0, 0, -1});
  expect_near(tangents[4], {-1, 0, 0, -1});
  EXPECT_NEAR(glm::length(glm::vec3(tangents[5])), 1, 1e-6);
  EXPECT_NEAR(tangents[5].z, 0, 1e-6);
  EXPECT_EQ(tangents[5].w, 1);
}

// The unit sphere but for its poles, u around and v up; u grows along the circles of latitude.
TriMesh make_globe(int n) {
  TriMesh mesh;
  const auto add = [&](int i, int j) {
    const double a = glm::two_pi<double>() * i / n, b = glm::pi<double>() * (0.1 + 0.8 * j / n);
    mesh.positions.emplace_back(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), -std::cos(b));
    mesh.normals.push_back(mesh.positions.back());
    mesh.texcoords.emplace_back(double(i) / n, double(j) / n);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      for (const bool is_upper : {false, true}) {
        const std::uint32_t a = add(i, j), b = is_upper ? add(i + 1, j + 1) : add(i + 1, j);
        mesh.triangles.push_back({a, b, is_upper ? add(i, j + 1) : add(i + 1, j + 1)});
      }
  return mesh;
}

TEST(Tangents, OfAGlobeFollowLatitude) {
  const TriMesh globe = make_globe(48);
  const std::vector<glm::vec4> tangents = tangents_of(globe);
  for (std::size_t c = 0; c < tangents.size(); ++c) {
    const glm::vec3& p = globe.positions[c];
    const glm::vec3 east = glm::normalize(glm::vec3(-p.y, p.x, 0));
    EXPECT_GT(glm::dot(glm::vec3(tangents[c]), east), std::cos(glm::radians(4.5))) << c;
    EXPECT_EQ(tangents[c].w, 1);
  }
}

// Unit and across the normal; turned, moved and scaled with the mesh; whatever the order. Seeded.
TEST(Tangents, TurnWithTheMesh) {
  Random random(11);
  const TriMesh globe = make_globe(9);
  const std::vector<glm::vec4> tangents = tangents_of(globe);
  for (int round = 0; round < 5; ++round) {
    const glm::dvec3 axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), random.uniform(0, 6), glm::normalize(axis)));
    TriMesh turned = globe;
    for (glm::vec3& p : turned.positions) p = 3.0 * turn * glm::dvec3(p) + axis;
    for (glm::vec3& n : turned.normals) n = turn * glm::dvec3(n);
    const std::vector<glm::vec4> of_turned = tangents_of(turned);
    for (std::size_t c = 0; c < tangents.size(); ++c) {
      const glm::dvec3 t(of_turned[c]);
      EXPECT_NEAR(glm::length(t), 1, 1e-6);
      EXPECT_NEAR(glm::dot(t, glm::dvec3(turned.normals[c])), 0, 1e-6);
      // Rounding parts vertices that stood at one position: the mean is then a triangle's own.
      EXPECT_GT(glm::dot(t, turn * glm::dvec3(tangents[c])), 0.9);
    }
  }
}

TEST(Tangents, FramesAreMixedAndNotMadeUnit) {
  const glm::vec3 normals[3] = {{0, 0, 1}, {1, 0, 0}, {0, 0, 1}};
  const glm::vec4 tangents[3] = {{1, 0, 0, -1}, {0, 0, -1, -1}, {1, 0, 0, -1}};
  const glm::dmat3 frame = mix_tangent_frame(normals, tangents, {0.25, 0.5, 0.25});
  EXPECT_EQ(frame[0], glm::dvec3(0.5, 0, -0.5));
  EXPECT_EQ(frame[1], -glm::cross(glm::dvec3(0.5, 0, 0.5), glm::dvec3(0.5, 0, -0.5)));
  EXPECT_EQ(frame[2], glm::dvec3(0.5, 0, 0.5));
}

}  // namespace
}  // namespace viewcell

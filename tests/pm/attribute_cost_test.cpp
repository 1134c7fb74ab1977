// Materials and colours as borders and costs, and normals of corners.
#include "pm/attribute_cost.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "base/random.h"
#include "pm/build.h"
#include "pm/pm_file.h"
#include "pm/shapes.h"
#include "pm/ways.h"

#include "common/temporary_folder.h"

namespace viewcell {
namespace {

glm::vec2 centre_of(const TriMesh& mesh, const Triangle& t) {
  return glm::vec2(mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0f;
}

bool is_in_disc(const glm::vec2& p, float n) {
  return glm::distance(p, glm::vec2(0.5f * n)) < 0.3f * n;
}

// A flat plate of n x n squares, whose faces in a disc have another material.
TriMesh make_plate(std::uint32_t n, bool has_texture) {
  TriMesh mesh = make_flat_grid(n);
  mesh.material_names = {"ground", "disc"};
  for (const Triangle& t : mesh.triangles) {
    mesh.materials.push_back(is_in_disc(centre_of(mesh, t), static_cast<float>(n)));
    for (const std::uint32_t v : t)
      if (has_texture)
        mesh.texcoords.push_back(glm::vec2(mesh.positions[v]) / static_cast<float>(n));
  }
  return mesh;
}

double area_of(const TriMesh& mesh, std::int32_t material) {
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.materials[t] == material)
      area += 0.5 * glm::length(area_normal(mesh, mesh.triangles[t]));
  return area;
}

std::string name_of(const Way& way) {
  return std::string(metric_name(way.metric)) + " " + placement_name(way.placement);
}

TEST(Attributes, ADiscOfAnotherMaterialKeepsItsArea) {
  for (const Way& way : kWays) {
    SCOPED_TRACE(name_of(way));
    const TriMesh plate = make_plate(32, texture_needs(options_of(way)).coordinates);
    const double disc = area_of(plate, 1);
    const BuildResult built = build_progressive_mesh(plate, options_of(way));
    EXPECT_GT(built.n_region_edges, 60u);
    ProgressiveMesh pm(built.record);
    pm.set_faces(200);
    ASSERT_LE(pm.n_faces(), 200u);
    EXPECT_NEAR(area_of(pm.extract(), 1), disc, 0.01 * disc);
    pm.set_faces(60);
    ASSERT_LE(pm.n_faces(), 60u);
    EXPECT_NEAR(area_of(pm.extract(), 1), disc, 0.06 * disc);
    pm.set_level(pm.n_splits());
    EXPECT_EQ(pm.extract().triangles, plate.triangles);
    EXPECT_EQ(pm.extract().materials, plate.materials);
    EXPECT_EQ(pm.extract().texcoords, plate.texcoords);
  }
}

// The border goes no farther than the bound asked for.
TEST(Attributes, BordersStayWithinTheBound) {
  const TriMesh plate = make_plate(32, false);
  BuildOptions options;
  options.error_bound = 0.5f;
  ProgressiveMesh pm(build_progressive_mesh(plate, options).record);
  const TriMesh left = pm.extract();
  EXPECT_LT(left.triangles.size(), 200u);
  int n_seen = 0;
  for (std::size_t t = 0; t < left.triangles.size(); ++t) {
    if (left.materials[t] != 1) continue;
    for (const std::uint32_t v : left.triangles[t]) {
      ++n_seen;
      EXPECT_LT(glm::distance(glm::vec2(left.positions[v]), glm::vec2(16)), 0.3f * 32 + 1.5f);
    }
  }
  EXPECT_GT(n_seen, 10);
  EXPECT_NEAR(area_of(left, 1), area_of(plate, 1), 0.5 * 2 * M_PI * 0.3 * 32);
}

TEST(Attributes, IgnoredMaterialsHoldNothingBack) {
  const TriMesh plate = make_plate(16, false);
  TriMesh plain = plate;
  plain.materials.clear();
  BuildOptions options;
  options.ignore_materials = true;
  const ProgressiveRecord a = build_progressive_mesh(plate, options).record;
  const ProgressiveRecord b = build_progressive_mesh(plain, {}).record;
  ASSERT_EQ(a.splits.size(), b.splits.size());
  for (std::size_t i = 0; i < a.splits.size(); ++i) {
    EXPECT_EQ(a.splits[i].child, b.splits[i].child);
    EXPECT_EQ(a.splits[i].cost, b.splits[i].cost);
  }
}

// One material for all, and one colour, are as none.
TEST(Attributes, WhatIsTheSameEverywhereCostsNothing) {
  const TriMesh plain = make_noisy_sphere(3, 0.1, 2);
  TriMesh same = plain;
  same.material_names = {"all"};
  same.materials.assign(same.triangles.size(), 0);
  same.colors.assign(same.positions.size(), {0.5f, 0.25f, 1});
  for (const Way& way : kWays) {
    if (texture_needs(options_of(way)).coordinates) continue;
    const ProgressiveRecord a = build_progressive_mesh(plain, options_of(way)).record;
    const ProgressiveRecord b = build_progressive_mesh(same, options_of(way)).record;
    ASSERT_EQ(a.splits.size(), b.splits.size()) << name_of(way);
    for (std::size_t i = 0; i < a.splits.size(); ++i) ASSERT_EQ(a.splits[i].cost, b.splits[i].cost);
  }
}

// Share of the plate's area that is nearer to red than to blue.
double red_area(const TriMesh& mesh) {
  double red = 0;
  for (const Triangle& t : mesh.triangles) {
    const double area = 0.5 * glm::length(area_normal(mesh, t));
    for (const std::uint32_t v : t) red += area / 3 * mesh.colors[v].x;
  }
  return red;
}

TriMesh paint_plate(std::uint32_t n, const std::function<bool(const glm::vec2&)>& is_red) {
  TriMesh plate = make_flat_grid(n);
  for (const glm::vec3& p : plate.positions)
    plate.colors.push_back(is_red(glm::vec2(p)) ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1));
  return plate;
}

// Colours of vertices that shade from one to the other: no border anywhere, but a cost. A disc, and
// a band of one vertex' width.
TEST(Attributes, ColoursOfVerticesAreKept) {
  const TriMesh disc = paint_plate(32, [](const glm::vec2& p) { return is_in_disc(p, 32); });
  const TriMesh band = paint_plate(40, [](const glm::vec2& p) { return p.x == 20; });
  for (const Way& way : kWays)
    for (TriMesh plate : {disc, band}) {
      SCOPED_TRACE(name_of(way) +
                   (plate.positions.size() == disc.positions.size() ? "" : ", band"));
      if (texture_needs(options_of(way)).coordinates)
        for (const Triangle& t : plate.triangles)
          for (const std::uint32_t v : t)
            plate.texcoords.push_back(glm::vec2(plate.positions[v]) / 40.0f);
      ProgressiveMesh pm(build_progressive_mesh(plate, options_of(way)).record);
      pm.set_faces(300);
      ASSERT_LE(pm.n_faces(), 300u);
      EXPECT_NEAR(red_area(pm.extract()), red_area(plate), 0.02 * red_area(plate));
    }
}

// Two colours at each position of the border, on vertices of their own: a seam.
TEST(Attributes, SeamsOfColoursAreBorders) {
  TriMesh plate = make_plate(32, false);
  const double disc = area_of(plate, 1);
  const auto n = static_cast<std::uint32_t>(plate.positions.size());
  plate.colors.assign(n, {0, 0, 1});
  for (std::uint32_t v = 0; v < n; ++v) plate.positions.push_back(plate.positions[v]);
  plate.colors.resize(2 * n, {1, 0, 0});
  for (std::size_t t = 0; t < plate.triangles.size(); ++t)
    for (std::uint32_t& v : plate.triangles[t]) v += plate.materials[t] == 1 ? n : 0;
  plate.materials.clear();
  for (const Way& way : kWays) {
    if (texture_needs(options_of(way)).coordinates) continue;
    SCOPED_TRACE(name_of(way));
    ProgressiveMesh pm(build_progressive_mesh(plate, options_of(way)).record);
    pm.set_faces(200);
    ASSERT_LE(pm.n_faces(), 200u);
    EXPECT_NEAR(red_area(pm.extract()), disc, 0.01 * disc);
  }
}

// The quadric against its definition: for each face the colour of its plane at a point.
TEST(ColourQuadric, IsTheSumOverFaces) {
  Random random(3);
  const auto number = [&] { return random.uniform(-1, 1); };
  const auto vector = [&] { return glm::dvec3(number(), number(), number()); };
  for (int round = 0; round < 50; ++round) {
    ColourQuadric sum;
    const glm::dvec3 at = vector(), colour = vector();
    double value = 0, size = 0;
    for (int face = 0; face < 4; ++face) {
      const glm::dvec3 p[3] = {vector(), vector(), vector()};
      const glm::dvec3 c[3] = {vector(), vector(), vector()};
      const double w = 0.1 + std::abs(number());
      ColourQuadric one;
      one.add_triangle(p, c, w);
      sum.add(one);
      // barycentric coordinates of the point's foot on the plane
      const glm::dvec3 e1 = p[1] - p[0], e2 = p[2] - p[0], n = glm::cross(e1, e2), r = at - p[0];
      const double s = glm::dot(glm::cross(r, e2), n) / glm::dot(n, n);
      const double t = glm::dot(glm::cross(e1, r), n) / glm::dot(n, n);
      const glm::dvec3 off = c[0] + s * (c[1] - c[0]) + t * (c[2] - c[0]) - colour;
      value += w * glm::dot(off, off);
      size += one.c + std::abs(value);
    }
    EXPECT_NEAR(sum.value(at, colour), value, 1e-9 * size + 1e-9);
  }
}

// Every corner of a fine cube has its face's normal, by corner: faces stay faceted at all levels.
TEST(CornerNormals, HardEdgesStayHardWhileFacesGo) {
  TriMesh cube = make_fine_cube(6);
  for (const Triangle& t : cube.triangles)
    for (int k = 0; k < 3; ++k)
      cube.corner_normals.push_back(glm::vec3(glm::normalize(area_normal(cube, t))));
  TriMesh plain = cube;
  plain.corner_normals.clear();
  for (const Way& way : kWays) {
    if (texture_needs(options_of(way)).coordinates) continue;
    SCOPED_TRACE(name_of(way));
    const ProgressiveRecord record = build_progressive_mesh(cube, options_of(way)).record;
    EXPECT_EQ(record.splits.size(),
              build_progressive_mesh(plain, options_of(way)).record.splits.size());
    const TemporaryFolder folder;
    write_pm(folder / "cube.pm", record);
    ProgressiveMesh pm(read_pm(folder / "cube.pm"));
    for (const std::size_t n : {1000u, 300u, 100u, 40u, 12u}) {
      pm.set_faces(n);
      const TriMesh level = pm.extract();
      ASSERT_EQ(level.corner_normals.size(), 3 * level.triangles.size());
      for (std::size_t c = 0; c < level.corner_normals.size(); ++c)
        EXPECT_GT(glm::dot(glm::dvec3(level.corner_normals[c]),
                           glm::normalize(area_normal(level, level.triangles[c / 3]))),
                  0.99)
            << n << " corner " << c;
    }
    pm.set_level(pm.n_splits());
    EXPECT_EQ(pm.extract().corner_normals, cube.corner_normals);
    EXPECT_EQ(pm.extract().triangles, cube.triangles);
  }
}

TEST(CornerNormals, NormalsAgainstTheWindingStaySo) {
  TriMesh sphere = make_noisy_sphere(3, 0.05, 8);
  for (const glm::vec3& p : sphere.positions) sphere.normals.push_back(-glm::normalize(p));
  TriMesh by_corner = sphere;
  by_corner.normals.clear();
  for (const Triangle& t : sphere.triangles)
    for (const std::uint32_t v : t) by_corner.corner_normals.push_back(sphere.normals[v]);
  for (const TriMesh& mesh : {sphere, by_corner}) {
    BuildOptions options;
    options.placement = Placement::full;
    ProgressiveMesh pm(build_progressive_mesh(mesh, options).record);
    pm.set_faces(200);
    const TriMesh left = pm.extract();
    for (std::size_t t = 0; t < left.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = left.triangles[t][k];
        const glm::vec3 normal =
            left.normals.empty() ? left.corner_normals[3 * t + k] : left.normals[v];
        EXPECT_LT(glm::dot(normal, left.positions[v]), 0);
      }
  }
}

}  // namespace
}  // namespace viewcell

#include "cells/own_materials.h"

#include <gtest/gtest.h>

#include "capture/shapes.h"

namespace viewcell {
namespace {

// Spheres of radius 5 along +x from the middle of the first cell, at its eye's height.
Scene make_row(const std::vector<double>& distances, int n_around) {
  Scene scene = make_scene_of(make_sphere(5, n_around, n_around / 2));
  scene.area = {{0, -20}, {2000, 20}};
  scene.materials.push_back({.base_color_texture = "paper.png"});
  const SceneObject first = scene.objects[0];
  scene.objects.clear();
  for (const double d : distances) {
    SceneObject& object = scene.objects.emplace_back(first);
    object.translation = {d, -20, 18};
  }
  return scene;
}

std::vector<ObjectId> own_of_first(const Scene& scene, const OwnMaterialOptions& options = {}) {
  return find_own_materials(scene, make_cells(scene, 50, {16, 20}), options).at(0);
}

std::vector<ObjectId> ids(std::initializer_list<int> numbers) {
  std::vector<ObjectId> out;
  for (const int n : numbers) out.push_back(ObjectId(n));
  return out;
}

// A ball of radius 5 sqrt(3), its box', at distance d has pi (886.8 * 8.66 / d)^2 px.
TEST(OwnMaterials, FewTrianglesForWhatShows) {
  const Scene scene = make_row({60, 80, 400, 1500}, 10);  // 80 triangles
  const double n = static_cast<double>(scene.meshes[0].n_triangles);
  std::vector<ObjectId> expected;
  int i = 0;
  for (const double d : {60.0, 80.0, 400.0, 1500.0}) {
    const double px = std::acos(-1.0) * std::pow(886.81 * 8.6603 / d, 2);
    if (n <= px / 256) expected.push_back(ObjectId(i));
    ++i;
  }
  ASSERT_EQ(expected.size(), 2u);
  EXPECT_EQ(own_of_first(scene), expected);
  EXPECT_EQ(own_of_first(scene, {.px_per_triangle = 1e9}), ids({}));
  EXPECT_EQ(own_of_first(scene, {.few_triangles = 1000}), ids({0, 1, 2, 3}));
}

// Pictures are not smeared: nearer than twice the cell's size, whatever it costs.
TEST(OwnMaterials, NearPicturesAreTheirOwn) {
  Scene scene = make_row({90, 104.9, 105.1, 300}, 400);
  EXPECT_EQ(own_of_first(scene), ids({}));
  for (SceneObject& object : scene.objects) object.materials = {1};
  EXPECT_EQ(own_of_first(scene), ids({0, 1}));
}

TEST(OwnMaterials, WhatIsInsideIsNotOutside) {
  const Scene scene = make_row({10, 80}, 8);
  const CellSet cells = make_cells(scene, 50, {16, 20});
  const auto own = find_own_materials(scene, cells);
  ASSERT_EQ(own.size(), static_cast<std::size_t>(cells.grid.n_cells()));
  for (int c = 0; c < cells.grid.n_cells(); ++c)
    for (const ObjectId o : own[static_cast<std::size_t>(c)])
      EXPECT_FALSE(is_inside(cells, CellId(c), o));
  EXPECT_EQ(own[0], ids({1}));
}

}  // namespace
}  // namespace viewcell

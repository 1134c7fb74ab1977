// Surfaces as people have them: torn, two-sided, in many small parts, in two pieces.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "bake/cell_mesh.h"
#include "bake/small_bake.h"
#include "mesh/topology.h"

namespace viewcell {
namespace {

// The scene's meshes for one cell, each as what it would be chosen to be.
class OneCell {
 public:
  explicit OneCell(Scene scene, const BakeOptions& options = make_options())
      : scene_(std::move(scene)), options_(options) {
    scene_.area = {{0, 0}, {300, 300}};
    cells_ = make_cells(scene_, 40, {});
    bake_.emplace(build_bake_scene(scene_, cells_, 1));
  }

  static BakeOptions make_options() {
    BakeOptions options;
    options.resolution_px = 256;
    return options;
  }

  CellMesh derive(ObjectId id) {
    CellObject chosen = choose_representation(*bake_, kCell, id, options_);
    const RayCapture rays(scene_, 1);
    std::vector<ClassifiedView> views;
    const auto centres = views_of(cells_.grid, kCell);
    const int n = chosen.kind == Representation::single_view ? 1 : kViews;
    for (int k = 0; k < n; ++k)
      if (auto view =
              classify_view(scene_, rays, id, eye_of(cells_, centres[static_cast<std::size_t>(k)]),
                            {.resolution_px = options_.resolution_px}, k))
        views.push_back(std::move(*view));
    EXPECT_FALSE(views.empty());
    return derive_mesh(*bake_, kCell, std::move(chosen), views, options_, counts);
  }
  CellMesh derive_first() { return derive(ObjectId(0)); }
  const Scene& scene() const { return scene_; }

  CellMeshCounts counts;

 private:
  static constexpr CellId kCell{0};
  Scene scene_;
  BakeOptions options_;
  CellSet cells_;
  std::optional<BakeScene> bake_;
};

Scene place(TriMesh mesh, const glm::dvec3& at, bool double_sided = false) {
  Scene scene = make_scene_of(std::move(mesh), double_sided);
  scene.objects[0].translation = at;
  return scene;
}

TriMesh tear(const TriMesh& mesh) {
  TriMesh out;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    for (const std::uint32_t v : t) {
      out.positions.push_back(mesh.positions[v]);
      if (!mesh.normals.empty()) out.normals.push_back(mesh.normals[v]);
    }
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

// n x n squares of a square of that side in the plane y = 0, its front towards -y.
TriMesh make_wall(int n, double side) {
  TriMesh mesh;
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.positions.emplace_back(side * i / n, 0, side * j / n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

double area_of(const CellMesh& mesh) {
  TriMesh flat;
  flat.positions = mesh.vertices.positions;
  double area = 0;
  for (const Triangle& t : mesh.triangles) area += 0.5 * glm::length(area_normal(flat, t));
  return area;
}

std::vector<std::array<float, 3>> sorted_positions(const CellMesh& mesh) {
  std::vector<std::array<float, 3>> out;
  for (const glm::vec3& p : mesh.vertices.positions) out.push_back({p.x, p.y, p.z});
  std::sort(out.begin(), out.end());
  return out;
}

// However a file splits a surface, its bake is that of the whole.
TEST(BakedSurface, TornIsAsWhole) {
  TriMesh ball = make_sphere(15, 48, 24);
  ball.normals.clear();
  const CellMesh whole = OneCell(place(ball, {150, 120, 18})).derive_first();
  const CellMesh torn = OneCell(place(tear(ball), {150, 120, 18})).derive_first();
  EXPECT_GT(whole.triangles.size(), 20u);
  EXPECT_EQ(torn.triangles.size(), whole.triangles.size());
  EXPECT_EQ(sorted_positions(torn), sorted_positions(whole));
}

// Facets keep their normals: at one place the drawn vertices differ in nothing else.
TEST(BakedSurface, HardEdgesStayHard) {
  OneCell one(place(make_box({-15, -15, -15}, {15, 15, 15}), {150, 120, 18}));
  const CellMesh box = one.derive_first();
  EXPECT_GT(box.triangles.size(), 3u);
  std::map<std::array<float, 3>, std::size_t> n_at;
  for (const auto& p : sorted_positions(box)) ++n_at[p];
  EXPECT_GT(std::count_if(n_at.begin(), n_at.end(), [](const auto& n) { return n.second > 1; }), 1);
  TriMesh drawn;
  drawn.positions = box.vertices.positions;
  for (const Triangle& t : box.triangles) {
    const glm::dvec3 normal = glm::normalize(area_normal(drawn, t));
    for (const std::uint32_t v : t)
      EXPECT_NEAR(glm::dot(normal, glm::dvec3(box.vertices.normals[v])), 1, 1e-3);
  }
}

// Seen from behind, a double-sided wall is there, and views show it.
TEST(BakedSurface, DoubleSidedFromBehind) {
  const TriMesh wall = make_wall(8, 40);
  Scene scene = place(wall, {170, 130, 0}, true);
  scene.objects[0].rotation = glm::angleAxis(3.14159265, glm::dvec3(0, 0, 1));  // its back to us
  OneCell one(std::move(scene));
  const CellMesh back = one.derive_first();
  ASSERT_FALSE(back.triangles.empty());
  EXPECT_NEAR(area_of(back), 1600, 1);
  for (const std::uint8_t views : back.vertices.views) EXPECT_NE(views, 0);
}

// A sheet of twins is one surface while it collapses, and its side that the cell sees comes back.
TEST(BakedSurface, TwinsComeBack) {
  TriMesh sheet = make_wall(8, 40);
  const std::size_t n = sheet.triangles.size();
  for (std::size_t t = 0; t < n; ++t) {
    const Triangle front = sheet.triangles[t];
    sheet.triangles.push_back({front[2], front[1], front[0]});
  }
  OneCell one(place(sheet, {150, 130, 0}));
  const CellMesh mesh = one.derive_first();
  EXPECT_NEAR(area_of(mesh), 1600, 1);  // one side: the other is back-facing to the cell
  EXPECT_LT(mesh.triangles.size(), n / 4);
  for (const glm::vec3& normal : mesh.vertices.normals) EXPECT_NEAR(normal.y, -1, 1e-5);
  EXPECT_LE(one.counts.n_start, n);  // one of two
}

// Cards of about a pixel: none vanishes, and little of their area does.
TEST(BakedSurface, SmallPartsKeepTheirArea) {
  TriMesh bush;
  Random random(4);
  constexpr std::size_t kCards = 400;
  for (std::size_t i = 0; i < kCards; ++i) {
    const auto first = static_cast<std::uint32_t>(bush.positions.size());
    const glm::vec3 at(random.uniform(-8, 8), random.uniform(-8, 8), random.uniform(0, 20));
    for (const auto& [x, z] : {std::pair{0.f, 0.f}, {0.4f, 0.f}, {0.4f, 0.4f}, {0.f, 0.4f}})
      bush.positions.push_back(at + glm::vec3(x, 0, z));
    bush.triangles.push_back({first, first + 1, first + 2});
    bush.triangles.push_back({first, first + 2, first + 3});
  }
  const double area = 0.16 * kCards;
  BakeOptions options = OneCell::make_options();
  options.start_error_px = 1;  // coarse levels would take away half
  const CellMesh mesh = OneCell(place(bush, {150, 120, 0}), options).derive_first();
  EXPECT_GT(area_of(mesh), 0.95 * area);
  EXPECT_LE(area_of(mesh), area * 1.0001);
}

TEST(BakedSurface, WhatViewsShowNeverVanishes) {
  TriMesh one;
  one.positions = {{0, 0, 0}, {20, 0, 0}, {0, 0, 20}};
  one.triangles = {{0, 1, 2}};
  BakeOptions options = OneCell::make_options();
  options.max_drift_px = 1000, options.tl_px = 1000;
  EXPECT_EQ(OneCell(place(one, {150, 150, 0}), options).derive_first().triangles.size(), 1u);
}

// A ball in two halves: the vertices of the rim between them stay in both, where they are.
TEST(BakedSurface, PiecesKeepTheRimThatTheyShare) {
  const TriMesh ball = make_sphere(15, 48, 24);
  TriMesh halves[2];
  for (TriMesh& half : halves) half.positions = ball.positions;
  for (const Triangle& t : ball.triangles) {
    const float z = ball.positions[t[0]].z + ball.positions[t[1]].z + ball.positions[t[2]].z;
    halves[z > 0].triangles.push_back(t);
  }
  Scene scene = place(halves[0], {150, 120, 18});
  scene.meshes.push_back(make_scene_mesh(halves[1], "upper"));
  scene.objects.push_back(scene.objects[0]);
  scene.objects[1].mesh = MeshId(1);
  OneCell one(std::move(scene));
  std::vector<std::array<float, 3>> rims[2];
  for (int k = 0; k < 2; ++k) {
    const CellMesh mesh = one.derive(ObjectId(k));
    EXPECT_LT(mesh.triangles.size(), halves[k].triangles.size() / 3);
    for (const auto& p : sorted_positions(mesh))
      if (std::abs(p[2] - 18) < 1e-4f) rims[k].push_back(p);
  }
  EXPECT_GT(rims[0].size(), 24u);  // of 48; those on the far side may be culled
  EXPECT_EQ(rims[0], rims[1]);
}

}  // namespace
}  // namespace viewcell

#include "visibility/seen_objects.h"

#include <gtest/gtest.h>

#include <set>

#include "base/random.h"
#include "capture/shapes.h"
#include "rays/ray_scene.h"
#include "scene/material_scene.h"

namespace viewcell {
namespace {

void add_box(Scene& scene, const glm::dvec3& lo, const glm::dvec3& hi, int material = 0) {
  scene.meshes.push_back(make_scene_mesh(make_box(lo, hi), "box"));
  SceneObject& object = scene.objects.emplace_back();
  object.mesh = MeshId(scene.meshes.size() - 1);
  object.materials = {material};
}

Scene make_empty() {
  Scene scene;
  scene.area = {{0, 0}, {400, 400}};
  scene.materials = {{}, {.double_sided = true}, {.alpha = AlphaMode::mask, .picture = -1}};
  return scene;
}

std::set<int> find_unseen(const Scene& scene, const glm::dvec2& at, const SeenOptions& o = {}) {
  const CellSet cells = make_cells(scene, 30, {16, 20});
  const SeenFinder finder(scene, cells, o, 1);
  std::set<int> out;
  for (const ObjectId id : finder.find(*cell_at(cells.grid, coord_at(cells.grid, at))).unseen)
    out.insert(static_cast<int>(id));
  return out;
}

// A wall across the area; a box stands behind it.
Scene make_walled(const std::function<void(Scene&)>& build_wall) {
  Scene scene = make_empty();
  add_box(scene, {300, 190, 0}, {320, 210, 30});
  build_wall(scene);
  return scene;
}

TEST(SeenObjects, AWallHidesWhatStandsBehindIt) {
  const Scene scene = make_walled([](Scene& s) { add_box(s, {200, -500, -100}, {204, 900, 300}); });
  EXPECT_EQ(find_unseen(scene, {60, 200}), std::set<int>{0});
  EXPECT_EQ(find_unseen(scene, {370, 200}), std::set<int>{});
  EXPECT_EQ(find_unseen(scene, {370, 60}), std::set<int>{});
}

// Two walls with a slit between them, through which a strip of the box shows.
TEST(SeenObjects, ASlitShowsWhatStandsBehindIt) {
  const Scene scene = make_walled([](Scene& s) {
    add_box(s, {200, -500, -100}, {204, 199, 300});
    add_box(s, {200, 201, -100}, {204, 900, 300});
  });
  EXPECT_EQ(find_unseen(scene, {60, 200}), std::set<int>{});
}

// What is low behind a low wall is hidden to eyes at 16 to 20 when the wall is as high.
TEST(SeenObjects, HeightsCount) {
  for (const double top : {21.0, 5.0}) {
    const Scene scene = make_walled([&](Scene& s) {
      s.objects.clear(), s.meshes.clear();
      add_box(s, {230, 190, 0}, {250, 210, 4});
      add_box(s, {200, -500, -100}, {204, 900, top});
    });
    EXPECT_EQ(find_unseen(scene, {60, 200}).size(), top > 20 ? 1u : 0u) << top;
  }
}

// A sheet that faces away neither hides nor is seen, unless its material has both sides.
TEST(SeenObjects, BacksNeitherHideNorAreSeen) {
  for (const int material : {0, 1})
    for (const bool faces_cell : {true, false}) {
      Scene scene = make_empty();
      add_box(scene, {300, 190, 0}, {320, 210, 30});
      TriMesh sheet;  // across the area, seen from -x
      sheet.positions = {{200, 900, -100}, {200, -500, -100}, {200, -500, 300}, {200, 900, 300}};
      sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
      if (!faces_cell)
        for (Triangle& t : sheet.triangles) std::swap(t[1], t[2]);
      scene.meshes.push_back(make_scene_mesh(sheet, "sheet"));
      SceneObject& object = scene.objects.emplace_back();
      object.mesh = MeshId(1), object.materials = {material};
      const std::set<int> expected{faces_cell || material == 1 ? 0 : 1};
      EXPECT_EQ(find_unseen(scene, {60, 200}), expected) << material << faces_cell;
    }
}

TEST(SeenObjects, MasksHideNothing) {
  const Scene scene = make_walled([](Scene& s) {
    add_box(s, {200, -500, -100}, {204, 900, 300}, 2);
  });
  EXPECT_EQ(find_unseen(scene, {60, 200}), std::set<int>{});
}

// A crowd of boxes: whatever shows in 16 pixels of some picture taken in the cell was found. The
// pictures are ray casts that know nothing of how the finder aims.
TEST(SeenObjects, NothingThatShowsIsMissed) {
  Scene scene = make_empty();
  Random random(11);
  for (int i = 0; i < 160; ++i) {
    const glm::dvec3 at(random.uniform(0, 400), random.uniform(0, 400), 0);
    const glm::dvec3 size(random.uniform(3, 25), random.uniform(3, 25), random.uniform(2, 45));
    if (glm::distance(glm::dvec2(at), {200, 200}) > 50) add_box(scene, at, at + size);
  }
  const CellSet cells = make_cells(scene, 30, {16, 20});
  const CellId cell = *cell_at(cells.grid, coord_at(cells.grid, {200, 200}));
  const SeenFinder finder(scene, cells, {}, 2);
  const SeenFromCell found = finder.find(cell);
  EXPECT_EQ(finder.find(cell).unseen, found.unseen);
  EXPECT_GT(found.unseen.size(), 15u);
  EXPECT_LT(found.unseen.size(), 120u);

  const RayDevice device({1, 0});
  std::vector<RayScene> meshes;
  std::vector<RayScene::Instance> instances;
  for (const SceneMesh& mesh : scene.meshes)
    meshes.emplace_back(device, mesh.mesh.positions, mesh.mesh.triangles);
  for (const RayScene& mesh : meshes) instances.push_back({&mesh, glm::mat4(1)});
  const RayScene all(device, instances);
  std::size_t most_missed = 0;
  for (int k = 0; k < 20; ++k) {
    const glm::vec3 eye(glm::mix(prism_of(cells, cell)[random.below(12)], eye_of(cells, cell),
                                 random.uniform(0.001, 1.0)));
    std::map<std::uint32_t, std::size_t> pixels;  // by object: 5400 x 300 of a panorama
    for (int y = -150; y < 150; ++y)
      for (int x = 0; x < 5400; x += RayPacket::kSize) {
        RayPacket packet;
        RayMask mask;
        packet.start(eye, 0);
        for (int i = 0; i < RayPacket::kSize; ++i) {
          const double angle = (x + i) / 860.0;
          packet.set_direction(i, glm::vec3(std::cos(angle), std::sin(angle), y / 860.0));
          mask.set(i, true);
        }
        all.intersect(mask, packet);
        for (int i = 0; i < RayPacket::kSize; ++i)
          if (packet.has_hit(i)) ++pixels[packet.instance[static_cast<std::size_t>(i)]];
      }
    for (const ObjectId missed : found.unseen)
      most_missed = std::max(most_missed, pixels[static_cast<std::uint32_t>(missed)]);
  }
  EXPECT_LE(most_missed, 16u);
}

}  // namespace
}  // namespace viewcell

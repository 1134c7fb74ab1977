#include "park/models.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/expect_input_error.h"
#include "park/park.h"
#include "park/polygonise.h"
#include "scene/scene_fixture.h"

namespace viewcell {
namespace {

constexpr const char* kNames[] = {"dragon", "bunny",  "statue", "cattle",
                                  "horse",  "easter", "camel",  "venus"};

// A model for every kind: a cube, so that no procedural statue has to be made.
TemporaryFolder& fill(TemporaryFolder& folder) {
  for (const char* name : kNames) folder.add(std::string(name) + ".off", cube_off());
  return folder;
}

Json make_list() {
  Json models = Json::array();
  for (const char* name : kNames)
    models.push_back({{"name", name},
                      {"file", std::string(name) + ".off"},
                      {"up", "z"},
                      {"rotate_z_deg", 0},
                      {"substitutes", ""}});
  return {{"format", "viewcell-models"}, {"version", 1}, {"models", models}};
}

TEST(Models, AreScaledAloneToTheTablesVolumeAndSetOnTheGround) {
  TemporaryFolder folder;
  const ParkMeshes park = make_park_meshes(fill(folder).path());
  ASSERT_EQ(park.meshes.size(), kStatueKinds);
  EXPECT_TRUE(park.notes.empty());
  for (std::size_t k = 0; k < kStatueKinds; ++k) {
    const glm::dvec3 size = statue_kinds()[k].size;
    const double side = std::cbrt(size.x * size.y * size.z);
    const Box box = bounding_box(park.meshes[k].mesh);
    EXPECT_LT(glm::length(box.lo - glm::dvec3(-side / 2, -side / 2, 0)), 1e-4);
    EXPECT_LT(glm::length(box.hi - glm::dvec3(side / 2, side / 2, side)), 1e-4);
    EXPECT_EQ(park.meshes[k].name, statue_kinds()[k].name);
    EXPECT_EQ(park.meshes[k].n_triangles, 12u);
    EXPECT_EQ(park.meshes[k].substitutes, "");
    EXPECT_EQ(park.source_hashes[k], hash_hex(cube_off()));
    EXPECT_EQ(park.meshes[k].mesh.normals.size(), 8u);
  }
}

TEST(Models, UnknownKeysOfTheListAreSaid) {
  TemporaryFolder folder;
  fill(folder);
  Json list = make_list();
  list["models"][0]["rotate_z"] = 90;
  list["models"][1]["source"] = "a shop";  // of scripts/fetch-models
  folder.add("models.json", list.dump());
  const ParkMeshes park = make_park_meshes(folder.path());
  ASSERT_EQ(park.remarks.size(), 1u);
  ASSERT_EQ(park.remarks[0].remarks.size(), 1u);
  EXPECT_EQ(park.remarks[0].remarks[0].what,
            "key 'rotate_z' of a model is unknown and passed over; is 'rotate_z_deg' meant?");
}

TEST(Models, AreTurnedAsTheListSays) {
  TemporaryFolder folder;
  fill(folder);
  // A slab: x 1, y 2, z 3 long.
  TriMesh slab = make_cube();
  for (glm::vec3& p : slab.positions) p *= glm::vec3(1, 2, 3);
  write_ply(folder.path() / "slab.ply", slab);
  Json list = make_list();
  list["models"][0]["file"] = "slab.ply";
  list["models"][0]["up"] = "y";
  list["models"][0]["rotate_z_deg"] = 90;
  list["models"][0]["substitutes"] = "a slab for the dragon";
  folder.add("models.json", format_json(list));
  const ParkMeshes park = make_park_meshes(folder.path());
  // up y: (1, 3, 2); a quarter turn: (3, 1, 2)
  const glm::dvec3 size = bounding_box(park.meshes[0].mesh).size();
  EXPECT_NEAR(size.x / size.y, 3, 1e-5);
  EXPECT_NEAR(size.z / size.y, 2, 1e-5);
  EXPECT_EQ(park.meshes[0].substitutes, "a slab for the dragon");
  ASSERT_EQ(park.notes.size(), 1u);
  EXPECT_NE(park.notes[0].find("a slab for the dragon"), std::string::npos);
}

TEST(Models, LargerOnesAreSimplifiedToTheTablesCount) {
  TemporaryFolder folder;
  fill(folder);
  Figure ball;
  ball.unite(0, {make_ball({0, 0, 5}, 4)});
  const TriMesh mesh = polygonise(ball, {.cell = 0.3});
  ASSERT_GT(mesh.triangles.size(), 1400u);
  std::filesystem::remove(folder.path() / "venus.off");
  write_ply(folder.path() / "venus.ply", mesh);
  EXPECT_EQ(make_park_meshes(folder.path()).meshes[7].n_triangles, 1396u);
}

TEST(Models, BadFoldersAndListsAreRefused) {
  TemporaryFolder folder;
  fill(folder);
  const auto refuse = [&](const std::function<void(Json&)>& spoil, const char* message) {
    Json list = make_list();
    spoil(list);
    folder.add("models.json", format_json(list));
    EXPECT_INPUT_ERROR(make_park_meshes(folder.path()), message);
  };
  refuse([](Json& j) { j["format"] = "models"; }, "\"format\"");
  refuse([](Json& j) { j["models"][2]["name"] = "teapot"; },
         "models[2].name: 'teapot' is not a kind");
  refuse([](Json& j) { j["models"][2]["name"] = "dragon"; }, "'dragon' is there twice");
  refuse([](Json& j) { j["models"][2]["file"] = "../statue.off"; }, "leaves the file's folder");
  refuse([](Json& j) { j["models"][2]["file"] = "gone.off"; }, "gone.off");
  refuse([](Json& j) { j["models"][2]["up"] = "up"; }, "models[2].up");
  refuse([](Json& j) { j["models"][2]["rotate_z_deg"] = 1e9; }, "models[2].rotate_z_deg");
  EXPECT_INPUT_ERROR(make_park_meshes(folder.path() / "none"), "is not a folder of models");
  std::filesystem::remove(folder.path() / "models.json");
  folder.add("statue.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_INPUT_ERROR(make_park_meshes(folder.path()), "the mesh is flat");
}

TEST(Park, WhatIsWrittenIsReadBack) {
  TemporaryFolder models, folder;
  Park park;
  park.scene = make_small_scene();
  park.scene.meshes.pop_back(), park.scene.objects.clear();
  park.scene.materials.pop_back();
  park.scene.meshes[0].mesh = make_cube();
  park.path.samples = {{0, {1, 2, 3}, {1, 0, 0}}, {1, {2, 2, 3}, {1, 0, 0}}};
  write_park(park, folder.path() / "park", {{"tool", "test"}});
  const Scene scene = read_scene(folder.path() / "park/scene.json");
  EXPECT_EQ(scene.meshes[0].mesh.positions, park.scene.meshes[0].mesh.positions);
  EXPECT_EQ(scene.meshes[0].hash, hash_file(folder.path() / "park/meshes/cube.ply"));
  EXPECT_EQ(read_path(folder.path() / "park/path.json").samples.size(), 2u);
}

}  // namespace
}  // namespace viewcell

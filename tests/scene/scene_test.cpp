#include "scene/scene.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "base/random.h"
#include "common/expect_input_error.h"
#include "common/mutate.h"
#include "image/io.h"
#include "scene/pictures.h"
#include "scene/scene_fixture.h"

namespace viewcell {
namespace {

TEST(Scene, WhatWasWrittenIsReadBackBitForBit) {
  SmallSceneFolder small;
  small.json()["materials"][1]["base_color_texture"] = "g.png";
  small.folder().add("g.png", encode_png(ImageRgba8(2, 2, {1, 2, 3, 255})));
  const auto file = small.write();
  const Scene read = read_scene(file);
  EXPECT_EQ(format_json(format_scene(read, {{"tool", "test"}})), read_file(file));
  EXPECT_EQ(read.objects[1].rotation, small.scene().objects[1].rotation);
  EXPECT_EQ(read.objects[1].translation, small.scene().objects[1].translation);
  EXPECT_EQ(read.materials[0].base_color, small.scene().materials[0].base_color);
  EXPECT_EQ(read.materials[1].base_color_texture, "g.png");
  EXPECT_TRUE(read.materials[1].double_sided);
  EXPECT_EQ(read.meshes[1].substitutes, "a tower");
  EXPECT_EQ(read.lighting.toward_light, small.scene().lighting.toward_light);
  EXPECT_EQ(read.ground_z, -0.25);
  ASSERT_EQ(read.remarks.size(), 1u);
  EXPECT_EQ(read.remarks[0].remarks.at(0).what,
            "objects without texture coordinates, drawn without their picture");
}

// All that version 2 has, and no version 2 without it.
TEST(Scene, MaterialsOfVersion2AreReadBack) {
  SmallSceneFolder small;
  EXPECT_EQ(small.json()["version"], 1);
  Scene scene = small.scene();
  Material& leaves = scene.materials[1];
  leaves.base_color_texture = "leaves.png";
  leaves.opacity = 0.75f, leaves.alpha = AlphaMode::mask, leaves.alpha_cutoff = 0.25f;
  leaves.has_vertex_colors = leaves.is_unlit = true;
  leaves.emissive = {1, 2.5f, 0};
  leaves.wrap_u = Wrap::mirror, leaves.wrap_v = Wrap::clamp;
  small.folder().add("leaves.png", encode_png(ImageRgba8(4, 2, {1, 2, 3, 255})));
  for (SceneMesh& mesh : scene.meshes) mesh.hash = hash_file(small.folder().path() / mesh.file);
  small.json() = format_scene(scene, {{"tool", "test"}});
  EXPECT_EQ(small.json()["version"], 2);
  const auto file = small.write();
  Scene read = read_scene(file);
  EXPECT_EQ(format_json(format_scene(read, {{"tool", "test"}})), read_file(file));
  ASSERT_EQ(read.pictures.size(), 1u);
  EXPECT_EQ(read.pictures[0].cutoff, 0.25f);
  EXPECT_EQ(read.materials[1].picture, 0);
  EXPECT_EQ(read.materials[0].picture, -1);
  load_pictures(file, read);
  EXPECT_EQ(read.pictures[0].mips.size(), 3u);
  EXPECT_EQ(read.pictures[0].mips[0].width_px, 4);
}

// Pictures count in the scene's hash, and are those that it was read with.
TEST(Scene, PicturesAreHeldByTheirBytes) {
  SmallSceneFolder small;
  small.json()["materials"][0]["base_color_texture"] = "a.png";
  small.folder().add("a.png", encode_png(ImageRgba8(2, 2, {1, 2, 3, 255})));
  const auto file = small.write();
  const Scene first = read_scene(file);
  EXPECT_EQ(read_scene(file, {.with_meshes = false}).hash, first.hash);
  small.folder().add("a.png", encode_png(ImageRgba8(2, 2, {9, 2, 3, 255})));
  EXPECT_NE(read_scene(file).hash, first.hash);
  Scene stale = first;
  EXPECT_INPUT_ERROR(load_pictures(file, stale), "picture changed");
  small.folder().add("a.png", "no picture");
  Scene bad = read_scene(file);
  EXPECT_INPUT_ERROR(load_pictures(file, bad), "a.png");
}

// Two materials of one mesh, each with its triangles.
TEST(Scene, MeshesOfSeveralMaterialsGiveEachItsOwn) {
  SmallSceneFolder small;
  small.folder().add("two.obj",
                     "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\n"
                     "usemtl b\nf 1 2 3\nusemtl a\nf 1 3 4\nusemtl b\nf 2 5 3\n");
  small.json()["meshes"][0] = {{"name", "two"}, {"file", "two.obj"}, {"up", "z"}, {"scale", 1}};
  small.json()["objects"][0].erase("material");
  small.json()["objects"][0]["materials"] = {1, 0};
  small.json()["version"] = 2;
  const Scene scene = read_scene(small.write());
  const SceneMesh& two = scene.meshes[0];
  EXPECT_EQ(two.n_slots, 2u);
  ASSERT_EQ(two.mesh.triangles.size(), 3u);
  const int slots[] = {0, 1, 0};
  for (std::size_t t = 0; t < 3; ++t)
    for (const std::uint32_t v : two.mesh.triangles[t]) EXPECT_EQ(two.looks.slots[v], slots[t]);
  EXPECT_EQ(scene.material_of(scene.objects[0], 0).name, "glass");
  EXPECT_EQ(scene.material_of(scene.objects[0], 1).name, "stone");
  EXPECT_TRUE(scene.is_double_sided(scene.objects[0]));
}

TEST(Scene, MeshesComeUprightScaledAndWithNormals) {
  SmallSceneFolder small;
  const Scene scene = read_scene(small.write());
  // The OFF cube [0, 1]^3 has y up and scale 2.5: (x, y, z) -> 2.5 (x, -z, y).
  const Box box = bounding_box(scene.meshes[1].mesh);
  EXPECT_EQ(box.lo, glm::dvec3(0, -2.5, 0));
  EXPECT_EQ(box.hi, glm::dvec3(2.5, 0, 2.5));
  for (const SceneMesh& mesh : scene.meshes) {
    ASSERT_EQ(mesh.mesh.normals.size(), mesh.mesh.positions.size());
    for (std::size_t v = 0; v < mesh.mesh.normals.size(); ++v) {
      EXPECT_NEAR(glm::length(mesh.mesh.normals[v]), 1, 1e-6);
      const Box own = bounding_box(mesh.mesh);  // a cube's corners look away from its middle
      EXPECT_GT(glm::dot(glm::dvec3(mesh.mesh.normals[v]),
                         glm::dvec3(mesh.mesh.positions[v]) - own.centre()),
                0);
    }
  }
}

TEST(Scene, TurningUpAxesIsARotation) {
  const glm::vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  for (const std::string up : {"x", "y", "z", "-x", "-y", "-z"}) {
    const glm::vec3 a = turn_up_axis(up, x), b = turn_up_axis(up, y), c = turn_up_axis(up, z);
    EXPECT_EQ(glm::cross(a, b), c) << up;
    const glm::vec3 axis = up.back() == 'x' ? x : up.back() == 'y' ? y : z;
    EXPECT_EQ(turn_up_axis(up, up.size() == 2 ? -axis : axis), z) << up;
    EXPECT_TRUE(is_up_axis(up));
  }
}

// The cube [0, 1]^3 with y up and scale 2.5, wherever its file has it.
TEST(Scene, PlacedOnTheGround) {
  SmallSceneFolder small;
  for (const char* up : {"y", "-y", "z", "-x"}) {
    SCOPED_TRACE(up);
    small.json()["meshes"][1]["up"] = up;
    small.json()["meshes"][1]["place"] = "ground";
    const Scene scene = read_scene(small.write());
    const Box box = bounding_box(scene.meshes[1].mesh);
    EXPECT_EQ(box.lo, glm::dvec3(-1.25, -1.25, 0));
    EXPECT_EQ(box.hi, glm::dvec3(1.25, 1.25, 2.5));
    EXPECT_EQ(format_scene(scene, {})["meshes"][1]["place"], "ground");
    EXPECT_FALSE(format_scene(scene, {})["meshes"][0].contains("place"));
  }
}

// Every triangle on its own, corners of one place a little apart: a scan as some tools write it.
TEST(Scene, CracksClose) {
  SmallSceneFolder small;
  const TriMesh cube = make_cube();
  Random random(1);
  TriMesh soup;
  for (const Triangle& t : cube.triangles) {
    const auto n = static_cast<std::uint32_t>(soup.positions.size());
    soup.triangles.push_back({n, n + 1, n + 2});
    for (const std::uint32_t v : t) {
      const auto off = [&] { return static_cast<float>(random.uniform(-1e-6, 1e-6)); };
      soup.positions.push_back(cube.positions[v] + glm::vec3(off(), off(), off()));
    }
  }
  write_mesh(small.folder() / "soup.ply", MeshFormat::ply, soup);
  Json& mesh = small.json()["meshes"][0];
  mesh["file"] = "soup.ply";
  mesh.erase("hash");
  const Scene scene = read_scene(small.write());
  std::set<std::uint32_t> places;
  const SceneMesh& read = scene.meshes[0];
  for (std::uint32_t v = 0; v < read.mesh.positions.size(); ++v) {
    places.insert(read.weld.of(v));
    EXPECT_EQ(read.mesh.positions[v], read.mesh.positions[read.weld.of(v)]);
  }
  EXPECT_EQ(places.size(), 8u);
  ASSERT_EQ(scene.remarks.size(), 1u);
  EXPECT_NE(scene.remarks[0].remarks.at(0).what.find("so that cracks close"), std::string::npos);
  EXPECT_EQ(scene.remarks[0].remarks.at(0).count, 28u);
}

TEST(Scene, WithoutMeshesOnlyTheJsonIsRead) {
  SmallSceneFolder small;
  const auto file = small.write();
  const Scene whole = read_scene(file);
  std::filesystem::remove(small.folder().path() / "tall.off");
  const Scene scene = read_scene(file, {.with_meshes = false});
  EXPECT_TRUE(scene.meshes[0].mesh.positions.empty());
  EXPECT_EQ(count_triangles(scene), 36u);
  EXPECT_EQ(scene.hash, whole.hash);
  EXPECT_EQ(format_scene(scene, {{"tool", "test"}}), format_scene(whole, {{"tool", "test"}}));
}

TEST(Scene, AHandWrittenSceneMayLeaveHashAndCountOut) {
  SmallSceneFolder small;
  for (Json& mesh : small.json()["meshes"]) mesh.erase("hash"), mesh.erase("triangles");
  const auto file = small.write();
  for (const bool with_meshes : {true, false}) {
    const Scene scene = read_scene(file, {.with_meshes = with_meshes});
    EXPECT_EQ(scene.meshes[1].n_triangles, 12u);
    EXPECT_EQ(scene.meshes[1].hash, small.scene().meshes[1].hash);
    EXPECT_EQ(scene.meshes[1].mesh.positions.empty(), !with_meshes);
  }
}

TEST(Scene, HashChangesWithTheSceneAndWithTheMeshes) {
  SmallSceneFolder small;
  const std::string hash = read_scene(small.write()).hash;
  EXPECT_EQ(read_scene(small.write(), {.n_threads = 1}).hash, hash);
  small.json()["objects"][0]["translation"][2] = 1;
  const std::string moved = read_scene(small.write()).hash;
  EXPECT_NE(moved, hash);
  for (Json& mesh : small.json()["meshes"]) mesh.erase("hash");
  const std::string before = read_scene(small.write()).hash;
  small.folder().add("tall.off", "# other bytes\n" + cube_off());
  EXPECT_NE(read_scene(small.write()).hash, before);
}

TEST(Scene, WorldBoxIsTightAroundARotatedObject) {
  SmallSceneFolder small;
  const Scene scene = read_scene(small.write());
  const SceneObject& object = scene.objects[1];
  Box expected;
  for (const glm::vec3& p : scene.mesh_of(object).mesh.positions) {
    const glm::dvec4 q = object.matrix_world_from_model() * glm::dvec4(glm::dvec3(p), 1);
    expected.add(glm::dvec3(q));
  }
  const Box box = world_box(scene, object);
  EXPECT_LT(glm::length(box.lo - expected.lo) + glm::length(box.hi - expected.hi), 1e-12);
  const glm::dvec3 p(0.3, -7, 11);
  EXPECT_LT(glm::length(object.model_from_world(object.world_from_model(p)) - p), 1e-12);
}

TEST(Scene, AnEmptySceneIsAScene) {
  SmallSceneFolder small;
  for (const char* key : {"objects", "meshes", "materials"}) small.json()[key] = Json::array();
  const Scene scene = read_scene(small.write());
  EXPECT_EQ(count_triangles(scene), 0u);
}

TEST(Scene, ARoundedQuaternionIsNormalised) {
  SmallSceneFolder small;
  small.json()["objects"][0]["rotation"] = {0, 0, 0.7072, 0.7071};
  const glm::dquat q = read_scene(small.write()).objects[0].rotation;
  EXPECT_NEAR(glm::length(q), 1, 1e-15);
}

// What is wrong, and what the one line of error must say.
struct Spoiling {
  const char* place;
  const char* message;
  std::function<void(Json&)> spoil;
};

TEST(Scene, BadScenesAreRefusedWithThePlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Spoiling> spoilings{
      {"", "\"format\" is not", [](Json& j) { j["format"] = "viewcell-cells"; }},
      {"version", "version 3", [](Json& j) { j["version"] = 3; }},
      {"", "has no \"objects\"", [](Json& j) { j.erase("objects"); }},
      {"objects", "is not an array", [](Json& j) { j["objects"] = 3; }},
      {"objects[1].mesh", "2 is out of range", [](Json& j) { j["objects"][1]["mesh"] = 2; }},
      {"objects[1].mesh", "-1 is out of range", [](Json& j) { j["objects"][1]["mesh"] = -1; }},
      {"objects[1].mesh", "not a whole number", [](Json& j) { j["objects"][1]["mesh"] = 0.5; }},
      {"objects[0].material", "7 is out of range",
       [](Json& j) { j["objects"][0]["material"] = 7; }},
      {"objects[2].rotation", "unit quaternion",
       [](Json& j) {
         j["objects"][2]["rotation"] = {0, 0, 0, 1.01};
       }},
      {"objects[2].rotation", "unit quaternion",
       [](Json& j) {
         j["objects"][2]["rotation"] = {0, 0, 0, 0};
       }},
      {"objects[2].rotation", "3 numbers",
       [](Json& j) {
         j["objects"][2]["rotation"] = {0, 0, 1};
       }},
      {"objects[2].scale", "is not within", [](Json& j) { j["objects"][2]["scale"] = 0; }},
      {"objects[2].scale", "is not within", [](Json& j) { j["objects"][2]["scale"] = -1; }},
      {"objects[0].translation[1]", "is not a number",
       [&](Json& j) { j["objects"][0]["translation"][1] = nan; }},
      {"objects[0].translation[1]", "is not within",
       [](Json& j) { j["objects"][0]["translation"][1] = 1e8; }},
      {"meshes[0].scale", "is not within", [](Json& j) { j["meshes"][0]["scale"] = 0; }},
      {"meshes[0].up", "is not x, y or z", [](Json& j) { j["meshes"][0]["up"] = "w"; }},
      {"meshes[0].up", "is not x, y or z", [](Json& j) { j["meshes"][0]["up"] = "-w"; }},
      {"meshes[0].place", "is not file, centre or ground",
       [](Json& j) { j["meshes"][0]["place"] = "sky"; }},
      {"meshes[0].file", "leaves the file's folder",
       [](Json& j) { j["meshes"][0]["file"] = "meshes/../../cube.ply"; }},
      {"meshes[0].file", "is absolute", [](Json& j) { j["meshes"][0]["file"] = "/etc/passwd"; }},
      {"meshes[0].file", "is empty", [](Json& j) { j["meshes"][0]["file"] = ""; }},
      {"meshes[0].triangles", "is not within", [](Json& j) { j["meshes"][0]["triangles"] = 0; }},
      {"meshes[1].triangles", "13, but 'tall.off' has 12",
       [](Json& j) { j["meshes"][1]["triangles"] = 13; }},
      {"tall.off", "mesh file changed since the scene was written",
       [](Json& j) { j["meshes"][1]["hash"] = "0123456789abcdef"; }},
      {"gone.ply", "cannot open", [](Json& j) { j["meshes"][1]["file"] = "gone.ply"; }},
      {"materials[1].base_color_texture", "leaves the file's folder",
       [](Json& j) { j["materials"][1]["base_color_texture"] = "../g.png"; }},
      {"g.png", "cannot open", [](Json& j) { j["materials"][1]["base_color_texture"] = "g.png"; }},
      {"materials[0].alpha", "'glass' is not opaque or mask",
       [](Json& j) { j["materials"][0]["alpha"] = "glass"; }},
      {"materials[0].alpha_cutoff", "is not within",
       [](Json& j) { j["materials"][0]["alpha_cutoff"] = 2; }},
      {"materials[0].wrap[1]", "'tile' is not repeat, clamp or mirror",
       [](Json& j) {
         j["materials"][0]["wrap"] = {"repeat", "tile"};
       }},
      {"materials[0].wrap", "is not two words",
       [](Json& j) { j["materials"][0]["wrap"] = {"clamp"}; }},
      {"materials[0].emissive[0]", "is not within",
       [](Json& j) {
         j["materials"][0]["emissive"] = {-1, 0, 0};
       }},
      {"materials[0].opacity", "is not within",
       [](Json& j) { j["materials"][0]["opacity"] = 1.5; }},
      {"objects[0]", "has both", [](Json& j) { j["objects"][0]["materials"] = {0}; }},
      {"objects[0].materials", "2, but 'meshes/cube.ply' has 1",
       [](Json& j) {
         j["objects"][0].erase("material");
         j["objects"][0]["materials"] = {0, 1};
       }},
      {"objects[0].materials[0]", "9 is out of range",
       [](Json& j) {
         j["objects"][0].erase("material");
         j["objects"][0]["materials"] = {9};
       }},
      {"objects[0].materials", "is empty",
       [](Json& j) {
         j["objects"][0].erase("material");
         j["objects"][0]["materials"] = Json::array();
       }},
      {"materials[0].base_color[2]", "is not within",
       [](Json& j) { j["materials"][0]["base_color"][2] = 1.5; }},
      {"materials[0].double_sided", "is not true or false",
       [](Json& j) { j["materials"][0]["double_sided"] = 1; }},
      {"area", "lo is not below hi", [](Json& j) { j["area"]["hi"][0] = -10; }},
      {"light.toward_light", "is not a unit vector",
       [](Json& j) {
         j["light"]["toward_light"] = {0, 0, 2};
       }},
      {"light.color[0]", "is not within", [](Json& j) { j["light"]["color"][0] = -1; }},
  };
  for (const Spoiling& s : spoilings) {
    SCOPED_TRACE(std::string(s.place) + ": " + s.message);
    SmallSceneFolder small;
    s.spoil(small.json());
    const auto file = small.write();
    EXPECT_INPUT_ERROR(read_scene(file), s.message);
    EXPECT_INPUT_ERROR(read_scene(file), s.place);
  }
}

TEST(Scene, BadMeshFilesAreRefused) {
  SmallSceneFolder small;
  for (Json& mesh : small.json()["meshes"]) mesh.erase("hash");
  const auto file = small.write();
  small.folder().add("tall.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n");
  EXPECT_INPUT_ERROR(read_scene(file), "tall.off");
  small.folder().add("tall.off", "OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n");
  EXPECT_INPUT_ERROR(read_scene(file), "tall.off");
  small.folder().add("tall.off", "");
  EXPECT_INPUT_ERROR(read_scene(file), "tall.off");
}

// ---- meshes far from the origin of their files ----

// A cube of side 4, its middle at (500002, 4649778.25, 212).
std::string far_cube() {
  std::string out = "OFF\n8 6 0\n";
  for (const glm::vec3& p : cube_positions())
    out += std::to_string(500000 + 4.0 * p.x) + " " + std::to_string(4649776.25 + 4.0 * p.y) + " " +
           std::to_string(210 + 4.0 * p.z) + "\n";
  return out + cube_off().substr(cube_off().find("4 3 2 1 0"));
}

struct FarScene : SmallSceneFolder {
  FarScene() {
    folder().add("tall.off", far_cube());
    Json& mesh = json()["meshes"][1];
    mesh.erase("hash");
    mesh["up"] = "z";
    mesh["scale"] = 0.5;
    json()["objects"][1]["rotation"] = {0, 0, 0, 1};
    json()["objects"][1]["translation"] = {0, 0, 0};
  }
};

TEST(FarScene, IsRefusedWhereFloatsAreTooCoarse) {
  FarScene far;
  EXPECT_INPUT_ERROR(read_scene(far.write()), "objects[1].translation: takes 'tall' to where");
  EXPECT_INPUT_ERROR(read_scene(far.write()), "\"place\": \"centre\"");
  far.json()["meshes"][1]["place"] = "middle";
  EXPECT_INPUT_ERROR(read_scene(far.write()),
                     "meshes[1].place: 'middle' is not file, centre or ground");
}

TEST(FarScene, IsBroughtNearByItsTranslation) {
  FarScene far;
  far.json()["objects"][1]["translation"] = {-250000, -2324888, -105};
  const Scene scene = read_scene(far.write());
  const Box box = world_box(scene, scene.objects[1]);
  EXPECT_LT(glm::distance(box.lo, glm::dvec3(0, 0.125, 0)), 1e-6);
  EXPECT_LT(glm::distance(box.hi, glm::dvec3(2, 2.125, 2)), 1e-6);
  const glm::dvec3 p(1, 2, 3);
  const SceneObject& object = scene.objects[1];
  EXPECT_LT(glm::distance(object.model_from_world(object.world_from_model(p)), p), 1e-9);
  EXPECT_LT(glm::distance(glm::dvec3(object.matrix_world_from_model() * glm::dvec4(p, 1)),
                          object.world_from_model(p)),
            1e-9);
  EXPECT_EQ(object.translation, glm::dvec3(-250000, -2324888, -105));  // as the file has it
}

TEST(FarScene, IsBroughtNearByItsOrigin) {
  FarScene far;
  far.json()["meshes"][1]["place"] = "centre";
  far.json()["objects"][1]["translation"] = {10, 20, 30};
  const Scene scene = read_scene(far.write());
  const Box box = world_box(scene, scene.objects[1]);
  EXPECT_LT(glm::distance(box.lo, glm::dvec3(9, 19, 29)), 1e-6);
  EXPECT_LT(glm::distance(box.hi, glm::dvec3(11, 21, 31)), 1e-6);
  EXPECT_EQ(format_scene(scene, {{"tool", "test"}})["meshes"][1]["place"], "centre");
  EXPECT_FALSE(format_scene(scene, {{"tool", "test"}})["meshes"][0].contains("place"));
}

TEST(Scene, ALinkOutOfTheFolderIsRefused) {
  SmallSceneFolder small;
  TemporaryFolder elsewhere;
  elsewhere.add("secret.off", cube_off());
  std::filesystem::create_symlink(elsewhere.path(), small.folder().path() / "link");
  small.json()["meshes"][1]["file"] = "link/secret.off";
  EXPECT_INPUT_ERROR(read_scene(small.write()), "leaves the file's folder");
}

TEST(Scene, HashesAreOfTheBytesThatWereParsed) {
  SmallSceneFolder small;
  const std::filesystem::path file = small.write();
  const Scene scene = read_scene(file);
  EXPECT_EQ(scene.file_hash, hash_file(file));
  for (const SceneMesh& mesh : scene.meshes)
    EXPECT_EQ(mesh.hash, hash_file(small.folder().path() / mesh.file));
  EXPECT_TRUE(scene.remarks.empty());  // what we write holds nothing unknown
}

// Misspelt keys are no errors, but said: once each, with what was meant.
TEST(Scene, UnknownKeysAreSaid) {
  SmallSceneFolder small;
  for (Json& mesh : small.json()["meshes"]) {
    mesh["substitues"] = mesh["substitutes"];
    mesh.erase("substitutes");
  }
  small.json()["light"]["colour"] = {1, 1, 1};
  small.json()["author"] = "me";
  const Scene scene = read_scene(small.write());
  EXPECT_EQ(scene.meshes[1].substitutes, "");
  ASSERT_EQ(scene.remarks.size(), 1u);
  EXPECT_EQ(scene.remarks[0].file.filename(), "scene.json");
  const Remarks& remarks = scene.remarks[0].remarks;
  ASSERT_EQ(remarks.size(), 3u);
  EXPECT_EQ(remarks[0].what, "key 'author' of the scene is unknown and passed over");
  EXPECT_EQ(remarks[1].what, "key 'colour' of light is unknown and passed over; is 'color' meant?");
  EXPECT_EQ(remarks[2].what,
            "key 'substitues' of a mesh is unknown and passed over; is 'substitutes' meant?");
  EXPECT_EQ(remarks[2].count, 2u);
  // One that is needed is an error, which says what stands there instead.
  small.json()["objects"][1]["rotaton"] = small.json()["objects"][1]["rotation"];
  small.json()["objects"][1].erase("rotation");
  EXPECT_INPUT_ERROR(read_scene(small.write()),
                     "objects[1]: has no \"rotation\"; is 'rotaton' it?");
}

TEST(Scene, DeepAndTruncatedJsonIsRefused) {
  SmallSceneFolder small;
  const std::string text = read_file(small.write());
  const auto& folder = small.folder();
  EXPECT_INPUT_ERROR(read_scene(folder.add("deep.json", std::string(200000, '['))),
                     "nested deeper");
  EXPECT_INPUT_ERROR(read_scene(folder.add("cut.json", text.substr(0, text.size() / 2))),
                     "not valid JSON");
  EXPECT_INPUT_ERROR(read_scene(folder.add("empty.json", "")), "empty.json");
  EXPECT_INPUT_ERROR(read_scene(folder.path() / "missing.json"), "missing.json");
}

TEST(Scene, DamagedCopiesAreReadOrRefused) {
  SmallSceneFolder small;
  const std::string text = read_file(small.write());
  read_damaged_copies(text, 1500, 42, [&](const std::string& bytes) {
    read_scene(small.folder().add("damaged.json", bytes), {.n_threads = 1});
  });
}

}  // namespace
}  // namespace viewcell

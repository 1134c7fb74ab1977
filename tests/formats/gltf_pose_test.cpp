// Where vertices are: instances, morph targets at their weights, skins as their joints rest.
#include <gtest/gtest.h>

#include <cmath>

#include "common/expect_input_error.h"
#include "gltf_builder.h"
#include "mesh/offset.h"

namespace viewcell {
namespace {

void expect_at(const TriMesh& mesh, std::size_t v, const glm::vec3& p) {
  ASSERT_LT(v, mesh.positions.size());
  const glm::dvec3 at = place_of(mesh, v);
  EXPECT_NEAR(glm::distance(at, glm::dvec3(p)), 0, 1e-5)
      << v << ": " << at.x << " " << at.y << " " << at.z;
}

double area_z(const TriMesh& mesh, std::size_t t) {
  return area_normal(mesh, mesh.triangles[t]).z;
}

GltfBuilder instanced(const std::string& name, std::size_t accessor, GltfBuilder file) {
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"][name] = accessor;
  return file;
}

// world = node * translation * rotation * scale.
TEST(GltfInstances, AreAllShown) {
  GltfBuilder file = one_triangle();
  const auto t = file.add<float>({0, 0, 0, 3, 0, 0}, "VEC3");
  const auto s = file.add<float>({1, 1, 1, 2, 2, -2}, "VEC3");
  // Bytes: 127 is 1. The second turns by half a turn around z.
  const auto r = file.add<std::int8_t>({0, 0, 0, 127, 0, 0, 127, 0}, "VEC4", true);
  file = instanced("TRANSLATION", t, file);
  file = instanced("SCALE", s, file);
  file = instanced("ROTATION", r, file);
  file.json["nodes"][0]["translation"] = {0, 0, 10};
  file.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  Remarks remarks;
  const TriMesh mesh = file.read(&remarks);
  EXPECT_TRUE(remarks.empty());
  ASSERT_EQ(mesh.triangles.size(), 2u);
  expect_at(mesh, 1, {1, 0, 10});
  expect_at(mesh, 3, {3, 0, 10});
  expect_at(mesh, 4, {1, 0, 10});
  expect_at(mesh, 5, {3, -2, 10});
  EXPECT_GT(area_z(mesh, 0), 0);
  EXPECT_LT(area_z(mesh, 1), 0);  // mirrored along z: its front now looks down
}

TEST(GltfInstances, AnyAttributeCounts) {
  GltfBuilder file = one_triangle();
  const auto s = file.add<float>({1, 1, 1, 2, 2, 2, 3, 3, 3}, "VEC3");
  EXPECT_EQ(instanced("SCALE", s, file).read().triangles.size(), 3u);
  EXPECT_EQ(instanced("_ID", s, file).read().triangles.size(), 3u);
  const auto t = file.add<float>({0, 0, 0, 3, 0, 0}, "VEC3");
  EXPECT_INPUT_ERROR(instanced("TRANSLATION", t, instanced("SCALE", s, file)).read(),
                     "differs in length");
  EXPECT_INPUT_ERROR(instanced("TRANSLATION", 99, file).read(), "has no element 99");
}

// Two targets: one moves all by 10 along z, the other the last vertex by 1 along x.
GltfBuilder morphed() {
  GltfBuilder file = one_triangle();
  const auto lift = file.add<float>({0, 0, 10, 0, 0, 10, 0, 0, 10}, "VEC3");
  const auto push = file.add<std::int8_t>({0, 0, 0, 0, 0, 0, 2, 0, 0}, "VEC3");
  file.primitive()["targets"] = Json::array({{{"POSITION", lift}}, {{"POSITION", push}}});
  return file;
}

TEST(GltfMorphTargets, StandAtTheirWeights) {
  GltfBuilder file = morphed();
  expect_at(file.read(), 2, {0, 1, 0});  // without weights none counts
  file.json["meshes"][0]["weights"] = {0.5, 1};
  expect_at(file.read(), 0, {0, 0, 5});
  expect_at(file.read(), 2, {2, 1, 5});
  file.json["nodes"][0]["weights"] = {0, -1};  // the node's come first
  expect_at(file.read(), 0, {0, 0, 0});
  expect_at(file.read(), 2, {-2, 1, 0});
  // Two nodes of one mesh, each as it says.
  file.json["nodes"].push_back(Json::parse(R"({"mesh": 0, "translation": [0, 0, 100]})"));
  const TriMesh both = file.read();
  expect_at(both, 2, {-2, 1, 0});
  expect_at(both, 5, {2, 1, 105});
  file.json["nodes"][0]["weights"] = {1};
  EXPECT_INPUT_ERROR(file.read(), "targets: are 2, but there are 1 weights");
}

TEST(GltfMorphTargets, MoveWhatElseVerticesHave) {
  GltfBuilder file = one_triangle();
  file.attributes()["NORMAL"] = file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  file.attributes()["TEXCOORD_0"] = file.add<float>({0, 0, 1, 0, 0, 1}, "VEC2");
  file.attributes()["COLOR_0"] = file.add<float>({0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3");
  const auto normals = file.add<float>({0, 1, -1, 0, 0, 0, 0, 0, 0}, "VEC3");
  const auto texcoords = file.add<float>({0.5, 0, 0, 0, 0, 0}, "VEC2");
  const auto colors = file.add<float>({0.25, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3");
  file.primitive()["targets"][0] = {
      {"NORMAL", normals}, {"TEXCOORD_0", texcoords}, {"COLOR_0", colors}};
  file.json["meshes"][0]["weights"] = {1};
  const TriMesh mesh = file.read();
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, 1, 0));
  EXPECT_EQ(mesh.normals[1], glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.texcoords[0], glm::vec2(0.5, 1));
  EXPECT_EQ(mesh.colors[0], glm::vec3(0.25, 0, 0));
  file.primitive()["targets"][0]["NORMAL"] = file.add<float>({0, 1, -1}, "VEC3");
  EXPECT_INPUT_ERROR(file.read(), "targets[0]: NORMAL and the primitive's POSITION differ");
}

// Joints 1 and 2 stand at (0, 0, 5), the second turned by a quarter around z; both were bound where
// their matrices say. The mesh's own node is far away, which does not matter.
GltfBuilder skinned() {
  GltfBuilder file = one_triangle();
  file.json["nodes"] = Json::parse(R"([
    {"mesh": 0, "skin": 0, "translation": [100, 0, 0], "children": []},
    {"translation": [0, 0, 5], "children": [2]},
    {"rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]}])");
  file.json["skins"] = Json::parse(R"([{"joints": [1, 2]}])");
  file.attributes()["JOINTS_0"] =
      file.add<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
  file.attributes()["WEIGHTS_0"] =
      file.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0}, "VEC4");
  return file;
}

TEST(GltfSkins, StandAsTheirJointsRest) {
  GltfBuilder file = skinned();
  const TriMesh mesh = file.read();
  expect_at(mesh, 0, {0, 0, 5});       // with the first joint
  expect_at(mesh, 1, {0, 1, 5});       // turned
  expect_at(mesh, 2, {-0.5, 0.5, 5});  // between (0, 1) and (-1, 0)
  file.json["skins"][0]["inverseBindMatrices"] =
      file.add<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, -5, 1,
                       1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0,  1},
                      "MAT4");
  const TriMesh bound = file.read();
  expect_at(bound, 0, {0, 0, 0});
  expect_at(bound, 1, {0, 0, 5});  // (1, 0, 0) - (1, 0, 0), then up
}

TEST(GltfSkins, WeightsOfAnyKind) {
  GltfBuilder file = skinned();
  // Bytes that add up to 200: shares of their sum.
  file.attributes()["WEIGHTS_0"] =
      file.add<std::uint8_t>({200, 0, 0, 0, 200, 0, 0, 0, 100, 100, 0, 0}, "VEC4", true);
  expect_at(file.read(), 2, {-0.5, 0.5, 5});
  // A second set of four.
  file.attributes()["WEIGHTS_0"] =
      file.add<std::uint16_t>({65535, 0, 0, 0, 65535, 0, 0, 0, 0, 0, 0, 0}, "VEC4", true);
  file.attributes()["JOINTS_1"] =
      file.add<std::uint16_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0}, "VEC4");
  file.attributes()["WEIGHTS_1"] =
      file.add<std::uint16_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 65535, 0}, "VEC4", true);
  expect_at(file.read(), 2, {-1, 0, 5});
  file.attributes().erase("WEIGHTS_1");
  EXPECT_INPUT_ERROR(file.read(), "has no WEIGHTS_1");
  file.attributes().erase("JOINTS_1");
  Remarks remarks;
  expect_at(file.read(&remarks), 2, {0, 1, 5});
  EXPECT_EQ(count_said(remarks, "vertices without weights"), 1u);
}

TEST(GltfSkins, NormalsAndSidesFollow) {
  GltfBuilder file = skinned();
  file.attributes()["NORMAL"] = file.add<float>({1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3");
  EXPECT_NEAR(glm::distance(file.read().normals[1], glm::vec3(0, 1, 0)), 0, 1e-6);
  EXPECT_EQ(file.read().normals[0], glm::vec3(1, 0, 0));
  file.json["nodes"][1]["scale"] = {1, 1, -1};
  EXPECT_LT(area_z(file.read(), 0), 0);
}

TEST(GltfSkins, WrongOnes) {
  const auto bad = [](const auto& change, const std::string& part) {
    GltfBuilder file = skinned();
    change(file);
    EXPECT_INPUT_ERROR(file.read(), part);
  };
  bad([](GltfBuilder& f) { f.json["skins"][0]["joints"] = {1}; },
      "is bound to joint 1; there are 1");
  bad([](GltfBuilder& f) { f.json["skins"][0]["joints"] = {1, 9}; }, "joints[1]: no such node");
  bad([](GltfBuilder& f) { f.json["nodes"][0]["skin"] = 3; }, "skins: has no element 3");
  bad([](GltfBuilder& f) { f.json["skins"][0]["inverseBindMatrices"] = 0; },
      "expected 16 components");
  bad([](GltfBuilder& f) { f.json["nodes"][2]["children"] = {1}; }, "hangs on itself");
  bad([](GltfBuilder& f) { f.attributes()["JOINTS_0"] = f.attributes()["WEIGHTS_0"]; },
      "expected unsigned whole numbers");
  GltfBuilder file = skinned();
  file.attributes().erase("JOINTS_0");
  Remarks remarks;
  expect_at(file.read(&remarks), 0, {100, 0, 0});
  EXPECT_EQ(count_said(remarks, "with a skin and without joints"), 1u);
}

// What a file has beside a mesh at rest is said once, with its number.
TEST(GltfScene, WhatIsLeftOutIsSaid) {
  GltfBuilder file = one_triangle();
  file.json["animations"] = Json::parse(R"([{}, {}])");
  Json points = file.primitive();
  for (const int mode : {0, 1, 3}) {
    points["mode"] = mode;
    file.json["meshes"][0]["primitives"].push_back(points);
  }
  file.json["nodes"] = Json::parse(R"([{"mesh": 0}, {"mesh": 0},
    {"extensions": {"KHR_node_visibility": {"visible": false}}, "children": [3]}, {"mesh": 0}])");
  file.json["scenes"] = Json::parse(R"([{"nodes": [1]}, {"nodes": [0, 1, 2]}])");
  file.json["scene"] = 1;
  Remarks remarks;
  EXPECT_EQ(file.read(&remarks).triangles.size(), 2u);
  EXPECT_EQ(count_said(remarks, "animations, not played"), 2u);
  EXPECT_EQ(count_said(remarks, "points or lines, left out"), 3u);
  EXPECT_EQ(count_said(remarks, "scenes beside the default one"), 1u);
  EXPECT_EQ(count_said(remarks, "not visible"), 1u);
}

// In a strip, triangles with a corner twice lead from one part to the next.
TEST(GltfScene, StripsHaveConnections) {
  GltfBuilder file = indexed_cube();
  file.primitive()["mode"] = 5;
  file.primitive()["indices"] = file.add<std::uint8_t>({3, 2, 0, 1, 1, 4, 4, 5, 7, 6}, "SCALAR");
  EXPECT_EQ(file.read().triangles,
            (std::vector<Triangle>{{3, 2, 0}, {2, 1, 0}, {4, 5, 7}, {5, 6, 7}}));
}

}  // namespace
}  // namespace viewcell

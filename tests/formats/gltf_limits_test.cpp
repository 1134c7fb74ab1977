// A few bytes place one mesh many times: what that comes to is counted before it is made.
#include <gtest/gtest.h>

#include "common/expect_input_error.h"
#include "gltf_builder.h"

namespace viewcell {
namespace {

// n nodes that show the mesh.
GltfBuilder with_nodes(GltfBuilder file, std::size_t n) {
  for (std::size_t i = 1; i < n; ++i) file.json["nodes"].push_back({{"mesh", 0}});
  return file;
}

TEST(GltfLimits, NodesAndInstancesAreCounted) {
  const GltfBuilder file = with_nodes(indexed_cube(), 5);
  EXPECT_EQ(file.read(nullptr, {.max_triangles = 60}).triangles.size(), 60u);
  EXPECT_INPUT_ERROR(file.read(nullptr, {.max_triangles = 59}),
                     "m.glb: would be 60 triangles; at most 59 are read (--max-triangles N)");
  GltfBuilder many = indexed_cube();
  const auto t = many.add(std::vector<float>(3 * 7, 1.0f), "VEC3");
  many.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = t;
  EXPECT_EQ(many.read(nullptr, {.max_triangles = 84}).triangles.size(), 84u);
  EXPECT_INPUT_ERROR(many.read(nullptr, {.max_triangles = 83}), "would be 84 triangles");
}

// 4,000 nodes of 30,000 triangles each, of one vertex list; none of them is made.
TEST(GltfLimits, ASmallFileMayNotBecomeALargeMesh) {
  GltfBuilder file = with_nodes(one_triangle(), 4000);
  const Json primitive = file.primitive();
  for (int i = 1; i < 30000; ++i) file.json["meshes"][0]["primitives"].push_back(primitive);
  EXPECT_INPUT_ERROR(file.read(), "would be 120000000 triangles; at most 16777216 are read");
}

TEST(GltfLimits, InstancesThatOverflowNothing) {
  GltfBuilder file = indexed_cube();
  file.json["accessors"].push_back(
      {{"componentType", 5126}, {"count", 4294967295u}, {"type", "VEC3"}});
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 2;
  file = with_nodes(file, 3);
  for (int i = 1; i < 3; ++i) file.json["nodes"][std::size_t(i)] = file.json["nodes"][0];
  EXPECT_INPUT_ERROR(file.read(), "would be 154618822620 triangles");
  // Without triangles there is nothing to place.
  file.json["accessors"][1]["count"] = 2;
  EXPECT_TRUE(file.read().triangles.empty());
}

// Long lists of vertices of which each primitive uses three.
TEST(GltfLimits, VerticesAreCountedToo) {
  GltfBuilder file = one_triangle();
  file.attributes()["POSITION"] = file.add(std::vector<float>(3 * 100000), "VEC3");
  file.primitive()["indices"] = file.add<std::uint8_t>({0, 1, 2}, "SCALAR");
  EXPECT_INPUT_ERROR(with_nodes(file, 600).read(), "would be 60000000 vertices; at most 50331648");
}

TEST(GltfLimits, MorphTargetsAreCountedToo) {
  GltfBuilder file = one_triangle();
  file.attributes()["POSITION"] = file.add(std::vector<float>(3 * 100000), "VEC3");
  for (int i = 0; i < 3000; ++i) {
    file.primitive()["targets"].push_back({{"POSITION", file.attributes()["POSITION"]}});
    file.json["meshes"][0]["weights"].push_back(1);
  }
  EXPECT_INPUT_ERROR(file.read(), "its morph targets have too many vertices to add up");
}

}  // namespace
}  // namespace viewcell

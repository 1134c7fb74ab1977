#include <gtest/gtest.h>

#include "common/expect_input_error.h"
#include "common/mutate.h"
#include "common/temporary_folder.h"
#include "formats/mesh_file.h"
#include "formats/readers.h"
#include "mesh/cube.h"

namespace viewcell {
namespace {

TriMesh parse_json(const std::string& json) {
  return parse_gltf(make_glb(json, cube_buffer()), "m.glb");
}

// Signed volume: positive when the triangles face outward.
double volume(const TriMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += glm::dot(glm::dvec3(mesh.positions[t[0]]), area_normal(mesh, t)) / 6;
  return sum;
}

TEST(Gltf, NodesAreFlattened) {
  // The child moves by 10 along x, its parent scales by 2 and turns x to y.
  const TriMesh mesh = parse_json(cube_gltf_json(
      R"([{"children": [1], "scale": [2, 2, 2], "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]},
          {"mesh": 0, "translation": [10, 0, 0]}, {"mesh": 0}])"));
  ASSERT_EQ(mesh.positions.size(), 16u);
  EXPECT_EQ(mesh.triangles.size(), 24u);
  EXPECT_NEAR(glm::distance(mesh.positions[1], glm::vec3(0, 22, 0)), 0, 1e-5);
  EXPECT_NEAR(glm::distance(mesh.positions[3], glm::vec3(-2, 20, 0)), 0, 1e-5);
  EXPECT_NEAR(volume(mesh), 9, 1e-5);
}

TEST(Gltf, TheDefaultSceneIsRead) {
  const std::string more = R"("scene": 1, "scenes": [{"nodes": [0]}, {"nodes": [1]}], )";
  const TriMesh mesh = parse_json(
      cube_gltf_json(R"([{"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]}])", "", more));
  ASSERT_EQ(mesh.positions.size(), 8u);
  EXPECT_EQ(mesh.positions[0], glm::vec3(5, 0, 0));
}

TEST(Gltf, MirroredMeshesStillFaceOutward) {
  EXPECT_NEAR(volume(parse_json(cube_gltf_json(R"([{"mesh": 0, "scale": [-2, 1, 1]}])"))), 2, 1e-6);
  const TriMesh mesh = parse_json(cube_gltf_json(
      R"([{"mesh": 0, "matrix": [1,0,0,0, 0,0,1,0, 0,1,0,0, 7,0,0,1]}])"));  // swaps y and z
  EXPECT_NEAR(volume(mesh), 1, 1e-6);
  EXPECT_EQ(mesh.positions[3], glm::vec3(7, 0, 1));
}

TEST(Gltf, BaseColoursAndMaterials) {
  std::string json = cube_gltf_json(
      R"([{"mesh": 0}])", "",
      R"("materials": [{"name": "gold", "pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0, 1]}}], )");
  const TriMesh mesh =
      parse_json(replaced(json, R"("indices": 1)", R"("indices": 1, "material": 0)"));
  EXPECT_EQ(mesh.colors.at(7), glm::vec3(1, 0.5, 0));
  EXPECT_EQ(mesh.material_names, std::vector<std::string>{"gold"});
  EXPECT_EQ(mesh.materials, std::vector<std::int32_t>(12, 0));
  EXPECT_TRUE(parse_json(cube_gltf_json()).colors.empty());
}

// The positions stand in for every attribute.
TEST(Gltf, AttributesArrive) {
  std::string json = replaced(cube_gltf_json(), R"("POSITION": 0)",
                              R"("POSITION": 0, "NORMAL": 0, "COLOR_0": 0, "TEXCOORD_0": 2)");
  json = replaced(json, R"("type": "SCALAR"})",
                  R"("type": "SCALAR"},
      {"bufferView": 1, "componentType": 5121, "normalized": true, "count": 8, "type": "VEC2"})");
  json = replaced(json, R"([{"mesh": 0}])", R"([{"mesh": 0, "scale": [1, 2, 4]}])");
  const TriMesh mesh = parse_json(json);
  EXPECT_EQ(mesh.colors.at(6), glm::vec3(1));
  const glm::vec3 turned = glm::normalize(glm::vec3(4, 2, 1));  // (1, 1, 1) under that scale
  EXPECT_NEAR(glm::distance(mesh.normals.at(6), turned), 0, 1e-6);
  ASSERT_EQ(mesh.texcoords.size(), 36u);
  EXPECT_FLOAT_EQ(mesh.texcoords[0].x, 3.0f / 255);  // vertex 3: bytes 6 and 7
  EXPECT_FLOAT_EQ(mesh.texcoords[0].y, 1);
}

TEST(Gltf, StripsAndFansKeepTheirSide) {
  std::string buffer;
  for (const glm::vec3& p : {glm::vec3(0, 0, 0), {1, 0, 0}, {0, 1, 0}, {1, 1, 0}})
    append_vec3(buffer, p);
  const auto parse_mode = [&](int mode) {
    const std::string json =
        R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 48}],
          "bufferViews": [{"buffer": 0, "byteLength": 48}], "nodes": [{"mesh": 0}],
          "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}],
          "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": )" +
        std::to_string(mode) + "}]}]}";
    return parse_gltf(make_glb(json, buffer), "m.glb");
  };
  EXPECT_EQ(parse_mode(5).triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(parse_mode(6).triangles, (std::vector<Triangle>{{1, 2, 0}, {2, 3, 0}}));
  EXPECT_EQ(parse_mode(4).triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_TRUE(parse_mode(1).triangles.empty());
}

TEST(Gltf, BuffersBesideTheFile) {
  const TemporaryFolder folder;
  folder.add("a b.bin", cube_buffer());
  const auto read = [&](const std::string& uri) {
    return read_mesh(
        folder.add("m.gltf", cube_gltf_json(R"([{"mesh": 0}])", R"("uri": ")" + uri + R"(", )")));
  };
  EXPECT_EQ(read("a%20b.bin").triangles, cube_triangles());
  EXPECT_INPUT_ERROR(read("../a.bin"), "leaves the file's folder");
  EXPECT_INPUT_ERROR(read("/etc/hostname"), "is absolute");
  EXPECT_INPUT_ERROR(read("http://example.org/a.bin"), "cannot open");
  EXPECT_INPUT_ERROR(read("none.bin"), "cannot open");
  EXPECT_INPUT_ERROR(read("data:text/plain,abc"), "not base64");
  EXPECT_INPUT_ERROR(read("data:;base64,AAA*"), "buffers[0].uri: not valid base64");
  EXPECT_INPUT_ERROR(read("data:;base64,AAAA"), "says 168 bytes and has 3");
  std::string base64;  // 168 bytes are 224 digits
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::string bytes = cube_buffer();
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | static_cast<unsigned char>(bytes[i + k]);
    for (int shift = 18; shift >= 0; shift -= 6) base64 += kDigits[bits >> shift & 63];
  }
  EXPECT_EQ(read("data:application/octet-stream;base64," + base64).positions, cube_positions());
}

TEST(Gltf, AccessorsAreBounded) {
  const auto bad = [](const std::string& from, const std::string& to, const std::string& part) {
    SCOPED_TRACE(to);
    EXPECT_INPUT_ERROR(parse_json(replaced(cube_gltf_json(), from, to)), part);
  };
  bad(R"("count": 8)", R"("count": 9)", "accessors[0]: is past its buffer view's end");
  bad(R"("count": 8)", R"("count": -1)", "accessors[0].count");
  bad(R"("count": 8)", R"("count": 1e18)", "accessors[0].count");
  bad(R"("count": 8)", R"("count": 8, "byteOffset": 4)", "accessors[0]");
  bad(R"("count": 8)", R"("count": 7)",
      "meshes[0].primitives[0]: index 11: vertex 7 does not exist");
  bad(R"("byteLength": 96})", R"("byteLength": 9600})", "bufferViews[0]: is past its buffer's end");
  // Sums that come out within the buffer, of numbers that are not.
  bad(R"("byteLength": 96})", R"("byteOffset": -1000, "byteLength": 1096})",
      "bufferViews[0].byteOffset");
  bad(R"("count": 8)", R"("count": 4611686018427387905)", "accessors[0].count");
  bad(R"("byteLength": 96})", R"("byteLength": 96, "byteStride": 8})", "byteStride");
  bad(R"("byteLength": 96})", R"("byteLength": 96, "byteStride": 16})", "accessors[0]");
  bad(R"({"buffer": 0, "byteLength": 96})", R"({"buffer": 1, "byteLength": 96})", "no such buffer");
  bad(R"("bufferView": 0)", R"("bufferView": 2)", "has no element 2");
  bad(R"("bufferView": 0)", R"("sparse": {}, "bufferView": 0)", "accessors[0].sparse");
  bad(R"("POSITION": 0)", R"("POSITION": 9)", "has no element 9");
  bad(R"("POSITION": 0)", R"("NORMAL": 0)", "has no POSITION");
  bad(R"("VEC3")", R"("VEC2")", "expected 3 components");
  bad(R"("VEC3")", R"("MAT3")", "expected SCALAR");
  bad("5126", "5130", "is no component type");
  bad("5123", "5122", "expected unsigned whole numbers");
  bad("168", "169", "says 169 bytes and has 168");
}

TEST(Gltf, FilesAndNodesAreChecked) {
  const auto bad = [](const std::string& from, const std::string& to, const std::string& part) {
    SCOPED_TRACE(to);
    EXPECT_INPUT_ERROR(parse_json(replaced(cube_gltf_json(), from, to)), part);
  };
  bad(R"("2.0")", R"("1.0")", "only version 2");
  bad(R"("asset")", R"("extensionsRequired": ["MPEG_mesh_linking"], "asset")",
      "the extension MPEG_mesh_linking is not read");
  bad(R"([{"mesh": 0}])", R"([{"children": [1]}, {"mesh": 0}, {"children": [1]}])", "a tree");
  bad(R"([{"mesh": 0}])", R"([{"mesh": 0, "children": [4]}])", "nodes: has no element 4");
  bad(R"([{"mesh": 0}])", R"([{"mesh": 0, "scale": [1, 1]}])", "nodes[0].scale");
  bad(R"([{"mesh": 0}])", R"([{"mesh": 1}])", "meshes: has no element 1");
  const std::string cycle = R"([{"children": [1]}, {"mesh": 0, "children": [0]}])";
  EXPECT_TRUE(parse_json(cube_gltf_json(cycle)).triangles.empty());  // nobody is a root
  EXPECT_INPUT_ERROR(parse_json(cube_gltf_json(cycle, "", R"("scenes": [{"nodes": [0]}], )")),
                     "a tree");
  EXPECT_INPUT_ERROR(parse_gltf(cube_glb().substr(0, 200), "m.glb"), "ends too early");
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  EXPECT_INPUT_ERROR(parse_json(deep), "nested deeper");
}

TEST(Gltf, DamagedJsonNeverCrashes) {
  constexpr std::uint64_t kSeed = 5;
  const std::string more = R"("scenes": [{"nodes": [0]}], "materials": [{"name": "gold"}], )";
  const std::string json =
      replaced(cube_gltf_json(R"([{"children": [1], "scale": [2, 2, 2]}, {"mesh": 0}])", "", more),
               R"("POSITION": 0)", R"("POSITION": 0, "NORMAL": 0, "COLOR_0": 0)");
  read_damaged_copies(json, 4000, kSeed,
                      [](const std::string& damaged) { check_mesh(parse_json(damaged), "m.glb"); });
}

}  // namespace
}  // namespace viewcell

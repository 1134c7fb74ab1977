// Numbers of any component type, and texture coordinates as textures ask for them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/expect_input_error.h"
#include "common/temporary_folder.h"
#include "gltf_builder.h"

namespace viewcell {
namespace {

void expect_near(const glm::vec3& a, const glm::vec3& b, double tolerance, const char* what) {
  EXPECT_NEAR(glm::distance(a, b), 0, tolerance) << what;
}
void expect_near(const glm::vec2& a, const glm::vec2& b, double tolerance) {
  EXPECT_NEAR(glm::distance(a, b), 0, tolerance) << a.x << " " << a.y;
}

// Whole numbers k as they are, and as shares of the type's largest.
template <typename T>
void expect_quantised() {
  SCOPED_TRACE(GltfBuilder::component_type<T>());
  constexpr T kMost = std::numeric_limits<T>::max();
  const T least = std::is_signed_v<T> ? static_cast<T>(-kMost) : T{0};
  for (const bool normalized : {false, true}) {
    GltfBuilder file = one_triangle();
    // 4 components each, so that elements of bytes lie at multiples of 4: the last is for none.
    const std::vector<T> numbers{0, 0, 0, 9, kMost, 0, 0, 9, 0, kMost, least, 9};
    const std::size_t view =
        file.add_view(numbers.data(), numbers.size() * sizeof(T), 4 * sizeof(T));
    Json accessor{{"bufferView", view},
                  {"componentType", GltfBuilder::component_type<T>()},
                  {"normalized", normalized},
                  {"count", 3},
                  {"type", "VEC3"}};
    file.attributes()["POSITION"] = GltfBuilder::append(file.json["accessors"], accessor);
    file.attributes()["NORMAL"] = GltfBuilder::append(file.json["accessors"], accessor);
    accessor["type"] = "VEC2";
    file.attributes()["TEXCOORD_0"] = GltfBuilder::append(file.json["accessors"], accessor);
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const TriMesh mesh = file.read();
    const float most = normalized ? 1 : static_cast<float>(kMost);
    const float low = normalized ? (std::is_signed_v<T> ? -1 : 0) : static_cast<float>(least);
    EXPECT_EQ(mesh.positions[1], glm::vec3(most, 0, 0));
    EXPECT_EQ(mesh.positions[2], glm::vec3(0, most, low));
    EXPECT_EQ(mesh.normals[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.texcoords[1], glm::vec2(most, 1));
    EXPECT_EQ(mesh.texcoords[2], glm::vec2(0, 1 - most));
  }
}

TEST(GltfAttributes, QuantisedNumbers) {
  expect_quantised<std::int8_t>();
  expect_quantised<std::uint8_t>();
  expect_quantised<std::int16_t>();
  expect_quantised<std::uint16_t>();
}

// The least of a signed type is below -1 and means -1.
TEST(GltfAttributes, SharesEndAtMinusOne) {
  GltfBuilder file = one_triangle();
  file.attributes()["POSITION"] =
      file.add<std::int16_t>({-32768, -32767, 0, 32767, 0, 0, 0, 0, 0}, "VEC3", true);
  EXPECT_EQ(file.read().positions[0], glm::vec3(-1, -1, 0));
}

// Colours are linear shares in every type, with or without alpha; integers are shares though they
// do not say so.
template <typename T>
void expect_colors(T most, bool normalized) {
  SCOPED_TRACE(GltfBuilder::component_type<T>());
  for (const std::size_t n : {3u, 4u}) {
    GltfBuilder file = one_triangle();
    std::vector<T> colors(3 * n, 0);
    colors[0] = most, colors[n + 1] = most, colors[2 * n + 2] = static_cast<T>(most / 5);
    file.attributes()["COLOR_0"] = file.add(colors, n == 3 ? "VEC3" : "VEC4", normalized);
    file.json["materials"] =
        Json::parse(R"([{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 1, 0.25, 1]}}])");
    file.primitive()["material"] = 0;
    const TriMesh mesh = file.read();
    expect_near(mesh.colors[0], {0.5, 0, 0}, 1e-6, "red");
    expect_near(mesh.colors[1], {0, 1, 0}, 1e-6, "green");
    expect_near(mesh.colors[2], {0, 0, 0.05}, 1e-6, "blue");
  }
}

TEST(GltfAttributes, Colours) {
  expect_colors<std::uint8_t>(255, true);
  expect_colors<std::uint16_t>(65535, true);
  expect_colors<float>(1, false);
  expect_colors<std::uint8_t>(255, false);
}

// White, as in files without colours, and counted.
TEST(GltfAttributes, ColoursThatAreNoNumbers) {
  GltfBuilder file = one_triangle();
  const float none = std::numeric_limits<float>::quiet_NaN();
  file.attributes()["COLOR_0"] = file.add<float>({none, 0, 0, 1, 0, 0, 0, 2, -1}, "VEC3");
  const TemporaryFolder folder;
  MeshSource source;
  const TriMesh mesh = read_mesh(folder.add("m.glb", file.bytes()), &source);
  EXPECT_EQ(mesh.colors, (std::vector<glm::vec3>{{1, 1, 1}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(count_said(source.remarks, "colours that are no numbers"), 1u);
}

// Triangle with texture coordinates (0, 0), (1, 0), (0, 1) of v down, in the set, under a material
// whose base colour has that textureInfo.
TriMesh read_textured(const std::string& info, int set = 0, Remarks* remarks = nullptr) {
  GltfBuilder file = one_triangle();
  file.attributes()["TEXCOORD_" + std::to_string(set)] =
      file.add<float>({0, 0, 1, 0, 0, 1}, "VEC2");
  file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = Json::parse(info);
  file.json["textures"] = Json::parse(R"([{"source": 0}])");
  file.primitive()["material"] = 0;
  return file.read(remarks);
}

// The specification's example: the lower left quarter of the picture, a quarter of a turn.
TEST(GltfAttributes, TextureTransform) {
  const TriMesh turned = read_textured(
      R"({"index": 0, "extensions": {"KHR_texture_transform":
          {"offset": [0, 1], "rotation": 1.57079632679, "scale": [0.5, 0.5]}}})");
  expect_near(turned.texcoords[0], {0, 0}, 1e-6);    // v down: 1
  expect_near(turned.texcoords[1], {0, 0.5}, 1e-6);  // u goes up the picture
  expect_near(turned.texcoords[2], {0.5, 0}, 1e-6);  // v goes to the right
  const TriMesh upright = read_textured(
      R"({"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0, 1], "scale": [1, -1]}}})");
  EXPECT_EQ(upright.texcoords, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}));
  // Scaled before it is turned: (1, 0) -> (2, 0) -> 2 (cos, -sin); (0, 1) -> (0, 3) -> 3 (sin,
  // cos).
  const TriMesh both = read_textured(
      R"({"index": 0, "extensions": {"KHR_texture_transform": {"rotation": 0.3, "scale": [2, 3]}}})");
  expect_near(both.texcoords[1], {2 * std::cos(0.3), 1 + 2 * std::sin(0.3)}, 1e-6);
  expect_near(both.texcoords[2], {3 * std::sin(0.3), 1 - 3 * std::cos(0.3)}, 1e-6);
}

TEST(GltfAttributes, TheTextureSaysWhichCoordinates) {
  const std::vector<glm::vec2> expected{{0, 1}, {1, 1}, {0, 0}};
  EXPECT_EQ(read_textured(R"({"index": 0, "texCoord": 1})", 1).texcoords, expected);
  EXPECT_EQ(read_textured(R"({"index": 0, "texCoord": 0, "extensions":
      {"KHR_texture_transform": {"texCoord": 3}}})",
                          3)
                .texcoords,
            expected);
  Remarks remarks;
  EXPECT_TRUE(read_textured(R"({"index": 0, "texCoord": 2})", 1, &remarks).texcoords.empty());
  EXPECT_EQ(count_said(remarks, "without the texture coordinates that their texture asks for"), 1u);
  // Without a texture, the first set that there is; without base colour, another slot's.
  GltfBuilder file = one_triangle();
  file.attributes()["TEXCOORD_1"] = file.add<float>({0, 0, 1, 0, 0, 1}, "VEC2");
  EXPECT_EQ(file.read().texcoords, expected);
  file.json["materials"] = Json::parse(R"([{"normalTexture": {"index": 0, "texCoord": 1}}])");
  file.json["textures"] = Json::parse(R"([{"source": 0}])");
  file.primitive()["material"] = 0;
  EXPECT_EQ(file.read().texcoords, expected);
  // Of materials from before metal and roughness.
  file.json["materials"] = Json::parse(R"([{"extensions": {"KHR_materials_pbrSpecularGlossiness":
      {"diffuseFactor": [1, 0.5, 0, 1], "diffuseTexture": {"index": 0, "texCoord": 1}}}}])");
  const TriMesh old = file.read();
  EXPECT_EQ(old.texcoords, expected);
  EXPECT_EQ(old.colors[0], glm::vec3(1, 0.5, 0));
}

// Two parts over the same vertices, each with its own material: the vertices are there once where
// both ask for the same, twice where not.
TEST(GltfAttributes, PartsShareVertices) {
  GltfBuilder file = indexed_cube();
  file.attributes()["TEXCOORD_0"] = file.add(std::vector<float>(16, 0.25f), "VEC2");
  file.json["materials"] = Json::parse(
      R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "name": "a"},
          {"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}, "name": "a"}])");
  file.json["textures"] = Json::parse(R"([{"source": 0}, {"source": 1}])");
  Json second = file.primitive();
  file.primitive()["material"] = 0, second["material"] = 1;
  file.json["meshes"][0]["primitives"].push_back(second);
  const TriMesh shared = file.read();
  EXPECT_EQ(shared.positions.size(), 8u);
  EXPECT_EQ(shared.triangles.size(), 24u);
  EXPECT_EQ(shared.triangles[0], shared.triangles[12]);
  // Names that are the same twice are two names.
  EXPECT_EQ(shared.material_names, (std::vector<std::string>{"a", "a (materials[1])"}));
  file.json["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] =
      Json::parse(R"({"KHR_texture_transform": {"scale": [2, 2]}})");
  const TriMesh apart = file.read();
  EXPECT_EQ(apart.positions.size(), 16u);
  EXPECT_EQ(apart.texcoords[0], glm::vec2(0.25, 0.75));
  EXPECT_EQ(apart.texcoords[36], glm::vec2(0.5, 0.5));
}

TEST(GltfAttributes, PicturesThatDoNotRepeat) {
  const auto count = [](int wrap, float u) {
    GltfBuilder file = one_triangle();
    file.attributes()["TEXCOORD_0"] = file.add<float>({0, 0, u, 0, 0, 1}, "VEC2");
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    file.json["textures"] = Json::parse(R"([{"source": 0, "sampler": 0}])");
    file.json["samplers"][0]["wrapS"] = wrap;
    file.primitive()["material"] = 0;
    Remarks remarks;
    file.read(&remarks);
    return count_said(remarks, "clamped or mirrored");
  };
  EXPECT_EQ(count(33648, 1.5f), 1u);
  EXPECT_EQ(count(33071, 1.5f), 1u);
  EXPECT_EQ(count(33071, 1), 0u);
  EXPECT_EQ(count(10497, 1.5f), 0u);
}

TEST(GltfAttributes, WrongOnes) {
  const auto bad = [](const auto& change, const std::string& part) {
    GltfBuilder file = one_triangle();
    change(file);
    EXPECT_INPUT_ERROR(file.read(), part);
  };
  bad(
      [](GltfBuilder& f) {
        f.attributes()["NORMAL"] = f.add<float>({1, 0, 0}, "VEC3");
      },
      "NORMAL and POSITION differ in length");
  bad(
      [](GltfBuilder& f) {
        f.attributes()["COLOR_0"] = f.add<float>({0, 0, 0, 0, 0, 0}, "VEC2");
      },
      "COLOR_0: expected 3 or 4 components");
  bad([](GltfBuilder& f) { f.attributes()["TEXCOORD_0"] = 0; }, "expected 2 components");
  bad(
      [](GltfBuilder& f) {
        f.json["extensionsRequired"] = {"KHR_mesh_quantization", "ACME_fractals"};
      },
      "extensionsRequired[1]: the extension ACME_fractals is not read");
  GltfBuilder file = one_triangle();
  file.json["extensionsUsed"] = {"ACME_fractals", "KHR_materials_unlit"};
  Remarks remarks;
  file.read(&remarks);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].what, "the extension ACME_fractals, not applied");
}

}  // namespace
}  // namespace viewcell

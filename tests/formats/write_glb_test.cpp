#include "formats/write_glb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/json.h"
#include "base/random.h"
#include "common/expect_input_error.h"
#include "common/same_every_time.h"
#include "common/temporary_folder.h"
#include "formats/mesh_file.h"
#include "image/io.h"
#include "mesh/cube.h"

namespace viewcell {
namespace {

TriMesh cube_mesh() {
  TriMesh mesh;
  mesh.positions = cube_positions();
  mesh.triangles = cube_triangles();
  return mesh;
}

// A fan of triangles over random vertices; corners at one vertex share coordinates or do not.
TriMesh random_mesh(Random& random, bool has_texcoords) {
  TriMesh mesh;
  const std::uint32_t n = 3 + random.below(40);
  const auto number = [&] { return static_cast<float>(random.uniform(-5, 5)); };
  for (std::uint32_t v = 0; v < n; ++v) mesh.positions.emplace_back(number(), number(), number());
  std::vector<glm::vec2> charts;
  for (int i = 0; i < 6; ++i) charts.emplace_back(random.uniform(), random.uniform());
  for (std::uint32_t t = 1 + random.below(60); t-- > 0;) {
    const std::uint32_t a = random.below(n), b = (a + 1 + random.below(n - 2)) % n;
    std::uint32_t c = 0;
    while (c == a || c == b) ++c;
    mesh.triangles.push_back({a, b, c});
    if (!has_texcoords) continue;
    for (int k = 0; k < 3; ++k) mesh.texcoords.push_back(charts[random.below(6)]);
  }
  return mesh;
}

// The two chunks, after holding that the frame around them is right.
struct Glb {
  Json json;
  std::string binary;
};
Glb split_glb(const std::string& bytes) {
  const auto word = [&](std::size_t at) {
    std::uint32_t out = 0;
    std::memcpy(&out, bytes.data() + at, 4);
    return out;
  };
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(word(4), 2u);
  EXPECT_EQ(word(8), bytes.size());
  EXPECT_EQ(word(12) % 4, 0u);
  EXPECT_EQ(word(16), 0x4e4f534au);
  const std::size_t binary = 20 + word(12);
  EXPECT_EQ(word(binary + 4), 0x004e4942u);
  EXPECT_EQ(word(binary) % 4, 0u);
  EXPECT_EQ(binary + 8 + word(binary), bytes.size());
  return {Json::parse(bytes.substr(20, word(12))), bytes.substr(binary + 8)};
}

const std::string kPng = encode_png(ImageRgba8(3, 2, {200, 100, 50, 255}));

TEST(WriteGlb, MeshesWithoutTextureComeBackBitForBit) {
  const TemporaryFolder folder;
  Random random(1);
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    const TriMesh mesh = random_mesh(random, false);
    write_glb(folder.path() / "a.glb", mesh);
    const TriMesh back = read_mesh(folder.path() / "a.glb");
    EXPECT_EQ(back.positions, mesh.positions);
    EXPECT_EQ(back.triangles, mesh.triangles);
    EXPECT_TRUE(back.texcoords.empty());
    EXPECT_TRUE(back.normals.empty());
    EXPECT_TRUE(back.colors.empty());
  }
}

TEST(WriteGlb, CornersKeepTheirPlacesAndCoordinates) {
  const TemporaryFolder folder;
  Random random(2);
  std::size_t n_split = 0;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    const TriMesh mesh = random_mesh(random, true);
    write_glb(folder.path() / "a.glb", mesh);
    const TriMesh back = read_mesh(folder.path() / "a.glb");
    ASSERT_GE(back.positions.size(), mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      EXPECT_EQ(back.positions[v], mesh.positions[v]);
    n_split += back.positions.size() - mesh.positions.size();
    ASSERT_EQ(back.triangles.size(), mesh.triangles.size());
    for (std::size_t c = 0; c < mesh.texcoords.size(); ++c) {
      const std::uint32_t v = mesh.triangles[c / 3][c % 3], w = back.triangles[c / 3][c % 3];
      EXPECT_EQ(back.positions[w], mesh.positions[v]);
      EXPECT_TRUE(w == v || w >= mesh.positions.size());
      EXPECT_EQ(back.texcoords[c].x, mesh.texcoords[c].x);
      EXPECT_NEAR(back.texcoords[c].y, mesh.texcoords[c].y, 0x1p-25);
    }
    write_glb(folder.path() / "b.glb", back);
    EXPECT_EQ(read_file(folder.path() / "a.glb"), read_file(folder.path() / "b.glb"));
  }
  EXPECT_GT(n_split, 500u);
}

// Two triangles over one edge; at vertex 1 they share coordinates, at vertex 2 they do not: one
// copy, number 4.
TEST(WriteGlb, AVertexIsSplitOnceForEachCoordinate) {
  const TemporaryFolder folder;
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {2, 1, 3}, {2, 1, 0}};
  const glm::vec2 a(0, 0), b(1, 0), c(0, 1), d(0.5f, 0.25f);
  mesh.texcoords = {a, b, c, d, b, c, d, b, a};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.normals[2] = {1, 0, 0};
  write_glb(folder.path() / "a.glb", mesh);
  const TriMesh back = read_mesh(folder.path() / "a.glb");
  EXPECT_EQ(back.triangles, (std::vector<Triangle>{{0, 1, 2}, {4, 1, 3}, {4, 1, 0}}));
  EXPECT_EQ(back.texcoords, mesh.texcoords);
  ASSERT_EQ(back.normals.size(), 5u);
  EXPECT_EQ(back.normals[4], glm::vec3(1, 0, 0));
  EXPECT_EQ(back.normals[3], glm::vec3(0, 0, 1));
}

TEST(WriteGlb, ColoursAreThereUnlessThereIsATexture) {
  const TemporaryFolder folder;
  TriMesh mesh = cube_mesh();
  for (std::size_t v = 0; v < 8; ++v)
    mesh.colors.push_back({static_cast<float>(v) / 7, 0.25f, 0.5f});
  mesh.texcoords.assign(36, {0.5f, 0.5f});
  write_glb(folder.path() / "a.glb", mesh);
  EXPECT_EQ(read_mesh(folder.path() / "a.glb").colors, mesh.colors);
  write_glb(folder.path() / "a.glb", mesh, {.base_color = kPng, .normal_map = "", .generator = ""});
  EXPECT_TRUE(read_mesh(folder.path() / "a.glb").colors.empty());
}

// The rules that validators complain about.
TEST(WriteGlb, KeepsTheRulesOfTheFormat) {
  const TemporaryFolder folder;
  TriMesh mesh = cube_mesh();
  mesh.texcoords.assign(36, {0.25f, 0.75f});
  mesh.normals = make_vertex_normals(mesh);
  std::string odd = kPng + "abc";  // what follows a picture is padded
  write_glb(folder.path() / "a.glb", mesh,
            {.base_color = odd, .normal_map = kPng, .generator = "a tool 1.2"});
  const Glb glb = split_glb(read_file(folder.path() / "a.glb"));
  const Json& json = glb.json;
  EXPECT_EQ(json["asset"], Json::parse(R"({"version": "2.0", "generator": "a tool 1.2"})"));
  EXPECT_EQ(json["scenes"], Json::parse(R"([{"nodes": [0]}])"));
  EXPECT_EQ(json["nodes"], Json::parse(R"([{"mesh": 0}])"));
  EXPECT_EQ(json["buffers"].size(), 1u);
  EXPECT_EQ(json["buffers"][0]["byteLength"], glb.binary.size());
  ASSERT_EQ(json["bufferViews"].size(), 7u);
  std::size_t end = 0;
  for (const Json& view : json["bufferViews"]) {
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0u);
    EXPECT_GE(view["byteOffset"].get<std::size_t>(), end);
    end = view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>();
    EXPECT_LE(end, glb.binary.size());
  }
  const Json& primitive = json["meshes"][0]["primitives"][0];
  for (const auto& [name, id] : primitive["attributes"].items()) {
    const Json& accessor = json["accessors"][id.get<std::size_t>()];
    EXPECT_EQ(accessor["count"], 8) << name;
    EXPECT_EQ(accessor["type"],
              name == "TEXCOORD_0" ? "VEC2" : (name == "TANGENT" ? "VEC4" : "VEC3"));
    EXPECT_EQ(json["bufferViews"][accessor["bufferView"].get<std::size_t>()]["target"], 34962);
    EXPECT_EQ(accessor.contains("min"), name == "POSITION");
  }
  const Json& positions = json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_EQ(positions["min"], Json::parse("[0.0, 0.0, 0.0]"));
  EXPECT_EQ(positions["max"], Json::parse("[1.0, 1.0, 1.0]"));
  const Json& indices = json["accessors"][primitive["indices"].get<std::size_t>()];
  EXPECT_EQ(json["bufferViews"][indices["bufferView"].get<std::size_t>()]["target"], 34963);
  EXPECT_EQ(indices["componentType"], 5123);
  EXPECT_EQ(indices["count"], 36);
  ASSERT_EQ(json["images"].size(), 2u);
  for (const Json& image : json["images"]) {
    EXPECT_EQ(image["mimeType"], "image/png");
    EXPECT_FALSE(json["bufferViews"][image["bufferView"].get<std::size_t>()].contains("target"));
  }
  const Json& view = json["bufferViews"][json["images"][0]["bufferView"].get<std::size_t>()];
  EXPECT_EQ(glb.binary.substr(view["byteOffset"], view["byteLength"]), odd);
  const Json& material = json["materials"][0];
  EXPECT_EQ(json["textures"][0]["source"], 0);
  EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
  EXPECT_EQ(material["normalTexture"]["index"], 1);
  EXPECT_EQ(json["textures"][1]["source"], 1);
}

// glTF's v runs down.
TEST(WriteGlb, TextureCoordinatesAreTurnedOver) {
  const TemporaryFolder folder;
  TriMesh mesh = cube_mesh();
  mesh.texcoords.assign(36, {0.125f, 0.25f});
  write_glb(folder.path() / "a.glb", mesh);
  const Glb glb = split_glb(read_file(folder.path() / "a.glb"));
  const std::size_t id = glb.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"];
  const std::size_t view = glb.json["accessors"][id]["bufferView"];
  const std::size_t at = glb.json["bufferViews"][view]["byteOffset"];
  glm::vec2 first;
  std::memcpy(&first, glb.binary.data() + at, sizeof first);
  EXPECT_EQ(first, glm::vec2(0.125f, 0.75f));
}

//  1--2--3    u grows from the middle, 2-5, to both sides: 2 and 5 have a tangent on either side
//  |/ |\ |
//  0--5--4
TEST(WriteGlb, TangentsPartAtMirrors) {
  const TemporaryFolder folder;
  TriMesh mesh;
  mesh.positions = {{-1, 0, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0}};
  mesh.normals.assign(6, {0, 0, 1});
  mesh.triangles = {{0, 2, 1}, {0, 5, 2}, {4, 3, 2}, {5, 4, 2}};
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      mesh.texcoords.emplace_back(std::abs(mesh.positions[v].x), mesh.positions[v].y);
  write_glb(folder.path() / "a.glb", mesh, {.base_color = "", .normal_map = kPng, .generator = ""});
  const Glb glb = split_glb(read_file(folder.path() / "a.glb"));
  const Json& primitive = glb.json["meshes"][0]["primitives"][0];
  const auto read = [&](const Json& id, auto& out) {
    const Json& accessor = glb.json["accessors"][id.get<std::size_t>()];
    const Json& view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    out.resize(accessor["count"].get<std::size_t>());
    std::memcpy(out.data(), glb.binary.data() + view["byteOffset"].get<std::size_t>(),
                out.size() * sizeof out[0]);
  };
  std::vector<glm::vec4> tangents;
  std::vector<std::uint16_t> indices;
  read(primitive["attributes"]["TANGENT"], tangents);
  read(primitive["indices"], indices);
  ASSERT_EQ(tangents.size(), 8u);
  for (std::size_t c = 0; c < indices.size(); ++c) {
    const float side = c < 6 ? -1 : 1;
    EXPECT_EQ(tangents[indices[c]], glm::vec4(side, 0, 0, side)) << c;
  }
  const TriMesh back = read_mesh(folder.path() / "a.glb");
  EXPECT_EQ(back.texcoords, mesh.texcoords);
  mesh.normals.clear();  // a viewer takes normals of its own
  write_glb(folder.path() / "a.glb", mesh, {.base_color = "", .normal_map = kPng, .generator = ""});
  EXPECT_EQ(read_file(folder.path() / "a.glb").find("TANGENT"), std::string::npos);
}

TEST(WriteGlb, IndicesWidenWhereSixteenBitsEnd) {
  const TemporaryFolder folder;
  for (const std::uint32_t n : {65535u, 65536u}) {
    TriMesh mesh;
    mesh.positions.assign(n, glm::vec3(1));
    mesh.triangles = {{0, 1, n - 1}, {n - 1, n - 2, 2}};
    write_glb(folder.path() / "a.glb", mesh);
    const Glb glb = split_glb(read_file(folder.path() / "a.glb"));
    const std::size_t id = glb.json["meshes"][0]["primitives"][0]["indices"];
    EXPECT_EQ(glb.json["accessors"][id]["componentType"], n == 65535 ? 5123 : 5125);
    EXPECT_EQ(read_mesh(folder.path() / "a.glb").triangles, mesh.triangles);
  }
}

TEST(WriteGlb, SameBytesEveryTimeAndAGeneratorByDefault) {
  const TemporaryFolder folder;
  Random random(3);
  const TriMesh mesh = random_mesh(random, true);
  const std::string bytes = same_every_time([&](std::size_t i) {
    const auto file = folder.path() / (std::to_string(i) + ".glb");
    write_glb(file, mesh, {.base_color = kPng, .normal_map = "", .generator = ""});
    return read_file(file);
  });
  EXPECT_TRUE(
      split_glb(bytes).json["asset"]["generator"].get<std::string>().starts_with("viewcell "));
}

// ---- materials ----

//  3--2--5    a: triangles 0 and 1, b: 2, c: none, d: 3
//  |/ |/ |
//  0--1--4
TriMesh make_strip() {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  mesh.material_names = {"a", "b", "c", "d"};
  mesh.materials = {0, 0, 1, 3};
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      mesh.texcoords.emplace_back(0.5f * mesh.positions[v].x, mesh.positions[v].y);
  return mesh;
}

Json write_json(const TriMesh& mesh, const GlbOptions& options, Remarks* remarks = nullptr) {
  const TemporaryFolder folder;
  write_glb(folder.path() / "a.glb", mesh, options, remarks);
  return split_glb(read_file(folder.path() / "a.glb")).json;
}

TEST(WriteGlb, MaterialsArePrimitivesOverOneListOfVertices) {
  const TriMesh mesh = make_strip();
  GlbOptions options;
  options.materials.resize(4);
  options.materials[0] = {.name = "skin", .base_color = kPng, .normal_map = kPng};
  options.materials[0].base_color_factor = {0.5, 1, 1, 0.25};
  options.materials[0].normal_scale = 2;
  options.materials[0].alpha_mode = "BLEND";
  options.materials[1].name = "cloth";
  options.materials[1].base_color = encode_png(ImageRgba8(5, 5));
  options.materials[1].metallic = 0.5, options.materials[1].roughness = 0.25;
  options.materials[1].alpha_mode = "MASK", options.materials[1].alpha_cutoff = 0.75;
  options.materials[3].emissive = {0, 0, 1};
  options.materials[3].is_double_sided = true;
  Remarks remarks;
  const Json json = write_json(mesh, options, &remarks);
  EXPECT_TRUE(remarks.empty());
  const Json& primitives = json["meshes"][0]["primitives"];
  ASSERT_EQ(primitives.size(), 3u);
  std::vector<std::size_t> n_indices;
  for (const Json& p : primitives) {
    EXPECT_EQ(p["attributes"], primitives[0]["attributes"]);
    n_indices.push_back(json["accessors"][p["indices"].get<std::size_t>()]["count"]);
  }
  EXPECT_EQ(n_indices, (std::vector<std::size_t>{6, 3, 3}));
  EXPECT_EQ(primitives[1]["material"], 1);
  EXPECT_EQ(primitives[2]["material"], 3);
  EXPECT_EQ(json["images"].size(), 2u);  // one of them twice
  ASSERT_EQ(json["materials"].size(), 4u);
  EXPECT_EQ(json["materials"][0], Json::parse(R"({"name": "skin",
    "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 1.0,
      "baseColorFactor": [0.5, 1.0, 1.0, 0.25], "baseColorTexture": {"index": 0}},
    "normalTexture": {"index": 0, "scale": 2.0}, "alphaMode": "BLEND"})"));
  EXPECT_EQ(json["materials"][1], Json::parse(R"({"name": "cloth",
    "pbrMetallicRoughness": {"metallicFactor": 0.5, "roughnessFactor": 0.25,
      "baseColorTexture": {"index": 1}}, "alphaMode": "MASK", "alphaCutoff": 0.75})"));
  EXPECT_EQ(json["materials"][3], Json::parse(R"({
    "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 1.0},
    "emissiveFactor": [0.0, 0.0, 1.0], "doubleSided": true})"));
}

TEST(WriteGlb, SamplersAreWrittenOnce) {
  TriMesh mesh = make_strip();
  GlbOptions options;
  options.materials.resize(4);
  for (GlbMaterial& m : options.materials) m.base_color = kPng;
  options.materials[1].color_sampler.wrap_t = GlbSampler::kMirrored;
  options.materials[2].color_sampler = options.materials[1].color_sampler;
  options.materials[3].color_sampler.mag_filter = GlbSampler::kNearest;
  const Json json = write_json(mesh, options);
  EXPECT_EQ(json["images"].size(), 1u);
  EXPECT_EQ(json["samplers"], Json::parse(R"([{"magFilter": 9729, "minFilter": 9987},
    {"magFilter": 9729, "minFilter": 9987, "wrapT": 33648},
    {"magFilter": 9728, "minFilter": 9987}])"));
  std::vector<int> samplers;
  for (const Json& m : json["materials"]) {
    const std::size_t texture = m["pbrMetallicRoughness"]["baseColorTexture"]["index"];
    samplers.push_back(json["textures"][texture]["sampler"]);
  }
  EXPECT_EQ(samplers, (std::vector<int>{0, 1, 1, 2}));
}

TEST(WriteGlb, MaterialsComeBackWithTheirTriangles) {
  const TemporaryFolder folder;
  TriMesh mesh = make_strip();
  mesh.materials = {3, 0, 1, 0};  // triangles of a material come together
  GlbOptions options;
  options.materials.resize(4);
  for (std::size_t m = 0; m < 4; ++m) options.materials[m].name = mesh.material_names[m];
  write_glb(folder.path() / "a.glb", mesh, options);
  const TriMesh back = read_mesh(folder.path() / "a.glb");
  EXPECT_EQ(back.positions, mesh.positions);
  EXPECT_EQ(back.triangles, (std::vector<Triangle>{mesh.triangles[1], mesh.triangles[3],
                                                   mesh.triangles[2], mesh.triangles[0]}));
  std::vector<std::string> names;
  for (const std::int32_t m : back.materials)
    names.push_back(back.material_names[static_cast<std::size_t>(m)]);
  EXPECT_EQ(names, (std::vector<std::string>{"a", "a", "b", "d"}));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(back.texcoords[9 + k], mesh.texcoords[k]);
}

// What multiplies a texture is left out, and said.
TEST(WriteGlb, ColoursBesideMaterialsAreLeftOut) {
  TriMesh mesh = make_strip();
  mesh.colors.assign(6, {1, 0, 0});
  GlbOptions options;
  options.materials.resize(4);
  Remarks remarks;
  const Json json = write_json(mesh, options, &remarks);
  EXPECT_FALSE(json["meshes"][0]["primitives"][0]["attributes"].contains("COLOR_0"));
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].count, 6u);
  options.materials.resize(3);  // material 3 has none
  EXPECT_THROW(write_json(mesh, options), BugError);
}

//  3--2--5    u grows to the right under material 0, and to the left under 1 and 3: at vertices 1
//  |/ |/ |    and 2, which share coordinates, tangents are of their own material alone
//  0--1--4
TEST(WriteGlb, TangentsAreThoseOfTheirMaterial) {
  TriMesh mesh = make_strip();
  mesh.normals.assign(6, {0, 0, 1});
  for (std::size_t c = 6; c < 12; ++c) {
    glm::vec2& uv = mesh.texcoords[c];
    uv = {0.5f + 0.25f * (uv.y - 0.5f), 0.5f - (uv.x - 0.5f)};
  }
  GlbOptions options;
  options.materials.resize(4);
  for (GlbMaterial& m : options.materials) m.normal_map = kPng;
  const TemporaryFolder folder;
  write_glb(folder.path() / "a.glb", mesh, options);
  const Glb glb = split_glb(read_file(folder.path() / "a.glb"));
  const auto read = [&](const Json& id, auto& out) {
    const Json& accessor = glb.json["accessors"][id.get<std::size_t>()];
    const Json& view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    out.resize(accessor["count"].get<std::size_t>());
    std::memcpy(out.data(), glb.binary.data() + view["byteOffset"].get<std::size_t>(),
                out.size() * sizeof out[0]);
  };
  const Json& primitives = glb.json["meshes"][0]["primitives"];
  std::vector<glm::vec4> tangents;
  read(primitives[0]["attributes"]["TANGENT"], tangents);
  const std::vector<glm::vec4> expected{{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 1, 0, 1}};
  for (std::size_t p = 0; p < 3; ++p) {
    std::vector<std::uint16_t> indices;
    read(primitives[p]["indices"], indices);
    for (const std::uint16_t i : indices)
      for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(tangents[i][k], expected[p][k], 1e-6) << p << " " << i;
  }
}

TEST(WriteGlb, WhatCannotBeWrittenIsRefused) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.glb";
  TriMesh mesh = cube_mesh();
  EXPECT_THROW(write_glb(file, TriMesh()), BugError);
  EXPECT_THROW(write_glb(file, mesh, {.base_color = kPng, .normal_map = "", .generator = ""}),
               BugError);
  mesh.texcoords.assign(36, glm::vec2(0));
  EXPECT_INPUT_ERROR(
      write_glb(file, mesh, {.base_color = "RIFF....WEBP", .normal_map = "", .generator = ""}),
      "is neither PNG nor JPEG");
  mesh.texcoords[7].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_INPUT_ERROR(write_glb(file, mesh), "texture coordinates: hold a number");
  mesh.texcoords[7].y = 0;
  mesh.positions[3].z = std::numeric_limits<float>::infinity();
  EXPECT_INPUT_ERROR(write_glb(file, mesh), "positions: hold a number");
  mesh.positions[3].z = 0;
  EXPECT_THROW(write_glb(folder.path() / "none/a.glb", mesh), MachineError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace viewcell

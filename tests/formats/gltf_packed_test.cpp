// Accessors that are sparse, views that meshoptimizer packed, primitives that Draco packed.
#include <draco/compression/encode.h>
#include <draco/core/encoder_buffer.h>
#include <draco/mesh/mesh.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <numeric>

#include "base/random.h"
#include "common/expect_input_error.h"
#include "common/models.h"
#include "common/mutate.h"
#include "gltf_builder.h"

namespace viewcell {
namespace {

// ---- sparse ----

GltfBuilder sparse_cube() {
  GltfBuilder file = indexed_cube();
  const std::vector<std::uint8_t> indices{2, 7};
  const std::vector<float> values{5, 5, 5, 0, 1, 9};
  file.json["accessors"][0]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", file.add_view(indices.data(), 2)}, {"componentType", 5121}}},
      {"values", {{"bufferView", file.add_view(values.data(), 24)}}}};
  return file;
}

TEST(GltfSparse, ValuesReplaceThoseOfTheView) {
  std::vector<glm::vec3> expected = cube_positions();
  expected[2] = {5, 5, 5}, expected[7] = {0, 1, 9};
  EXPECT_EQ(sparse_cube().read().positions, expected);
}

TEST(GltfSparse, WithoutAViewTheOthersAreZero) {
  GltfBuilder file = sparse_cube();
  file.json["accessors"][0].erase("bufferView");
  std::vector<glm::vec3> expected(8, glm::vec3(0));
  expected[2] = {5, 5, 5}, expected[7] = {0, 1, 9};
  EXPECT_EQ(file.read().positions, expected);
  file.json["accessors"][0].erase("sparse");
  EXPECT_EQ(file.read().positions, std::vector<glm::vec3>(8, glm::vec3(0)));
}

TEST(GltfSparse, IndicesMayBeSparse) {
  GltfBuilder file = indexed_cube();
  const std::vector<std::uint32_t> indices{0, 3};
  const std::vector<std::uint16_t> values{6, 5};
  file.json["accessors"][1]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", file.add_view(indices.data(), 8)}, {"componentType", 5125}}},
      {"values", {{"bufferView", file.add_view(values.data(), 4)}}}};
  const TriMesh mesh = file.read();
  EXPECT_EQ(mesh.triangles[0], (Triangle{6, 2, 1}));
  EXPECT_EQ(mesh.triangles[1], (Triangle{5, 1, 0}));
  EXPECT_EQ(mesh.triangles[2], cube_triangles()[2]);
}

TEST(GltfSparse, WrongOnes) {
  const auto bad = [](const auto& change, const std::string& part) {
    GltfBuilder file = sparse_cube();
    change(file.json["accessors"][0], file);
    EXPECT_INPUT_ERROR(file.read(), part);
  };
  bad([](Json& a, auto&) { a["sparse"]["count"] = 9; }, "accessors[0].sparse.count");
  bad([](Json& a, auto&) { a["sparse"]["count"] = 3; }, "past its buffer view's end");
  bad([](Json& a, auto&) { a["sparse"]["values"]["byteOffset"] = 4; },
      "accessors[0].sparse.values: is past");
  bad([](Json& a, auto&) { a["sparse"]["indices"]["componentType"] = 5120; },
      "expected unsigned whole numbers");
  bad([](Json& a, auto&) { a["sparse"].erase("values"); }, "has no \"values\"");
  const auto with_indices = [](std::uint8_t first, std::uint8_t second) {
    return [first, second](Json& a, GltfBuilder& file) {
      const std::uint8_t both[] = {first, second};
      a["sparse"]["indices"]["bufferView"] = file.add_view(both, 2);
    };
  };
  bad(with_indices(2, 8), "entry 1: element 8 does not exist; there are 8");
  bad(with_indices(7, 2), "entry 1: element 2 does not ascend");
  bad(with_indices(2, 2), "entry 1: element 2 does not ascend");
  // Zeros take no bytes; so many are not believed.
  bad(
      [](Json& a, auto&) {
        a.erase("bufferView"), a.erase("sparse");
        a["count"] = 4000000000u;
      },
      "would be");
  GltfBuilder file = sparse_cube();
  file.json["accessors"][0].erase("bufferView");
  file.json["accessors"][0]["count"] = 1000000;
  EXPECT_INPUT_ERROR(file.read(), "1000000 zeros stand for more than the file can hold");
}

// ---- meshoptimizer ----

// The view's bytes, packed; it takes the place of the view.
void pack_view(GltfBuilder& file, std::size_t view, const std::vector<unsigned char>& packed,
               Json extension) {
  const std::size_t own = file.add_view(packed.data(), packed.size());
  extension.update({{"buffer", 0},
                    {"byteOffset", file.json["bufferViews"][own]["byteOffset"]},
                    {"byteLength", packed.size()}});
  Json& out = file.json["bufferViews"][view];
  out["buffer"] = 1;  // which is not there: a fallback
  out["extensions"]["EXT_meshopt_compression"] = extension;
}

std::vector<unsigned char> encode_vertices(const std::string& bytes, std::size_t stride) {
  const std::size_t n = bytes.size() / stride;
  std::vector<unsigned char> out(meshopt_encodeVertexBufferBound(n, stride));
  out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), bytes.data(), n, stride));
  return out;
}

Json attributes_extension(std::size_t count, std::size_t stride) {
  return {{"count", count}, {"byteStride", stride}, {"mode", "ATTRIBUTES"}};
}

struct Packed {
  GltfBuilder file;
  TriMesh expected;
};

// The figure of n rings with positions and indices packed.
Packed packed_figure(std::uint32_t n, const std::string& mode, bool small_indices) {
  Packed out;
  out.expected = make_lumpy_figure(n);
  std::string bytes;
  for (const glm::vec3& p : out.expected.positions) append_vec3(bytes, p);
  std::vector<std::uint32_t> indices;
  for (const Triangle& t : out.expected.triangles)
    indices.insert(indices.end(), t.begin(), t.end());
  const std::size_t n_vertices = out.expected.positions.size(), n_indices = indices.size();
  GltfBuilder& file = out.file;
  file.json["bufferViews"] = Json::parse(R"([{}, {}])");
  file.json["accessors"] = {
      {{"bufferView", 0}, {"componentType", 5126}, {"count", n_vertices}, {"type", "VEC3"}},
      {{"bufferView", 1},
       {"componentType", small_indices ? 5123 : 5125},
       {"count", n_indices},
       {"type", "SCALAR"}}};
  pack_view(file, 0, encode_vertices(bytes, 12), attributes_extension(n_vertices, 12));
  std::vector<unsigned char> packed(mode == "TRIANGLES"
                                        ? meshopt_encodeIndexBufferBound(n_indices, n_vertices)
                                        : meshopt_encodeIndexSequenceBound(n_indices, n_vertices));
  packed.resize(
      mode == "TRIANGLES"
          ? meshopt_encodeIndexBuffer(packed.data(), packed.size(), indices.data(), n_indices)
          : meshopt_encodeIndexSequence(packed.data(), packed.size(), indices.data(), n_indices));
  pack_view(file, 1, packed,
            {{"count", n_indices}, {"byteStride", small_indices ? 2 : 4}, {"mode", mode}});
  file.json["buffers"] = Json::parse(
      R"([{}, {"byteLength": 1, "extensions": {"EXT_meshopt_compression": {"fallback": true}}}])");
  file.json["extensionsRequired"] = {"EXT_meshopt_compression"};
  file.json["nodes"] = Json::parse(R"([{"mesh": 0}])");
  file.attributes()["POSITION"] = 0;
  file.primitive()["indices"] = 1;
  return out;
}

// The encoder turns triangles so that another corner is first.
Triangle with_least_first(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

TEST(GltfMeshopt, EveryModeComesBack) {
  for (const char* mode : {"TRIANGLES", "INDICES"})
    for (const bool is_small : {false, true}) {
      SCOPED_TRACE(mode);
      const Packed packed = packed_figure(20, mode, is_small);
      const TriMesh mesh = packed.file.read();
      EXPECT_EQ(mesh.positions, packed.expected.positions);
      ASSERT_EQ(mesh.triangles.size(), packed.expected.triangles.size());
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        ASSERT_EQ(with_least_first(mesh.triangles[t]),
                  with_least_first(packed.expected.triangles[t]));
    }
}

// A triangle whose normals, or positions, go through a filter.
GltfBuilder filtered(const char* attribute, const std::string& bytes, std::size_t stride,
                     Json accessor, const char* filter) {
  GltfBuilder file = one_triangle();
  const std::size_t view = file.add_view(bytes.data(), bytes.size(), stride);
  accessor.update({{"bufferView", view}, {"count", 3}});
  file.attributes()[attribute] = GltfBuilder::append(file.json["accessors"], accessor);
  Json extension = attributes_extension(3, stride);
  extension["filter"] = filter;
  const std::string copy = bytes;
  pack_view(file, view, encode_vertices(copy, stride), extension);
  file.json["buffers"] = Json::parse(
      R"([{}, {"byteLength": 1, "extensions": {"EXT_meshopt_compression": {"fallback": true}}}])");
  return file;
}

TEST(GltfMeshopt, Filters) {
  const std::vector<glm::vec3> normals{
      {0, 0, 1}, {0.6f, 0, -0.8f}, glm::normalize(glm::vec3(-1, 2, 3))};
  std::vector<float> input;
  for (const glm::vec3& n : normals) input.insert(input.end(), {n.x, n.y, n.z, 0});
  for (const int bits : {8, 12}) {
    const std::size_t stride = bits == 8 ? 4 : 8;
    std::string bytes(3 * stride, '\0');
    meshopt_encodeFilterOct(bytes.data(), 3, stride, bits, input.data());
    const TriMesh mesh =
        filtered(
            "NORMAL", bytes, stride,
            {{"componentType", bits == 8 ? 5120 : 5122}, {"normalized", true}, {"type", "VEC3"}},
            "OCTAHEDRAL")
            .read();
    for (std::size_t v = 0; v < 3; ++v)
      EXPECT_NEAR(glm::distance(mesh.normals[v], normals[v]), 0, bits == 8 ? 0.02 : 0.002) << v;
  }
  const std::vector<float> positions{0, 0, 0, 1.25f, -7, 0, 1000, 0.125f, 3};
  std::string bytes(36, '\0');
  meshopt_encodeFilterExp(bytes.data(), 3, 12, 20, positions.data());
  const TriMesh mesh =
      filtered("POSITION", bytes, 12, {{"componentType", 5126}, {"type", "VEC3"}}, "EXPONENTIAL")
          .read();
  EXPECT_NEAR(glm::distance(mesh.positions[1], glm::vec3(1.25, -7, 0)), 0, 1e-4);
  EXPECT_NEAR(glm::distance(mesh.positions[2], glm::vec3(1000, 0.125, 3)), 0, 1e-2);
}

// Rotations of instances: the filter of quaternions.
TEST(GltfMeshopt, QuaternionsOfInstances) {
  GltfBuilder file = one_triangle();
  const std::vector<float> rotations{0, 0, 0, 1, 0, 0, 0.70710678f, 0.70710678f};
  std::string bytes(16, '\0');
  meshopt_encodeFilterQuat(bytes.data(), 2, 8, 16, rotations.data());
  const std::size_t view = file.add_view(bytes.data(), bytes.size());
  Json extension = attributes_extension(2, 8);
  extension["filter"] = "QUATERNION";
  pack_view(file, view, encode_vertices(bytes, 8), extension);
  file.json["buffers"] = Json::parse(
      R"([{}, {"byteLength": 1, "extensions": {"EXT_meshopt_compression": {"fallback": true}}}])");
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] =
      GltfBuilder::append(file.json["accessors"], {{"bufferView", view},
                                                   {"componentType", 5122},
                                                   {"normalized", true},
                                                   {"count", 2},
                                                   {"type", "VEC4"}});
  EXPECT_NEAR(glm::distance(file.read().positions[4], glm::vec3(0, 1, 0)), 0, 1e-3);
}

TEST(GltfMeshopt, WrongOnes) {
  const auto bad = [](const auto& change, const std::string& part) {
    GltfBuilder file = packed_figure(10, "TRIANGLES", false).file;
    const auto extension = [&](std::size_t view) -> Json& {
      return file.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
    };
    change(extension(0), extension(1));
    EXPECT_INPUT_ERROR(file.read(), part);
  };
  bad([](Json& v, Json&) { v["mode"] = "POINTS"; }, "'POINTS' is not ATTRIBUTES");
  bad([](Json& v, Json&) { v["byteStride"] = 10; }, "does not fit the mode ATTRIBUTES");
  bad([](Json& v, Json&) { v["byteStride"] = 260; }, "byteStride");
  bad([](Json&, Json& i) { i["byteStride"] = 3; }, "does not fit the mode TRIANGLES");
  bad([](Json&, Json& i) { i["count"] = 1000; }, "no multiple of 3");
  bad([](Json&, Json& i) { i["count"] = 3000000000u; }, "do not fit into");
  bad([](Json& v, Json&) { v["count"] = 4000000000u; }, "4000000000 elements do not fit into");
  bad([](Json& v, Json&) { v["filter"] = "COLOR"; }, "the filter COLOR is not read");
  bad([](Json& v, Json&) { v["filter"] = "QUATERNION"; }, "the filter QUATERNION is not read");
  bad([](Json& v, Json&) { v["byteLength"] = 40; }, "is damaged");
  bad([](Json& v, Json&) { v["byteLength"] = 4000000; }, "is past its buffer's end");
  bad([](Json& v, Json&) { v["buffer"] = 1; }, "is past its buffer's end");
  bad([](Json& v, Json&) { v["count"] = 100; }, "");  // fewer than the accessor's
}

// Streams of the next version, as newer encoders write them, are refused by what they are.
TEST(GltfMeshopt, LaterVersions) {
  GltfBuilder file = packed_figure(10, "TRIANGLES", false).file;
  const auto at = file.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteOffset"]
                      .get<std::size_t>();
  file.buffer[at] = static_cast<char>(file.buffer[at] | 1);
  EXPECT_INPUT_ERROR(file.read(), "is of a later version than is read");
}

// Many views of the same bytes: each decodes to 64 times them at most, all together to no more.
TEST(GltfMeshopt, ViewsOfTheSameBytes) {
  GltfBuilder file = packed_figure(10, "TRIANGLES", false).file;
  const std::size_t n = 300000;
  const Json view = [&] {
    pack_view(file, 0, encode_vertices(std::string(12 * n, '\0'), 12), attributes_extension(n, 12));
    return file.json["bufferViews"][0];
  }();
  file.json["accessors"][0]["count"] = n;
  for (int i = 0; i < 40; ++i) {
    const std::size_t id = GltfBuilder::append(file.json["bufferViews"], view);
    Json accessor = file.json["accessors"][0];
    accessor["bufferView"] = id;
    Json primitive = file.primitive();
    primitive["attributes"]["POSITION"] = GltfBuilder::append(file.json["accessors"], accessor);
    file.json["meshes"][0]["primitives"].push_back(primitive);
  }
  EXPECT_INPUT_ERROR(file.read(), "elements do not fit into");
}

// ---- Draco ----

std::string encode_draco(const TriMesh& mesh, int speed, bool is_sequential) {
  draco::Mesh out;
  const auto n = static_cast<std::uint32_t>(mesh.positions.size());
  out.set_num_points(n);
  const auto add = [&](draco::GeometryAttribute::Type type, std::int8_t n_components,
                       const auto& value) {
    draco::GeometryAttribute attribute;
    attribute.Init(type, nullptr, static_cast<std::uint8_t>(n_components), draco::DT_FLOAT32, false,
                   4 * n_components, 0);
    const int id = out.AddAttribute(attribute, true, n);
    for (std::uint32_t v = 0; v < n; ++v)
      out.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v), &value(v));
  };
  add(
      draco::GeometryAttribute::POSITION,
      3, [&](std::uint32_t v) -> const auto& { return mesh.positions[v]; });
  add(
      draco::GeometryAttribute::NORMAL,
      3, [&](std::uint32_t v) -> const auto& { return mesh.normals[v]; });
  for (const Triangle& t : mesh.triangles)
    out.AddFace({draco::PointIndex(t[0]), draco::PointIndex(t[1]), draco::PointIndex(t[2])});
  draco::Encoder encoder;
  encoder.SetSpeedOptions(speed, speed);
  encoder.SetEncodingMethod(is_sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                          : draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 16);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 12);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(out, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

GltfBuilder draco_file(const TriMesh& mesh, const std::string& packed) {
  GltfBuilder file;
  const std::size_t view = file.add_view(packed.data(), packed.size());
  file.json["accessors"] = {
      {{"componentType", 5126}, {"count", mesh.positions.size()}, {"type", "VEC3"}},
      {{"componentType", 5125}, {"count", 3 * mesh.triangles.size()}, {"type", "SCALAR"}}};
  file.attributes() = {{"POSITION", 0}, {"NORMAL", 0}};
  file.primitive()["indices"] = 1;
  file.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}};
  file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  file.json["nodes"] = Json::parse(R"([{"mesh": 0}])");
  return file;
}

TriMesh figure_with_normals(std::uint32_t n) {
  TriMesh mesh = make_lumpy_figure(n);
  mesh.normals = make_vertex_normals(mesh);
  return mesh;
}

// Draco numbers vertices and faces anew; the surface is the same.
void expect_same_surface(const TriMesh& a, const TriMesh& b) {
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  ASSERT_EQ(a.positions.size(), b.positions.size());
  const auto moments = [](const TriMesh& mesh) {
    double volume = 0;
    glm::dvec3 area(0);
    for (const Triangle& t : mesh.triangles) {
      const glm::dvec3 normal = area_normal(mesh, t);
      volume += glm::dot(glm::dvec3(mesh.positions[t[0]]), normal) / 6;
      area += glm::abs(normal);
    }
    return std::pair(volume, area);
  };
  EXPECT_NEAR(moments(a).first, moments(b).first, 1e-3 * std::abs(moments(b).first));
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(moments(a).second[k], moments(b).second[k], 1e-3 * moments(b).second[k]);
}

TEST(GltfDraco, EveryMethodComesBack) {
  const TriMesh mesh = figure_with_normals(16);
  for (const bool is_sequential : {false, true})
    for (const int speed : {0, 5, 10}) {
      SCOPED_TRACE(speed);
      const TriMesh back = draco_file(mesh, encode_draco(mesh, speed, is_sequential)).read();
      expect_same_surface(back, mesh);
      const std::vector<glm::vec3> own = make_vertex_normals(back);
      for (std::size_t v = 0; v < own.size(); ++v)
        ASSERT_GT(glm::dot(own[v], glm::normalize(back.normals[v])), 0.99f) << v;
    }
}

TEST(GltfDraco, WrongOnes) {
  const TriMesh mesh = figure_with_normals(10);
  const std::string packed = encode_draco(mesh, 5, false);
  const auto bad = [&](const auto& change, const std::string& part) {
    GltfBuilder file = draco_file(mesh, packed);
    change(file);
    EXPECT_INPUT_ERROR(file.read(nullptr, {.max_triangles = 10000}), part);
  };
  const auto extension = [](GltfBuilder& file) -> Json& {
    return file.primitive()["extensions"]["KHR_draco_mesh_compression"];
  };
  bad([](GltfBuilder& f) { f.json["accessors"][1]["count"] = 30; },
      "holds 360 triangles, not the 10 that its accessors say");
  bad([](GltfBuilder& f) { f.json["accessors"][0]["count"] = 181; }, "holds 182 vertices");
  bad([&](GltfBuilder& f) { extension(f)["attributes"]["NORMAL"] = 7; }, "has no attribute 7");
  bad([](GltfBuilder& f) { f.json["accessors"][0]["type"] = "VEC2"; },
      "has 3 components of NORMAL, its accessor 2");
  bad([](GltfBuilder& f) { f.primitive()["mode"] = 5; }, "is read as 4 (triangles) alone");
  bad([](GltfBuilder& f) { f.buffer[0] = 'X'; }, "has no header of Draco");
  bad([](GltfBuilder& f) { f.buffer[5] = 9; }, "is of Draco's version 9.2");
  bad([](GltfBuilder& f) { f.json["bufferViews"][0]["byteLength"] = 12; }, "ends in its header");
  bad([](GltfBuilder& f) { f.json["bufferViews"][0]["byteLength"] = 100; },
      "Draco cannot decode it");
  bad([](GltfBuilder& f) { f.primitive().erase("indices"); }, "has no \"indices\"");
  // What the bytes can hardly hold is refused before Draco sees them.
  GltfBuilder file = draco_file(mesh, packed);
  file.json["accessors"][1]["count"] = 3 * 100000;
  EXPECT_INPUT_ERROR(file.read(), "would be 100000 triangles; at most");
}

TEST(GltfPacked, DamagedFilesNeverCrash) {
  const TriMesh mesh = figure_with_normals(10);
  const auto read = [](const std::string& damaged) {
    check_mesh(parse_gltf(damaged, "m.glb"), "m.glb");
  };
  for (const bool is_sequential : {false, true}) {
    const GltfBuilder file = draco_file(mesh, encode_draco(mesh, 5, is_sequential));
    read_damaged_copies(file.bytes(), 300, 11, read);  // a process each
  }
  read_damaged_copies(packed_figure(10, "TRIANGLES", true).file.bytes(), 1500, 12, read);
  read_damaged_copies(packed_figure(10, "INDICES", false).file.bytes(), 1500, 13, read);
  read_damaged_copies(sparse_cube().bytes(), 1500, 14, read);
}

}  // namespace
}  // namespace viewcell

#include "gltf_seeds.h"

#include <draco/compression/encode.h>
#include <draco/core/encoder_buffer.h>
#include <draco/mesh/mesh.h>
#include <meshoptimizer.h>

#include <stdexcept>

#include "formats/gltf_builder.h"
#include "image/io.h"

namespace viewcell {
namespace {

constexpr const char* kMeshopt = "EXT_meshopt_compression";

Json& extension(Json& of, const char* name) {
  return of["extensions"][name];
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      bits = bits << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

// Normals, colours, two sets of texture coordinates, and a material that moves them.
GltfBuilder rich_cube() {
  GltfBuilder file = indexed_cube();
  const std::vector<float> up(24, 0.57735f);
  const std::vector<std::uint8_t> bytes(32, 128);
  file.attributes()["NORMAL"] = file.add(up, "VEC3");
  file.attributes()["COLOR_0"] = file.add(bytes, "VEC4", true);
  file.attributes()["TEXCOORD_0"] = file.add(std::vector<float>(16, 0.25f), "VEC2");
  file.attributes()["TEXCOORD_1"] = file.add(std::vector<std::uint16_t>(16, 999), "VEC2", true);
  Json& texture = file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  texture = {{"index", 0}, {"texCoord", 0}};
  extension(texture, "KHR_texture_transform") = {
      {"offset", {0.5, 0.25}}, {"scale", {2, 3}}, {"rotation", 0.5}, {"texCoord", 1}};
  file.json["materials"][0]["name"] = "clay";
  file.json["textures"] = {{{"source", 0}}};
  file.json["images"] = {
      {{"uri", "data:image/png;base64," + base64(encode_png(ImageRgba8(2, 2)))}}};
  file.primitive()["material"] = 0;
  return file;
}

GltfBuilder posed_cube() {
  GltfBuilder file = indexed_cube();
  const std::size_t moved = file.add(std::vector<float>(24, 0.5f), "VEC3");
  file.primitive()["targets"] = {{{"POSITION", moved}}};
  file.json["meshes"][0]["weights"] = {0.5};
  file.attributes()["JOINTS_0"] = file.add(std::vector<std::uint8_t>(32, 0), "VEC4");
  file.attributes()["WEIGHTS_0"] = file.add(std::vector<float>(32, 0.25f), "VEC4");
  std::vector<float> one(16, 0.0f);
  for (std::size_t i = 0; i < 16; i += 5) one[i] = 1;
  file.json["skins"] = {{{"joints", {1, 1}}, {"inverseBindMatrices", file.add(one, "MAT4")}}};
  file.json["skins"][0]["joints"] = {1};
  file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"weights", {0.25}}},
                        {{"translation", {1, 2, 3}}, {"scale", {2, 2, 2}}, {"children", {0}}},
                        {{"matrix", one}, {"rotation", {0, 0, 0, 1}}}};
  file.json["scenes"] = {{{"nodes", {1, 2}}}};
  file.json["scene"] = 0;
  return file;
}

GltfBuilder instanced_triangles() {
  GltfBuilder file = one_triangle();
  Json& at = extension(file.json["nodes"][0], "EXT_mesh_gpu_instancing")["attributes"];
  at["TRANSLATION"] = file.add(std::vector<float>{0, 0, 0, 5, 5, 5}, "VEC3");
  at["ROTATION"] = file.add(std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, 90, 90}, "VEC4", true);
  at["SCALE"] = file.add(std::vector<float>{1, 1, 1, 2, 2, 2}, "VEC3");
  file.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  return file;
}

GltfBuilder sparse_strip() {
  GltfBuilder file = indexed_cube();
  const std::uint8_t places[] = {2, 7};
  const float values[] = {5, 5, 5, 0, 1, 9};
  file.json["accessors"][0]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", file.add_view(places, 2)}, {"componentType", 5121}}},
      {"values", {{"bufferView", file.add_view(values, sizeof values)}}}};
  file.primitive()["mode"] = 5;
  return file;
}

// Positions and indices as meshoptimizer packs them.
GltfBuilder meshopt_cube() {
  GltfBuilder file = indexed_cube();
  std::vector<unsigned char> vertices(meshopt_encodeVertexBufferBound(8, 12));
  vertices.resize(
      meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), file.buffer.data(), 8, 12));
  std::vector<std::uint32_t> corners;
  for (const Triangle& t : cube_triangles()) corners.insert(corners.end(), t.begin(), t.end());
  std::vector<unsigned char> indices(meshopt_encodeIndexBufferBound(36, 8));
  indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), corners.data(), 36));
  const auto pack = [&](std::size_t view, const std::vector<unsigned char>& packed, Json more) {
    const std::size_t own = file.add_view(packed.data(), packed.size());
    more.update({{"buffer", 0},
                 {"byteOffset", file.json["bufferViews"][own]["byteOffset"]},
                 {"byteLength", packed.size()}});
    file.json["bufferViews"][view]["buffer"] = 1;
    extension(file.json["bufferViews"][view], kMeshopt) = more;
  };
  pack(0, vertices,
       {{"count", 8}, {"byteStride", 12}, {"mode", "ATTRIBUTES"}, {"filter", "EXPONENTIAL"}});
  pack(1, indices, {{"count", 36}, {"byteStride", 2}, {"mode", "TRIANGLES"}});
  file.json["buffers"] = Json::parse(
      R"([{}, {"byteLength": 168, "extensions": {"EXT_meshopt_compression": {"fallback": true}}}])");
  file.json["extensionsRequired"] = {kMeshopt};
  return file;
}

std::string encode_draco(bool is_sequential) {
  draco::Mesh out;
  out.set_num_points(8);
  draco::GeometryAttribute attribute;
  attribute.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  const int id = out.AddAttribute(attribute, true, 8);
  for (std::uint32_t v = 0; v < 8; ++v)
    out.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v), &cube_positions()[v]);
  for (const Triangle& t : cube_triangles())
    out.AddFace({draco::PointIndex(t[0]), draco::PointIndex(t[1]), draco::PointIndex(t[2])});
  draco::Encoder encoder;
  encoder.SetEncodingMethod(is_sequential ? draco::MESH_SEQUENTIAL_ENCODING
                                          : draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 11);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(out, &buffer).ok()) throw std::runtime_error("Draco fails");
  return {buffer.data(), buffer.size()};
}

GltfBuilder draco_cube(const std::string& packed) {
  GltfBuilder file;
  const std::size_t view = file.add_view(packed.data(), packed.size());
  file.json["accessors"] = {{{"componentType", 5126}, {"count", 8}, {"type", "VEC3"}},
                            {{"componentType", 5125}, {"count", 36}, {"type", "SCALAR"}}};
  file.attributes() = {{"POSITION", 0}};
  file.primitive()["indices"] = 1;
  extension(file.primitive(), "KHR_draco_mesh_compression") = {{"bufferView", view},
                                                               {"attributes", {{"POSITION", 0}}}};
  file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  file.json["nodes"] = Json::parse(R"([{"mesh": 0}])");
  return file;
}

}  // namespace

void add_gltf_files(const Seeds& seeds) {
  const std::pair<const char*, GltfBuilder> files[] = {
      {"cube", indexed_cube()},   {"rich", rich_cube()},
      {"posed", posed_cube()},    {"instanced", instanced_triangles()},
      {"sparse", sparse_strip()}, {"meshopt", meshopt_cube()}};
  for (const auto& [name, file] : files) {
    seeds.add("glb", name, file.bytes());
    seeds.add("texture", name, file.bytes());
  }
  seeds.add("glb", "text",
            cube_gltf_json(R"([{"mesh": 0}])",
                           R"("uri": "data:;base64,)" + base64(cube_buffer()) + R"(", )"));
  for (const bool is_sequential : {false, true}) {
    const std::string packed = encode_draco(is_sequential), name = is_sequential ? "flat" : "edges";
    std::string input;
    append_value<std::uint32_t>(input, 8), append_value<std::uint32_t>(input, 12);
    seeds.add("draco", name, input + packed);
    seeds.add("glb", "draco-" + name, draco_cube(packed).bytes());
  }
}

}  // namespace viewcell

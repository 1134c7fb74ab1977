// The unit cube in every format: eight corners, six squares (or twelve triangles).
#pragma once

#include <array>
#include <cstring>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

//    3-------2
//   /|      /|     outward and counter-clockwise
//  7-------6 |
//  | 0-----|-1
//  4-------5
inline std::vector<glm::vec3> cube_positions() {
  return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
}
inline std::vector<std::array<int, 4>> cube_squares() {
  return {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
}
inline std::vector<Triangle> cube_triangles() {
  std::vector<Triangle> out;
  for (const auto& s : cube_squares()) {
    const auto v = [&s](std::size_t k) { return static_cast<std::uint32_t>(s[k]); };
    out.push_back({v(0), v(1), v(2)});
    out.push_back({v(0), v(2), v(3)});
  }
  return out;
}

inline TriMesh make_mesh(std::vector<glm::vec3> positions, std::vector<Triangle> triangles) {
  TriMesh mesh;
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(triangles);
  return mesh;
}
inline TriMesh make_cube() {
  return make_mesh(cube_positions(), cube_triangles());
}

inline std::string number_text(float x) {
  return std::to_string(static_cast<int>(x));
}
inline std::string vec3_text(const glm::vec3& p) {
  return number_text(p.x) + " " + number_text(p.y) + " " + number_text(p.z);
}

inline std::string cube_off() {
  std::string out = "OFF\n8 6 0\n";
  for (const auto& p : cube_positions()) out += vec3_text(p) + "\n";
  for (const auto& s : cube_squares()) {
    out += "4";
    for (const int v : s) out += " " + std::to_string(v);
    out += "\n";
  }
  return out;
}

inline std::string cube_obj() {
  std::string out = "# a cube\nmtllib cube.mtl\n";
  for (const auto& p : cube_positions()) out += "v " + vec3_text(p) + "\n";
  out += "usemtl stone\n";
  for (const auto& s : cube_squares()) {
    out += "f";
    for (const int v : s) out += " " + std::to_string(v + 1);
    out += "\n";
  }
  return out;
}

inline std::string cube_ply() {
  std::string out =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
      "property float z\nelement face 6\nproperty list uchar int vertex_index\nend_header\n";
  const std::string off = cube_off();
  return out + off.substr(off.find("0 0 0"));
}

inline std::string cube_stl_text() {
  std::string out = "solid cube\n";
  for (const Triangle& t : cube_triangles()) {
    out += "facet normal 0 0 0\nouter loop\n";
    for (const auto v : t) out += "vertex " + vec3_text(cube_positions()[v]) + "\n";
    out += "endloop\nendfacet\n";
  }
  return out + "endsolid cube\n";
}

template <typename T>
void append_value(std::string& out, T value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}
inline void append_vec3(std::string& out, const glm::vec3& p) {
  for (int k = 0; k < 3; ++k) append_value(out, p[k]);
}

inline std::string cube_stl_binary() {
  std::string out = "solid, and yet binary";
  out.resize(80, ' ');
  append_value<std::uint32_t>(out, 12);
  for (const Triangle& t : cube_triangles()) {
    append_vec3(out, glm::vec3(0));
    for (const auto v : t) append_vec3(out, cube_positions()[v]);
    append_value<std::uint16_t>(out, 0);
  }
  return out;
}

inline std::string chunk_3ds(std::uint16_t id, const std::string& content) {
  std::string out;
  append_value(out, id);
  append_value(out, static_cast<std::uint32_t>(6 + content.size()));
  return out + content;
}
/// One object, as chunk 0x4000; faces carry `more` (sub-chunks of the face list).
inline std::string cube_3ds_object(const std::string& more = "") {
  std::string vertices, faces;
  append_value<std::uint16_t>(vertices, 8);
  for (const auto& p : cube_positions()) append_vec3(vertices, p);
  append_value<std::uint16_t>(faces, 12);
  for (const Triangle& t : cube_triangles()) {
    for (const auto v : t) append_value(faces, static_cast<std::uint16_t>(v));
    append_value<std::uint16_t>(faces, 7);
  }
  return chunk_3ds(
      0x4000, std::string("cube\0", 5) +
                  chunk_3ds(0x4100, chunk_3ds(0x4110, vertices) + chunk_3ds(0x4120, faces + more)));
}
inline std::string cube_3ds(const std::string& objects = cube_3ds_object()) {
  return chunk_3ds(0x4d4d, chunk_3ds(0x0002, "vers") + chunk_3ds(0x3d3d, objects));
}

/// The cube's positions (float) and indices (uint16): the bytes of a glTF buffer.
inline std::string cube_buffer() {
  std::string out;
  for (const auto& p : cube_positions()) append_vec3(out, p);
  for (const Triangle& t : cube_triangles())
    for (const auto v : t) append_value(out, static_cast<std::uint16_t>(v));
  return out;
}
/// glTF JSON around cube_buffer(); nodes and more are put in as they are.
inline std::string cube_gltf_json(const std::string& nodes = R"([{"mesh": 0}])",
                                  const std::string& buffer = "", const std::string& more = "") {
  return R"({"asset": {"version": "2.0"}, "buffers": [{)" + buffer +
         R"("byteLength": 168}],
    "bufferViews": [{"buffer": 0, "byteLength": 96},
                    {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], )" +
         more + R"("nodes": )" + nodes + "}";
}
inline std::string make_glb(std::string json, const std::string& binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string out = "glTF";
  append_value<std::uint32_t>(out, 2);
  append_value(out, static_cast<std::uint32_t>(28 + json.size() + binary.size()));
  append_value(out, static_cast<std::uint32_t>(json.size()));
  append_value<std::uint32_t>(out, 0x4e4f534a);
  out += json;
  append_value(out, static_cast<std::uint32_t>(binary.size()));
  append_value<std::uint32_t>(out, 0x004e4942);
  return out + binary;
}
inline std::string cube_glb() {
  return make_glb(cube_gltf_json(), cube_buffer());
}

}  // namespace viewcell

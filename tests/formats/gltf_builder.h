// glTF files as tests put them together, part by part.
#pragma once

#include <type_traits>
#include <vector>

#include "base/json.h"
#include "formats/readers.h"
#include "mesh/cube.h"

namespace viewcell {

/// Arrays go into the buffer as accessors; `json` is the rest, to be changed at will.
struct GltfBuilder {
  Json json{{"asset", {{"version", "2.0"}}}};
  std::string buffer;

  std::size_t add_view(const void* data, std::size_t n_bytes, std::size_t stride = 0) {
    buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
    Json view{{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", n_bytes}};
    if (stride > 0) view["byteStride"] = stride;
    buffer.append(static_cast<const char*>(data), n_bytes);
    return append(json["bufferViews"], view);
  }

  /// numbers: those of all elements, one after another; type: "VEC3".
  template <typename T>
  std::size_t add(const std::vector<T>& numbers, const std::string& type, bool normalized = false) {
    Json accessor{{"bufferView", add_view(numbers.data(), numbers.size() * sizeof(T))},
                  {"componentType", component_type<T>()},
                  {"count", numbers.size() / n_components(type)},
                  {"type", type}};
    if (normalized) accessor["normalized"] = true;
    return append(json["accessors"], accessor);
  }

  std::string bytes() const {
    Json out = json;
    if (!buffer.empty()) out["buffers"][0]["byteLength"] = buffer.size();
    return make_glb(out.dump(), buffer);
  }
  TriMesh read(Remarks* remarks = nullptr, const MeshLimits& limits = {}) const {
    return parse_gltf(bytes(), "m.glb", remarks, limits);
  }

  Json& primitive() { return json["meshes"][0]["primitives"][0]; }
  Json& attributes() { return primitive()["attributes"]; }

  static std::size_t append(Json& array, const Json& value) {
    array.push_back(value);
    return array.size() - 1;
  }
  template <typename T>
  static int component_type() {
    if (std::is_same_v<T, float>) return 5126;
    const int by_size = sizeof(T) == 1 ? 5120 : sizeof(T) == 2 ? 5122 : 5124;
    return by_size + (std::is_signed_v<T> ? 0 : 1);
  }
  static std::size_t n_components(const std::string& type) {
    return type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<std::size_t>(type[3] - '0');
  }
};

/// The triangle (0, 0, 0), (1, 0, 0), (0, 1, 0) as accessor 0, under node 0.
inline GltfBuilder one_triangle() {
  GltfBuilder out;
  out.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  out.attributes()["POSITION"] = 0;
  out.json["nodes"] = Json::parse(R"([{"mesh": 0}])");
  return out;
}

/// The cube's eight corners and twelve triangles, likewise; accessor 1 are the indices.
inline GltfBuilder indexed_cube() {
  GltfBuilder out;
  std::vector<float> numbers;
  for (const glm::vec3& p : cube_positions()) numbers.insert(numbers.end(), {p.x, p.y, p.z});
  out.add(numbers, "VEC3");
  std::vector<std::uint16_t> indices;
  for (const Triangle& t : cube_triangles())
    for (const std::uint32_t v : t) indices.push_back(static_cast<std::uint16_t>(v));
  out.add(indices, "SCALAR");
  out.attributes()["POSITION"] = 0;
  out.primitive()["indices"] = 1;
  out.json["nodes"] = Json::parse(R"([{"mesh": 0}])");
  return out;
}

/// How often the remark was made; 0: it was not.
inline std::size_t count_said(const Remarks& remarks, const std::string& part) {
  for (const Remark& remark : remarks)
    if (remark.what.find(part) != std::string::npos) return remark.count;
  return 0;
}

}  // namespace viewcell

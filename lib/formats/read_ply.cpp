// PLY documents as triangle meshes, both ways.
#include <algorithm>

#include "base/file.h"
#include "base/srgb.h"
#include "formats/mesh_file.h"
#include "formats/ply.h"
#include "formats/readers.h"

namespace viewcell {
namespace {

const char* first_property(const PlyDocument& ply, const char* element,
                           std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (ply.has(element, name)) return name;
  return nullptr;
}

bool has_all(const PlyDocument& ply, std::initializer_list<const char*> properties) {
  return std::all_of(properties.begin(), properties.end(),
                     [&](const char* name) { return ply.has("vertex", name); });
}

// Integers span 0 to 255, floats 0 to 1.
std::vector<glm::vec3> read_colors(const PlyDocument& ply) {
  std::vector<glm::vec3> colors = ply.vec3s("vertex", "red", "green", "blue");
  const bool is_float = ply.column("vertex", "red").type() >= PlyType::kFloat;
  for (glm::vec3& color : colors)
    for (int k = 0; k < 3; ++k) color[k] = srgb_decode(is_float ? color[k] : color[k] / 255);
  return colors;
}

// Cuts the lists of vertices into fans.
std::vector<Triangle> read_triangles(const PlyDocument& ply, const PlyColumn& faces,
                                     std::size_t n_vertices) {
  const std::vector<std::uint32_t> indices = ply.list_indices("face", faces.name, n_vertices);
  std::vector<Triangle> triangles;
  triangles.reserve(faces.starts.size() - 1);
  for (std::size_t f = 0; f + 1 < faces.starts.size(); ++f) {
    const std::span polygon(indices.data() + faces.starts[f], indices.data() + faces.starts[f + 1]);
    if (polygon.size() < 3)
      throw InputError(ply.file, "face " + std::to_string(f), "has fewer than three vertices");
    append_fan(polygon, triangles);
  }
  return triangles;
}

// MeshLab's list of (s, t) pairs, one a corner of the polygon.
std::vector<glm::vec2> read_corner_texcoords(const PlyDocument& ply, const PlyColumn& faces) {
  const PlyColumn& lists = ply.column("face", "texcoord");
  const auto* values = std::get_if<std::vector<float>>(&lists.values);
  if (!lists.is_list || !values) return {};
  std::vector<glm::vec2> out;
  for (std::size_t f = 0; f + 1 < faces.starts.size(); ++f) {
    const std::size_t n_corners = faces.starts[f + 1] - faces.starts[f];
    if (lists.starts[f + 1] - lists.starts[f] != 2 * n_corners)
      throw InputError(ply.file, "face " + std::to_string(f),
                       "has not two texture coordinates a vertex");
    const float* first = values->data() + lists.starts[f];
    for (std::size_t k = 1; k + 1 < n_corners; ++k)
      for (const std::size_t corner : {std::size_t{0}, k, k + 1})
        out.emplace_back(first[2 * corner], first[2 * corner + 1]);
  }
  return out;
}

std::vector<glm::vec2> read_vertex_texcoords(const PlyDocument& ply, const char* s, const char* t,
                                             const std::vector<Triangle>& triangles) {
  const std::vector<float> us = ply.floats("vertex", s), vs = ply.floats("vertex", t);
  std::vector<glm::vec2> out;
  out.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t v : triangle) out.emplace_back(us[v], vs[v]);
  return out;
}

std::vector<glm::vec2> read_texcoords(const PlyDocument& ply, const PlyColumn& faces,
                                      const std::vector<Triangle>& triangles) {
  if (ply.has("face", "texcoord")) return read_corner_texcoords(ply, faces);
  static constexpr const char* kPairs[][2] = {
      {"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}};
  for (const auto& [s, t] : kPairs)
    if (has_all(ply, {s, t})) return read_vertex_texcoords(ply, s, t, triangles);
  return {};
}

}  // namespace

TriMesh parse_ply_mesh(std::string_view bytes, const std::filesystem::path& file, Remarks*) {
  const PlyDocument ply = parse_ply(bytes, file.string());
  if (!ply.find("face") && ply.find("tristrips"))
    throw InputError(ply.file, "header", "holds triangle strips; only faces are read");
  const char* indices = first_property(ply, "face", {"vertex_indices", "vertex_index"});
  if (!indices || ply.element("face").count == 0) throw InputError(ply.file, "", "has no faces");
  const PlyColumn& faces = ply.column("face", indices);

  TriMesh mesh;
  mesh.positions = ply.vec3s("vertex", "x", "y", "z");
  if (has_all(ply, {"nx", "ny", "nz"})) mesh.normals = ply.vec3s("vertex", "nx", "ny", "nz");
  if (has_all(ply, {"red", "green", "blue"})) mesh.colors = read_colors(ply);
  mesh.triangles = read_triangles(ply, faces, mesh.positions.size());
  mesh.texcoords = read_texcoords(ply, faces, mesh.triangles);
  return mesh;
}

namespace {

// The list that MeshLab writes and reads: u, v of each corner.
void add_corner_texcoords(PlyElement& faces, const std::vector<glm::vec2>& texcoords) {
  VIEWCELL_CHECK(texcoords.size() == 3 * faces.count, texcoords.size(), faces.count);
  PlyColumn column;
  column.name = "texcoord";
  column.is_list = true;
  std::vector<float> values;
  values.reserve(2 * texcoords.size());
  for (const glm::vec2& uv : texcoords) values.insert(values.end(), {uv.x, uv.y});
  column.values = std::move(values);
  for (std::uint64_t row = 0; row <= faces.count; ++row) column.starts.push_back(6 * row);
  faces.columns.push_back(std::move(column));
}

}  // namespace

void write_ply(const std::filesystem::path& file, const TriMesh& mesh,
               const std::vector<std::string>& comments) {
  PlyDocument ply;
  ply.comments = comments;
  PlyElement vertices{"vertex", mesh.positions.size(), {}};
  add_vec3s(vertices, {"x", "y", "z"}, mesh.positions);
  if (!mesh.normals.empty()) add_vec3s(vertices, {"nx", "ny", "nz"}, mesh.normals);
  if (!mesh.colors.empty()) {
    int channel = 0;
    for (const char* name : {"red", "green", "blue"}) {
      std::vector<std::uint8_t> values(mesh.colors.size());
      for (std::size_t v = 0; v < values.size(); ++v)
        values[v] = srgb8_from_linear(mesh.colors[v][channel]);
      add_column(vertices, name, std::move(values));
      ++channel;
    }
  }
  PlyElement faces{"face", mesh.triangles.size(), {}};
  add_triangles(faces, "vertex_indices", mesh.triangles);
  if (!mesh.texcoords.empty()) add_corner_texcoords(faces, mesh.texcoords);
  ply.elements = {std::move(vertices), std::move(faces)};
  write_file(file, format_ply(ply));
}

}  // namespace viewcell

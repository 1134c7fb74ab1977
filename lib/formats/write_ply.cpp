// Triangle meshes as PLY documents.
#include "base/file.h"
#include "base/srgb.h"
#include "formats/format_number.h"
#include "formats/mesh_file.h"
#include "formats/ply.h"
#include "formats/split_normals.h"

namespace viewcell {
namespace {

// Floats; about an offset where the vertices are, as doubles.
void add_coordinates(PlyElement& vertices, const TriMesh& mesh) {
  if (mesh.offset == glm::dvec3(0)) return add_vec3s(vertices, {"x", "y", "z"}, mesh.positions);
  for (int k = 0; k < 3; ++k) {
    std::vector<double> values(mesh.positions.size());
    for (std::size_t v = 0; v < values.size(); ++v) values[v] = place_of(mesh, v)[k];
    const char* names[] = {"x", "y", "z"};
    add_column(vertices, names[k], std::move(values));
  }
}

void add_colors(PlyElement& vertices, const std::vector<glm::vec3>& colors) {
  int channel = 0;
  for (const char* name : {"red", "green", "blue"}) {
    std::vector<std::uint8_t> values(colors.size());
    for (std::size_t v = 0; v < values.size(); ++v)
      values[v] = srgb8_from_linear(colors[v][channel]);
    add_column(vertices, name, std::move(values));
    ++channel;
  }
}

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

PlyElement make_vertices(const TriMesh& mesh) {
  PlyElement vertices{"vertex", mesh.positions.size(), {}};
  add_coordinates(vertices, mesh);
  if (!mesh.normals.empty()) add_vec3s(vertices, {"nx", "ny", "nz"}, mesh.normals);
  return vertices;
}

std::vector<std::string> offset_comments(const TriMesh& mesh) {
  if (mesh.offset == glm::dvec3(0)) return {};
  return {"offset " + format_offset(mesh.offset, " ")};
}

void write_ply(const std::filesystem::path& file, const TriMesh& mesh,
               const std::vector<std::string>& comments, Remarks* remarks) {
  add_remark(remarks, "materials, which a PLY does not hold, left out", mesh.material_names.size());
  if (!mesh.corner_normals.empty()) {
    std::vector<std::string> more = comments;
    const NormalSplit split = split_by_normals(mesh, remarks);
    more.push_back(std::to_string(split.source.size() - mesh.positions.size()) +
                   " vertices added at the end, where normals of corners differ");
    return write_ply(file, split.mesh, more);
  }
  PlyDocument ply;
  ply.comments = comments;
  for (const std::string& comment : offset_comments(mesh)) ply.comments.push_back(comment);
  PlyElement vertices = make_vertices(mesh);
  if (!mesh.colors.empty()) add_colors(vertices, mesh.colors);
  PlyElement faces{"face", mesh.triangles.size(), {}};
  add_triangles(faces, "vertex_indices", mesh.triangles);
  if (!mesh.texcoords.empty()) add_corner_texcoords(faces, mesh.texcoords);
  ply.elements = {std::move(vertices), std::move(faces)};
  write_file(file, format_ply(ply));
}

}  // namespace viewcell

#include <array>
#include <bit>
#include <map>

#include "base/file.h"
#include "base/srgb.h"
#include "formats/format_number.h"
#include "formats/mesh_file.h"

namespace viewcell {
namespace {

template <typename Vector>
void append_vectors(std::string& out, const char* keyword, const std::vector<Vector>& values) {
  for (const Vector& value : values) {
    out += keyword;
    for (int k = 0; k < Vector::length(); ++k) append_number(out, value[k]);
    out += '\n';
  }
}

void append_line(std::string& out, const std::string& keyword, std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  out += keyword + " " + text + "\n";
}

// sRGB; of a byte that reads back to the same colour, its 255th.
float encode_channel(float linear) {
  const float byte = static_cast<float>(srgb8_from_linear(linear)) / 255;
  return srgb_decode(byte) == linear ? byte : srgb_encode(linear);
}

void append_vertices(std::string& out, const TriMesh& mesh) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    out += 'v';
    append_place(out, mesh, v);
    if (!mesh.colors.empty())
      for (int k = 0; k < 3; ++k) append_number(out, encode_channel(mesh.colors[v][k]));
    out += '\n';
  }
}

// Each value once, in the order of the corners; place: per corner, from 1.
template <typename Vector>
struct SharedValues {
  std::vector<Vector> values;
  std::vector<std::size_t> place;
};

template <typename Vector>
SharedValues<Vector> share_values(const std::vector<Vector>& corners) {
  SharedValues<Vector> out;
  std::map<std::array<std::uint32_t, Vector::length()>, std::size_t> places;  // bits
  for (const Vector& value : corners) {
    std::array<std::uint32_t, Vector::length()> key;
    for (int k = 0; k < Vector::length(); ++k)
      key[static_cast<std::size_t>(k)] = std::bit_cast<std::uint32_t>(value[k]);
    const auto [found, is_new] = places.try_emplace(key, places.size() + 1);
    if (is_new) out.values.push_back(value);
    out.place.push_back(found->second);
  }
  return out;
}

// Numbers from 1 of what corners name, 0 for nothing: "p", "p/t", "p//n" or "p/t/n".
void append_corner(std::string& out, std::size_t vertex, std::size_t texcoord, std::size_t normal) {
  out += ' ' + std::to_string(vertex);
  if (texcoord > 0) out += '/' + std::to_string(texcoord);
  if (normal > 0) out += (texcoord > 0 ? "/" : "//") + std::to_string(normal);
}

void append_faces(std::string& out, const TriMesh& mesh, const SharedValues<glm::vec2>& texcoords,
                  const SharedValues<glm::vec3>& normals) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!mesh.materials.empty() && (t == 0 || mesh.materials[t] != mesh.materials[t - 1]))
      append_line(out, "usemtl",
                  mesh.material_names.at(static_cast<std::size_t>(mesh.materials[t])));
    out += 'f';
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t vertex = mesh.triangles[t][k] + std::size_t{1};
      const std::size_t own = mesh.normals.empty() ? 0 : vertex;
      append_corner(out, vertex, texcoords.place.empty() ? 0 : texcoords.place[3 * t + k],
                    normals.place.empty() ? own : normals.place[3 * t + k]);
    }
    out += '\n';
  }
}

}  // namespace

void write_obj(const std::filesystem::path& file, const TriMesh& mesh, const ObjOptions& options) {
  const SharedValues<glm::vec2> texcoords = share_values(mesh.texcoords);
  std::vector<glm::vec3> corner_normals = mesh.corner_normals;
  for (glm::vec3& normal : corner_normals) normal += 0.0f;  // -0 is 0: equal ones are written once
  const SharedValues<glm::vec3> normals = share_values(corner_normals);
  std::string out;
  for (const std::string& comment : options.comments) append_line(out, "#", comment);
  if (!options.material_library.empty())
    append_line(out, "mtllib", options.material_library);
  else
    for (const std::string& names : mesh.material_libraries) append_line(out, "mtllib", names);
  append_vertices(out, mesh);
  append_vectors(out, "vt", texcoords.values);
  append_vectors(out, "vn", mesh.normals);
  append_vectors(out, "vn", normals.values);
  if (mesh.materials.empty() && !options.material.empty())
    append_line(out, "usemtl", options.material);
  append_faces(out, mesh, texcoords, normals);
  write_file(file, out);
}

}  // namespace viewcell

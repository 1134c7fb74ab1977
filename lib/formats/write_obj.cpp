#include <bit>
#include <charconv>
#include <unordered_map>

#include "base/file.h"
#include "formats/mesh_file.h"

namespace viewcell {
namespace {

void append_number(std::string& out, float x) {
  char digits[32];
  out += ' ';
  out.append(digits, std::to_chars(digits, digits + sizeof digits, x).ptr);
}

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

// Each value once, in the order of the corners; place: per corner, from 1.
struct SharedTexcoords {
  std::vector<glm::vec2> values;
  std::vector<std::size_t> place;
};

SharedTexcoords share_texcoords(const std::vector<glm::vec2>& corners) {
  SharedTexcoords out;
  std::unordered_map<std::uint64_t, std::size_t> places;
  for (const glm::vec2& uv : corners) {
    const std::uint64_t bits = std::uint64_t{std::bit_cast<std::uint32_t>(uv.x)} << 32 |
                               std::bit_cast<std::uint32_t>(uv.y);
    const auto [found, is_new] = places.try_emplace(bits, places.size() + 1);
    if (is_new) out.values.push_back(uv);
    out.place.push_back(found->second);
  }
  return out;
}

// "p", "p/t", "p//n" or "p/t/n", from 1.
void append_corner(std::string& out, std::size_t vertex, const std::size_t* texcoord,
                   bool has_normal) {
  out += ' ' + std::to_string(vertex + 1);
  if (texcoord) out += '/' + std::to_string(*texcoord);
  if (has_normal) out += (texcoord ? "/" : "//") + std::to_string(vertex + 1);
}

void append_faces(std::string& out, const TriMesh& mesh, const SharedTexcoords& texcoords) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!mesh.materials.empty() && (t == 0 || mesh.materials[t] != mesh.materials[t - 1]))
      append_line(out, "usemtl",
                  mesh.material_names.at(static_cast<std::size_t>(mesh.materials[t])));
    out += 'f';
    for (std::size_t k = 0; k < 3; ++k)
      append_corner(out, mesh.triangles[t][k],
                    texcoords.place.empty() ? nullptr : &texcoords.place[3 * t + k],
                    !mesh.normals.empty());
    out += '\n';
  }
}

}  // namespace

void write_obj(const std::filesystem::path& file, const TriMesh& mesh, const ObjOptions& options) {
  const SharedTexcoords texcoords = share_texcoords(mesh.texcoords);
  std::string out;
  for (const std::string& comment : options.comments) append_line(out, "#", comment);
  if (!options.material_library.empty()) append_line(out, "mtllib", options.material_library);
  append_vectors(out, "v", mesh.positions);
  append_vectors(out, "vt", texcoords.values);
  append_vectors(out, "vn", mesh.normals);
  if (mesh.materials.empty() && !options.material.empty())
    append_line(out, "usemtl", options.material);
  append_faces(out, mesh, texcoords);
  write_file(file, out);
}

}  // namespace viewcell

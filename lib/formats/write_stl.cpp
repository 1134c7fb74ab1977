// Source: the STL formats of 3D Systems.
#include <algorithm>
#include <limits>

#include "base/error.h"
#include "base/file.h"
#include "formats/format_number.h"
#include "formats/mesh_file.h"

namespace viewcell {
namespace {

template <typename T>
void append_value(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

glm::vec3 facet_normal(const TriMesh& mesh, const Triangle& t) {
  const glm::dvec3 normal = area_normal(mesh, t);
  const double length = glm::length(normal);
  return length > 0 ? glm::vec3(normal / length) : glm::vec3(0);
}

// A binary file whose comment begins with "solid" may be taken for text.
std::string format_stl_header(const std::vector<std::string>& comments) {
  std::string out = comments.empty() ? "viewcell" : comments[0];
  if (out.starts_with("solid")) out.insert(0, "a ");
  out.resize(80, ' ');
  return out;
}

std::string format_binary_stl(const TriMesh& mesh, const std::vector<std::string>& comments) {
  std::string out = format_stl_header(comments);
  append_value(out, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) {
    append_value(out, facet_normal(mesh, t));
    for (const std::uint32_t v : t) append_value(out, mesh.positions[v]);
    append_value(out, std::uint16_t{0});
  }
  return out;
}

std::string format_text_stl(const TriMesh& mesh) {
  std::string out = "solid viewcell\n";
  for (const Triangle& t : mesh.triangles) {
    out += "facet normal";
    for (int k = 0; k < 3; ++k) append_number(out, facet_normal(mesh, t)[k]);
    out += "\nouter loop\n";
    for (const std::uint32_t v : t) {
      out += "vertex";
      append_place(out, mesh, v);
      out += '\n';
    }
    out += "endloop\nendfacet\n";
  }
  return out + "endsolid viewcell\n";
}

}  // namespace

void write_stl(const std::filesystem::path& file, const TriMesh& mesh,
               const std::vector<std::string>& comments, Remarks* remarks) {
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max())
    throw InputError(file.string(), "", "has more triangles than an STL can number");
  const char* why = "which an STL does not hold, left out";
  const auto leave_out = [&](const char* what, std::size_t n) {
    add_remark(remarks, std::string(what) + ", " + why, n);
  };
  leave_out("colours of vertices", mesh.colors.size());
  leave_out("normals of vertices", mesh.normals.size());
  leave_out("normals of corners", mesh.corner_normals.size());
  leave_out("texture coordinates of corners", mesh.texcoords.size());
  leave_out("materials", mesh.material_names.size());
  const bool is_far = mesh.offset != glm::dvec3(0);
  add_remark(remarks,
             "facets written as text: a binary STL holds floats, which are too coarse here",
             is_far ? mesh.triangles.size() : 0);
  write_file(file, is_far ? format_text_stl(mesh) : format_binary_stl(mesh, comments));
}

}  // namespace viewcell

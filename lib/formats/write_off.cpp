// Source: the Object File Format of Geomview.
#include "base/file.h"
#include "base/srgb.h"
#include "formats/format_number.h"
#include "formats/mesh_file.h"

namespace viewcell {
namespace {

// As bytes and with alpha, as other programs write it.
void append_color(std::string& out, const glm::vec3& color) {
  for (int k = 0; k < 3; ++k) out += ' ' + std::to_string(srgb8_from_linear(color[k]));
  out += " 255";
}

}  // namespace

void write_off(const std::filesystem::path& file, const TriMesh& mesh,
               const std::vector<std::string>& comments, Remarks* remarks) {
  const char* why = "which we do not write to an OFF, left out";
  add_remark(remarks, std::string("normals of corners, ") + why, mesh.corner_normals.size());
  add_remark(remarks, std::string("texture coordinates of corners, ") + why, mesh.texcoords.size());
  add_remark(remarks, std::string("materials, ") + why, mesh.material_names.size());
  std::string out =
      std::string(mesh.colors.empty() ? "" : "C") + (mesh.normals.empty() ? "" : "N") + "OFF\n";
  for (std::string comment : comments) {
    for (char& c : comment)
      if (c == '\n' || c == '\r') c = ' ';
    out += "# " + comment + "\n";
  }
  out +=
      std::to_string(mesh.positions.size()) + " " + std::to_string(mesh.triangles.size()) + " 0\n";
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    std::string row;
    append_place(row, mesh, v);
    for (int k = 0; k < 3 && !mesh.normals.empty(); ++k) append_number(row, mesh.normals[v][k]);
    if (!mesh.colors.empty()) append_color(row, mesh.colors[v]);
    out += row.substr(1) + '\n';
  }
  for (const auto& [a, b, c] : mesh.triangles)
    out += "3 " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c) + '\n';
  write_file(file, out);
}

}  // namespace viewcell

#include "mesh_laws.h"

#include <cmath>

#include "formats/mesh_file.h"
#include "fuzz.h"
#include "mesh/offset.h"

namespace viewcell {
namespace {

// Small files may place a mesh some 10^7 times before they are refused: it is known, and slow.
constexpr MeshLimits kLimits{.max_triangles = 1 << 16};

template <typename Vector>
void hold_finite(const std::vector<Vector>& values, const char* law) {
  for (const Vector& value : values)
    for (int k = 0; k < Vector::length(); ++k) hold(std::isfinite(value[k]), law);
}

void hold_unit(const std::vector<glm::vec3>& normals) {
  constexpr double kSlack = 2e-3;  // above that of every reader
  for (const glm::vec3& n : normals)
    hold(std::abs(glm::length(glm::dvec3(n)) - 1) < kSlack, "normals are of unit length");
}

void hold_lengths(const TriMesh& mesh) {
  const auto fits = [](std::size_t n, std::size_t wanted) { return n == 0 || n == wanted; };
  const std::size_t n_corners = 3 * mesh.triangles.size();
  hold(fits(mesh.normals.size(), mesh.positions.size()), "a normal a vertex");
  hold(fits(mesh.corner_normals.size(), n_corners), "a normal a corner");
  hold(mesh.normals.empty() || mesh.corner_normals.empty(), "normals are of one kind");
  hold(fits(mesh.colors.size(), mesh.positions.size()), "a colour a vertex");
  hold(fits(mesh.texcoords.size(), n_corners), "texture coordinates a corner");
  hold(fits(mesh.materials.size(), mesh.triangles.size()), "a material a triangle");
}

// What both meshes lose by being written: far from the origin, and at steps of floats.
double tolerance_of(const TriMesh& mesh) {
  Box box;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) box.add(place_of(mesh, v));
  const auto largest = [](const glm::dvec3& p) { return std::max({p.x, p.y, p.z}); };
  const double reach = largest(glm::max(glm::abs(box.lo), glm::abs(box.hi)));
  // The shortest number that reads back to a float is a double nearby, which a mesh of one place
  // has its offset at.
  return 1e-5 * largest(box.size()) + (box.size() == glm::dvec3(0) ? 1e-7 : 1e-9) * reach;
}

void hold_same_places(const TriMesh& a, const TriMesh& b) {
  hold(a.triangles.size() == b.triangles.size(), "triangles are neither lost nor added");
  const double tolerance = tolerance_of(a);
  for (std::size_t t = 0; t < a.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      hold(glm::distance(place_of(a, a.triangles[t][k]), place_of(b, b.triangles[t][k])) <=
               tolerance,
           "triangles stay where they are");
}

}  // namespace

void hold_mesh_laws(const TriMesh& mesh) {
  hold_finite(mesh.positions, "positions are finite");
  hold_finite(std::vector<glm::dvec3>{mesh.offset}, "the offset is finite");
  hold_finite(mesh.texcoords, "texture coordinates are finite");
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) hold(v < mesh.positions.size(), "vertices exist");
  hold_lengths(mesh);
  hold_unit(mesh.normals), hold_unit(mesh.corner_normals);
  for (const glm::vec3& c : mesh.colors)
    for (int k = 0; k < 3; ++k) hold(c[k] >= 0 && c[k] <= 1, "colours are within 0 and 1");
  const auto n_materials = static_cast<std::int32_t>(mesh.material_names.size());
  for (const std::int32_t m : mesh.materials) hold(m >= 0 && m < n_materials, "materials exist");
}

void fuzz_mesh_reader(const char* name, std::string_view bytes) {
  const std::filesystem::path file = put_input(name, bytes);
  MeshSource source;
  TriMesh mesh;
  if (!is_taken([&] { mesh = read_mesh(file, &source, kLimits); })) return;
  hold_mesh_laws(mesh);
  const std::size_t format = bytes.size() % kWrittenEndings.size();
  const std::filesystem::path copy = fuzz_folder() / ("copy" + kWrittenEndings[format]);
  write_mesh(copy, static_cast<MeshFormat>(format), mesh);
  const TriMesh again = read_mesh(copy);  // an error here is a finding
  hold_mesh_laws(again);
  hold_same_places(mesh, again);
}

}  // namespace viewcell

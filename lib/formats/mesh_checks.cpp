#include <cmath>

#include "base/error.h"
#include "formats/readers.h"

namespace viewcell {
namespace {

bool is_finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check_finite(const std::vector<glm::vec3>& values, const char* what, const std::string& file) {
  for (std::size_t v = 0; v < values.size(); ++v)
    if (!is_finite(values[v]))
      throw InputError(file, "vertex " + std::to_string(v),
                       std::string(what) + " is not finite (NaN or infinite)");
}

void check_finite(const std::vector<glm::vec2>& corners, const std::string& file) {
  for (std::size_t c = 0; c < corners.size(); ++c)
    if (!std::isfinite(corners[c].x) || !std::isfinite(corners[c].y))
      throw InputError(file, "triangle " + std::to_string(c / 3),
                       "a texture coordinate is not finite (NaN or infinite)");
}

void check_indices(const TriMesh& mesh, const std::string& file) {
  const std::size_t n = mesh.positions.size();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t])
      if (v >= n)
        throw InputError(
            file, "triangle " + std::to_string(t),
            "vertex " + std::to_string(v) + " does not exist; there are " + std::to_string(n));
}

void check_lengths(const TriMesh& mesh) {
  const std::size_t n_vertices = mesh.positions.size(), n_triangles = mesh.triangles.size();
  const auto fits = [](std::size_t n, std::size_t wanted) { return n == 0 || n == wanted; };
  VIEWCELL_CHECK(fits(mesh.normals.size(), n_vertices), mesh.normals.size(), n_vertices);
  VIEWCELL_CHECK(fits(mesh.corner_normals.size(), 3 * n_triangles), mesh.corner_normals.size());
  VIEWCELL_CHECK(mesh.normals.empty() || mesh.corner_normals.empty(), mesh.normals.size());
  VIEWCELL_CHECK(fits(mesh.colors.size(), n_vertices), mesh.colors.size(), n_vertices);
  VIEWCELL_CHECK(fits(mesh.texcoords.size(), 3 * n_triangles), mesh.texcoords.size());
  VIEWCELL_CHECK(fits(mesh.materials.size(), n_triangles), mesh.materials.size());
}

}  // namespace

void append_fan(std::span<const std::uint32_t> polygon, std::vector<Triangle>& triangles) {
  VIEWCELL_CHECK(polygon.size() >= 3, polygon.size());
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    triangles.push_back({polygon[0], polygon[k], polygon[k + 1]});
}

void check_mesh(const TriMesh& mesh, const std::string& file) {
  if (mesh.triangles.empty()) throw InputError(file, "", "has no faces");
  check_finite(mesh.positions, "position", file);
  check_finite(mesh.normals, "normal", file);
  check_finite(mesh.texcoords, file);
  check_indices(mesh, file);
  check_lengths(mesh);
}

void normalize_normals(TriMesh& mesh) {
  constexpr float kUnitSlack =
      1e-5f;  // of the squared length: rounding of what a writer normalised
  std::vector<glm::vec3> computed;
  for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
    glm::vec3& normal = mesh.normals[v];
    const double squared = glm::dot(glm::dvec3(normal), glm::dvec3(normal));
    if (std::abs(squared - 1) <= kUnitSlack) continue;
    if (squared > 0) {
      normal = glm::vec3(glm::dvec3(normal) / std::sqrt(squared));
      continue;
    }
    if (computed.empty()) computed = make_vertex_normals(mesh);
    normal = computed[v];
  }
}

}  // namespace viewcell

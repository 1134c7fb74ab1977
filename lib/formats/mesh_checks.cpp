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

// Unit, and as it is when it is that up to rounding; zero when it has no direction.
glm::vec3 unit_or_zero(const glm::vec3& normal) {
  constexpr double kUnitSlack = 1e-5;  // of the squared length: what a writer normalised
  if (!is_finite(normal)) return glm::vec3(0);
  const double squared = glm::dot(glm::dvec3(normal), glm::dvec3(normal));
  if (std::abs(squared - 1) <= kUnitSlack) return normal;
  return squared > 0 ? glm::vec3(glm::dvec3(normal) / std::sqrt(squared)) : glm::vec3(0);
}

// Fills normals that are zero. vertex_of: the vertex of each; has_use: whether a triangle shows it.
template <typename VertexOf, typename HasUse>
std::size_t fill_normals(const TriMesh& mesh, std::vector<glm::vec3>& normals,
                         const VertexOf& vertex_of, const HasUse& has_use) {
  std::vector<glm::vec3> computed;
  std::size_t n_filled = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (normals[i] != glm::vec3(0)) continue;
    if (computed.empty()) computed = make_vertex_normals(mesh);
    normals[i] = computed[vertex_of(i)];
    n_filled += has_use(i);
  }
  return n_filled;
}

void fill_vertex_normals(TriMesh& mesh, Remarks* remarks) {
  std::vector<bool> is_used(mesh.normals.empty() ? 0 : mesh.positions.size(), false);
  if (!is_used.empty())
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t) is_used[v] = true;
  const std::size_t n = fill_normals(
      mesh, mesh.normals, [](std::size_t v) { return v; },
      [&](std::size_t v) { return is_used[v]; });
  add_remark(remarks, "vertices without a normal: computed from the triangles around them", n);
}

void fill_corner_normals(TriMesh& mesh, Remarks* remarks) {
  const std::size_t n = fill_normals(
      mesh, mesh.corner_normals, [&](std::size_t c) { return mesh.triangles[c / 3][c % 3]; },
      [](std::size_t) { return true; });
  add_remark(remarks, "corners without a normal: computed from the triangles around them", n);
}

// To vertices, where that loses nothing. A vertex that no triangle uses has the normal (0, 0, 1).
void share_corner_normals(TriMesh& mesh) {
  if (mesh.corner_normals.empty()) return;
  std::vector<glm::vec3> normals(mesh.positions.size(), glm::vec3(0));
  for (std::size_t c = 0; c < mesh.corner_normals.size(); ++c) {
    glm::vec3& normal = normals[mesh.triangles[c / 3][c % 3]];
    if (normal == glm::vec3(0)) normal = mesh.corner_normals[c];
    if (normal != mesh.corner_normals[c]) return;
  }
  for (glm::vec3& normal : normals)
    if (normal == glm::vec3(0)) normal = glm::vec3(0, 0, 1);
  mesh.normals = std::move(normals);
  mesh.corner_normals.clear();
}

}  // namespace

void check_mesh(const TriMesh& mesh, const std::string& file) {
  check_finite(mesh.positions, "position", file);
  check_finite(mesh.texcoords, file);
  check_indices(mesh, file);
  check_lengths(mesh);
}

void fill_colors(TriMesh& mesh, Remarks* remarks) {
  std::size_t n = 0;
  for (glm::vec3& color : mesh.colors)
    if (!is_finite(color)) color = glm::vec3(1), ++n;
  add_remark(remarks, "colours that are no numbers, taken as white", n);
}

void normalize_normals(TriMesh& mesh, Remarks* remarks) {
  for (auto* normals : {&mesh.normals, &mesh.corner_normals})
    for (glm::vec3& normal : *normals) normal = unit_or_zero(normal);
  fill_vertex_normals(mesh, remarks);
  fill_corner_normals(mesh, remarks);
  share_corner_normals(mesh);
}

}  // namespace viewcell

#include "mesh/mesh.h"

#include <algorithm>
#include <cmath>

namespace viewcell {

Box bounding_box(const TriMesh& mesh) {
  Box box;
  for (const glm::vec3& p : mesh.positions) box.add(p);
  return box;
}

std::vector<glm::vec3> make_vertex_normals(const TriMesh& mesh) {
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 normal = area_normal(mesh, t);
    const double length = glm::length(normal);
    if (!(length > 0)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 here(mesh.positions[t[k]]);
      const glm::dvec3 a = glm::dvec3(mesh.positions[t[(k + 1) % 3]]) - here;
      const glm::dvec3 b = glm::dvec3(mesh.positions[t[(k + 2) % 3]]) - here;
      sums[t[k]] += std::atan2(length, glm::dot(a, b)) / length * normal;
    }
  }
  std::vector<glm::vec3> normals(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const double length = glm::length(sums[v]);
    normals[v] = length > 0 ? glm::vec3(sums[v] / length) : glm::vec3(0, 0, 1);
  }
  return normals;
}

}  // namespace viewcell

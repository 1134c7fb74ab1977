#include "scene/scene.h"

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "base/error.h"

namespace viewcell {

glm::dmat4 SceneObject::matrix_world_from_model() const {
  glm::dmat4 matrix(glm::mat3_cast(rotation) * scale);
  matrix[3] = glm::dvec4(place(), 1);
  return matrix;
}

bool is_up_axis(const std::string& up) {
  constexpr std::array<const char*, 6> kAxes{"x", "y", "z", "-x", "-y", "-z"};
  return std::find(kAxes.begin(), kAxes.end(), up) != kAxes.end();
}

glm::vec3 turn_up_axis(const std::string& up, const glm::vec3& p) {
  if (up == "-x") return {p.z, p.y, -p.x};
  if (up == "-y") return {p.x, p.z, -p.y};
  if (up == "-z") return {p.x, -p.y, -p.z};
  if (up == "y") return {p.x, -p.z, p.y};
  if (up == "x") return {p.y, p.z, p.x};
  return p;
}

bool Scene::is_double_sided(const SceneObject& object) const {
  return std::any_of(object.materials.begin(), object.materials.end(),
                     [&](int m) { return materials[static_cast<std::size_t>(m)].double_sided; });
}

bool Scene::is_masked(const SceneObject& object) const {
  return std::any_of(object.materials.begin(), object.materials.end(), [&](int m) {
    return materials[static_cast<std::size_t>(m)].alpha == AlphaMode::mask;
  });
}

bool Scene::has_masks() const {
  return std::any_of(objects.begin(), objects.end(),
                     [&](const SceneObject& object) { return is_masked(object); });
}

std::size_t count_triangles(const Scene& scene) {
  std::size_t n = 0;
  for (const SceneObject& object : scene.objects) n += scene.mesh_of(object).n_triangles;
  return n;
}

Box world_box(const Scene& scene, const SceneObject& object) {
  const TriMesh& mesh = scene.mesh_of(object).mesh;
  VIEWCELL_CHECK(!mesh.positions.empty(), "the scene was read without meshes:", scene.name);
  Box box;
  for (const glm::vec3& p : mesh.positions) box.add(object.world_from_model(glm::dvec3(p)));
  return box;
}

}  // namespace viewcell

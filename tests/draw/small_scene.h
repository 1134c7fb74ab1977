// A scene of a few closed and open meshes, small enough for tests.
#pragma once

#include <cmath>

#include "base/random.h"
#include "capture/shapes.h"
#include "scene/camera.h"
#include "scene/scene.h"

namespace viewcell {

// A closed torus around z, wavy so that shading varies; triangles face outward.
inline TriMesh make_torus(int n_around, int n_tube, double radius = 3, double tube = 1) {
  return make_wrapped(n_around, n_tube, [&](double a, double b) {
    const double r = tube * (1 + 0.1 * std::sin(7 * a) * std::cos(3 * b));
    return glm::dvec3((radius + r * std::cos(b)) * std::cos(a),
                      (radius + r * std::cos(b)) * std::sin(a), r * std::sin(b));
  });
}

// An open square of two triangles in the plane x = 0, facing -x.
inline TriMesh make_wall(float half) {
  TriMesh mesh;
  mesh.positions = {{0, -half, 0}, {0, half, 0}, {0, half, 2 * half}, {0, -half, 2 * half}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
  mesh.normals.assign(4, {-1, 0, 0});
  return mesh;
}

inline SceneMesh make_scene_mesh(const char* name, TriMesh mesh) {
  SceneMesh out;
  out.name = name;
  out.file = std::string(name) + ".ply";
  out.n_triangles = mesh.triangles.size();
  out.mesh = std::move(mesh);
  return out;
}

// n_objects tori of two materials, turned at random, strewn over 200 x 200; the mesh has
// 2 * n_around * n_around / 2 triangles.
inline Scene make_small_scene(int n_objects, std::uint64_t seed = 1, int n_around = 40) {
  Scene scene;
  scene.name = "small";
  scene.area = {{-100, -100}, {100, 100}};
  scene.materials = {{"stone", {0.7f, 0.6f, 0.4f}, "", false},
                     {"bronze", {0.3f, 0.2f, 0.1f}, "", false}};
  scene.meshes.push_back(make_scene_mesh("torus", make_torus(n_around, n_around / 2)));
  scene.meshes.push_back(make_scene_mesh("ring", make_torus(n_around / 2, n_around / 4, 2, 0.4)));
  Random random(seed);
  for (int i = 0; i < n_objects; ++i) {
    SceneObject object;
    object.name = "object " + std::to_string(i);
    object.mesh = MeshId(i % 3 == 2 ? 1 : 0);
    object.materials = {i % 2};
    object.scale = random.uniform(0.5, 3);
    object.translation = {random.uniform(-100, 100), random.uniform(-100, 100),
                          5 * object.scale + random.uniform(0, 3)};
    object.rotation = random_rotation(random);
    scene.objects.push_back(object);
  }
  return scene;
}

inline Camera random_camera(Random& random, double reach = 100) {
  Camera camera;
  camera.eye = {random.uniform(-reach, reach), random.uniform(-reach, reach),
                random.uniform(2, 20)};
  camera.forward = glm::normalize(
      glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1) + 1e-3, random.uniform(-0.5, 0.5)));
  return camera;
}

}  // namespace viewcell

// Scenes of one or a few procedural meshes, for captures.
#pragma once

#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <optional>
#include <string>
#include <utility>

#include "base/random.h"
#include "capture/view.h"
#include "formats/mesh_file.h"
#include "scene/scene.h"

namespace viewcell {

/// A closed surface around z from (azimuth, angle around the tube), counter-clockwise from outside.
inline TriMesh make_wrapped(int n_around, int n_tube,
                            const std::function<glm::dvec3(double, double)>& point) {
  TriMesh mesh;
  for (int i = 0; i < n_around; ++i)
    for (int j = 0; j < n_tube; ++j)
      mesh.positions.emplace_back(
          point(glm::two_pi<double>() * i / n_around, glm::two_pi<double>() * j / n_tube));
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % n_around) * n_tube + j % n_tube);
  };
  for (int i = 0; i < n_around; ++i)
    for (int j = 0; j < n_tube; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  mesh.normals = make_vertex_normals(mesh);
  return mesh;
}

/// A torus around z with waves and noise; 2 n_around n_tube triangles.
inline TriMesh make_noisy_torus(int n_around, int n_tube, double noise, std::uint64_t seed) {
  Random random(seed);
  return make_wrapped(n_around, n_tube, [&](double a, double b) {
    const double r =
        5 * (1 + 0.1 * std::sin(7 * a) * std::cos(3 * b)) + random.uniform(-noise, noise);
    return glm::dvec3((14 + r * std::cos(b)) * std::cos(a), (14 + r * std::cos(b)) * std::sin(a),
                      r * std::sin(b));
  });
}

/// Latitudes and longitudes, poles closed; noise is a share of the radius.
inline TriMesh make_sphere(double radius, int n_around, int n_rings, double noise = 0,
                           std::uint64_t seed = 1) {
  Random random(seed);
  TriMesh mesh;
  const auto add = [&](double latitude, double longitude) {
    const double r = radius * (1 + random.uniform(-noise, noise));
    mesh.positions.emplace_back(r * std::cos(latitude) * std::cos(longitude),
                                r * std::cos(latitude) * std::sin(longitude),
                                r * std::sin(latitude));
  };
  add(-glm::half_pi<double>(), 0);
  for (int j = 1; j < n_rings; ++j)
    for (int i = 0; i < n_around; ++i)
      add(glm::pi<double>() * j / n_rings - glm::half_pi<double>(),
          glm::two_pi<double>() * i / n_around);
  add(glm::half_pi<double>(), 0);
  const auto at = [&](int i, int j) {
    return static_cast<std::uint32_t>(1 + (j - 1) * n_around + i % n_around);
  };
  const auto top = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (int i = 0; i < n_around; ++i) {
    mesh.triangles.push_back({0, at(i + 1, 1), at(i, 1)});
    mesh.triangles.push_back({top, at(i, n_rings - 1), at(i + 1, n_rings - 1)});
    for (int j = 1; j + 1 < n_rings; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  mesh.normals = make_vertex_normals(mesh);
  return mesh;
}

/// An axis-aligned box of 12 triangles over 24 vertices, so that its normals are its faces'.
inline TriMesh make_box(const glm::dvec3& lo, const glm::dvec3& hi) {
  TriMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const auto& [s, t] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        glm::dvec3 p;
        p[axis] = side ? hi[axis] : lo[axis];
        p[u] = s ? hi[u] : lo[u];
        p[v] = t ? hi[v] : lo[v];
        mesh.positions.emplace_back(p);
        glm::vec3 normal(0);
        normal[axis] = side ? 1.0f : -1.0f;
        mesh.normals.push_back(normal);
      }
      const std::uint32_t b = side ? 1 : 3, d = side ? 3 : 1;  // low faces run the other way
      mesh.triangles.push_back({first, first + b, first + 2});
      mesh.triangles.push_back({first, first + 2, first + d});
    }
  return mesh;
}

/// The mesh about its centre and of that width.
inline TriMesh of_width(TriMesh mesh, double width) {
  const Box box = bounding_box(mesh);
  for (glm::vec3& p : mesh.positions)
    p = glm::vec3((glm::dvec3(p) - box.centre()) * (width / box.size().x));
  return mesh;
}

/// The bunny of the shared models; nothing where it is not here.
inline std::optional<TriMesh> read_bunny() {
  const auto file = std::filesystem::path(VIEWCELL_SHARED_DATA) / "bunny-69k/bunny70k.ply";
  if (!std::filesystem::exists(file)) return std::nullopt;
  return read_mesh(file);
}

/// As read_scene holds it.
inline SceneMesh make_scene_mesh(TriMesh mesh, const std::string& name = "mesh") {
  SplitMesh split = split_corners(std::move(mesh));
  SceneMesh out;
  out.name = name, out.file = name + ".ply";
  out.n_triangles = split.mesh.triangles.size();
  out.mesh = std::move(split.mesh), out.weld = std::move(split.weld);
  out.has_twins = split.has_twins;
  return out;
}

/// The mesh as the one object of a scene, as it is; material 0, of no special colour.
inline Scene make_scene_of(TriMesh mesh, bool double_sided = false) {
  Scene scene;
  scene.name = "one";
  scene.hash = "0123456789abcdef";
  scene.area = {{0, 0}, {200, 200}};
  scene.materials = {{"stone", {0.7f, 0.6f, 0.4f}, "", double_sided}};
  scene.meshes.push_back(make_scene_mesh(std::move(mesh)));
  SceneObject object;
  object.name = "object 0";
  scene.objects.push_back(object);
  return scene;
}

inline glm::dquat random_rotation(Random& random) {
  return glm::normalize(glm::dquat(random.uniform(-1, 1), random.uniform(-1, 1),
                                   random.uniform(-1, 1), random.uniform(-1, 1) + 1e-3));
}

inline std::vector<glm::dvec3> world_points(const Scene& scene, const SceneObject& object) {
  std::vector<glm::dvec3> points;
  for (const glm::vec3& p : scene.mesh_of(object).mesh.positions)
    points.push_back(object.world_from_model(glm::dvec3(p)));
  return points;
}

}  // namespace viewcell

// A scene of one object a kind of material, small enough for tests.
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "base/random.h"
#include "capture/shapes.h"
#include "image/random_image.h"
#include "scene/scene.h"

namespace viewcell {

/// As read_scene holds a mesh whose objects show pictures and several materials.
inline SceneMesh make_dressed_mesh(TriMesh mesh, const std::string& name) {
  SceneMesh out;
  out.name = name, out.file = name + ".ply";
  out.n_triangles = mesh.triangles.size();
  out.n_slots = std::max<std::size_t>(mesh.material_names.size(), 1);
  SplitMesh split = split_corners(std::move(mesh), {.texcoords = true, .materials = true});
  out.mesh = std::move(split.mesh), out.weld = std::move(split.weld);
  out.looks = std::move(split.looks), out.has_twins = split.has_twins;
  return out;
}

/// make_box with texture coordinates: `repeats` of the picture along each side of each face.
inline TriMesh make_papered_box(double half, float repeats) {
  TriMesh mesh = make_box(glm::dvec3(-half), glm::dvec3(half));
  for (std::size_t f = 0; f < 6; ++f) {
    const std::uint32_t first = static_cast<std::uint32_t>(4 * f);
    for (const std::size_t t : {2 * f, 2 * f + 1})
      for (const std::uint32_t v : mesh.triangles[t]) {
        constexpr glm::vec2 kCorners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        mesh.texcoords.push_back(repeats * kCorners[v - first] - glm::vec2(0.3f, 0.2f));
      }
  }
  return mesh;
}

/// Soft spots of all colours, whose alpha is 1 in discs and 0 between them.
inline ImageRgba8 make_spots(int size_px, std::uint64_t seed) {
  Random random(seed);
  const glm::dvec3 phases(random.uniform(0, 6), random.uniform(0, 6), random.uniform(0, 6));
  ImageRgba8 image(size_px, size_px);
  for (int y = 0; y < size_px; ++y)
    for (int x = 0; x < size_px; ++x) {
      const double u = 2 * glm::pi<double>() * x / size_px, v = 2 * glm::pi<double>() * y / size_px;
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(
            128 + 60 * std::sin((2 + c) * u + phases[c]) + 60 * std::cos((3 - c) * v - phases[c]));
      const double wave = std::cos(4 * u) * std::cos(4 * v);
      image.at(x, y)[3] = static_cast<std::uint8_t>(std::clamp(128 + 300 * wave, 0.0, 255.0));
    }
  return image;
}

inline int add_picture(Scene& scene, ImageRgba8 image, std::optional<float> cutoff = {}) {
  scene.pictures.push_back({"picture.png", "0123456789abcdef", cutoff, {}});
  scene.pictures.back().mips = make_mips(std::move(image), cutoff, 1);
  return static_cast<int>(scene.pictures.size()) - 1;
}

/// Eight objects on a circle of radius 14 around the origin, of some 4 units each.
inline Scene make_material_scene() {
  Scene scene;
  scene.name = "materials";
  scene.hash = "0123456789abcdef";
  scene.area = {{-30, -30}, {30, 30}};
  const auto add = [&](const char* name, Material material, TriMesh mesh) {
    material.name = name;
    const int place = static_cast<int>(scene.materials.size());
    scene.materials.push_back(std::move(material));
    scene.meshes.push_back(make_dressed_mesh(std::move(mesh), name));
    SceneObject object;
    object.name = name;
    object.mesh = MeshId(scene.meshes.size() - 1);
    object.materials = {place};
    const double angle = 2 * glm::pi<double>() * static_cast<double>(scene.objects.size()) / 8;
    object.translation = {14 * std::cos(angle), 14 * std::sin(angle), 2.5};
    object.rotation = glm::angleAxis(0.4 + angle, glm::dvec3(0, 0, 1));
    scene.objects.push_back(object);
  };
  const int spots = add_picture(scene, make_spots(128, 1));
  const int other = add_picture(scene, make_spots(64, 2));
  const int leaves = add_picture(scene, make_spots(128, 3), 0.5f);
  add("papered", {.base_color = {1, 0.9f, 0.8f}, .picture = spots}, make_papered_box(2, 2.5f));
  add("mirrored",
      {.base_color = glm::vec3(1), .wrap_u = Wrap::mirror, .wrap_v = Wrap::clamp, .picture = other},
      make_papered_box(2, 3));
  add("leaves",
      {.base_color = glm::vec3(1),
       .double_sided = true,
       .alpha = AlphaMode::mask,
       .picture = leaves},
      make_papered_box(2, 1.5f));
  add("fence", {.base_color = glm::vec3(1), .alpha = AlphaMode::mask, .picture = leaves},
      make_papered_box(2, 1));
  add("sign", {.base_color = glm::vec3(0.9f), .is_unlit = true, .picture = spots},
      make_papered_box(2, 1));
  add("lamp", {.base_color = {0.2f, 0.1f, 0.1f}, .emissive = {0.5f, 0.4f, 0.1f}},
      make_sphere(2, 24, 12));
  TriMesh ball = make_sphere(2, 32, 16);
  for (const glm::vec3& p : ball.positions) ball.colors.push_back(0.5f + 0.24f * p);
  add("painted", {.base_color = glm::vec3(1), .has_vertex_colors = true}, std::move(ball));
  TriMesh two = make_papered_box(2, 1);
  two.material_names = {"papered", "plain"};
  for (std::size_t t = 0; t < two.triangles.size(); ++t)
    two.materials.push_back(static_cast<std::int32_t>(t / 2 % 2));
  add("two", {.base_color = {0.1f, 0.5f, 0.2f}}, std::move(two));
  scene.objects.back().materials = {0, scene.objects.back().materials[0]};
  return scene;
}

}  // namespace viewcell

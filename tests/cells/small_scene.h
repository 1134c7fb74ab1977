// A scene of boxes, whose footprints are rectangles.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace viewcell {

/// The box [-1, 1]^3, outward.
inline TriMesh make_unit_box() {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  const std::vector<std::array<std::uint32_t, 4>> squares{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                          {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& s : squares) {
    mesh.triangles.push_back({s[0], s[1], s[2]});
    mesh.triangles.push_back({s[0], s[2], s[3]});
  }
  mesh.normals = make_vertex_normals(mesh);
  return mesh;
}

/// Boxes of half side 1 with their centres at those points.
inline Scene make_box_scene(const Area& area, const std::vector<glm::dvec3>& centres) {
  Scene scene;
  scene.name = "boxes";
  scene.hash = "00000000000000aa";
  scene.area = area;
  scene.materials.emplace_back();
  SceneMesh mesh;
  mesh.name = "box";
  mesh.mesh = make_unit_box();
  mesh.n_triangles = mesh.mesh.triangles.size();
  scene.meshes.push_back(std::move(mesh));
  for (const glm::dvec3& centre : centres) {
    SceneObject object;
    object.name = "box " + std::to_string(scene.objects.size());
    object.translation = centre;
    scene.objects.push_back(object);
  }
  return scene;
}

}  // namespace viewcell

// A small scene in a temporary folder, whose JSON a test may spoil.
#pragma once

#include <string>

#include "base/file.h"
#include "common/temporary_folder.h"
#include "formats/mesh_file.h"
#include "mesh/cube.h"
#include "scene/scene.h"

namespace viewcell {

/// A cube and an OFF cube twice: three objects of two meshes and two materials.
inline Scene make_small_scene() {
  Scene scene;
  scene.name = "small";
  scene.area = {{-10, -20}, {30, 40.5}};
  scene.ground_z = -0.25;
  scene.materials = {{"stone", {0.1f, 0.48f, 1}, "", false}, {"glass", {0, 0, 0.3f}, "", true}};
  scene.meshes.resize(2);
  scene.meshes[0].name = "cube", scene.meshes[0].file = "meshes/cube.ply";
  scene.meshes[1].name = "tall", scene.meshes[1].file = "tall.off";
  scene.meshes[1].up = "y", scene.meshes[1].scale = 2.5, scene.meshes[1].substitutes = "a tower";
  for (SceneMesh& mesh : scene.meshes) mesh.n_triangles = 12;
  scene.objects.resize(3);
  scene.objects[0].name = "a";
  scene.objects[1].name = "b", scene.objects[1].mesh = MeshId(1), scene.objects[1].materials = {1};
  scene.objects[1].translation = {1.5, -2, 1.0 / 3};
  scene.objects[1].rotation = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)));
  scene.objects[2].name = "c", scene.objects[2].scale = 0.125;
  return scene;
}

/// The scene's files in a folder of their own.
class SmallSceneFolder {
 public:
  SmallSceneFolder() : scene_(make_small_scene()) {
    make_folder(folder_.path() / "meshes");
    write_ply(folder_.path() / "meshes/cube.ply", make_cube());
    folder_.add("tall.off", cube_off());
    for (SceneMesh& mesh : scene_.meshes) mesh.hash = hash_file(folder_.path() / mesh.file);
    json_ = format_scene(scene_, {{"tool", "test"}});
  }
  const Scene& scene() const { return scene_; }
  Json& json() { return json_; }
  const TemporaryFolder& folder() const { return folder_; }
  /// Writes the JSON and gives its path.
  std::filesystem::path write() const { return folder_.add("scene.json", format_json(json_)); }

 private:
  TemporaryFolder folder_;
  Scene scene_;
  Json json_;
};

}  // namespace viewcell

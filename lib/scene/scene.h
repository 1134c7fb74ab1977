// A scene: meshes, materials, and the objects, which are instances of meshes (docs/formats.md,
// scene.json).
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "base/ids.h"
#include "base/json.h"
#include "base/remarks.h"
#include "formats/mesh_file.h"
#include "mesh/mesh.h"
#include "mesh/split_corners.h"
#include "scene/lighting.h"
#include "scene/material.h"

namespace viewcell {

/// A mesh of the scene, in model space: z up, the file's own up axis and scale already applied.
struct SceneMesh {
  std::string name;  ///< "dragon"
  std::string file;  ///< as written in scene.json, relative to it
  std::string up = "z";
  double scale = 1;
  /// "file": as the file has it; "centre": its box's middle is the origin; "ground": the middle at
  /// x = y = 0, the lowest point at z = 0.
  std::string place = "file";
  std::string substitutes;      ///< what this mesh stands in for; empty: it is what its name says
  std::string hash;             ///< hash_hex() of the bytes that were parsed
  std::size_t n_triangles = 0;  ///< known even when the scene was read without meshes
  TriMesh mesh;     ///< as drawn, one normal a vertex; empty when the scene was read without meshes
  VertexWeld weld;  ///< which of its vertices are one
  /// Where objects show pictures or several materials: one of each a vertex, too.
  VertexLooks looks;
  /// Materials that its triangles name, at least 1: objects give one for each.
  std::size_t n_slots = 1;
  bool has_twins = false;  ///< see SplitMesh: parts of it are seen from both sides
};

/// A placed instance: world = translation + rotation * (scale * model), the mesh's offset included.
struct SceneObject {
  std::string name;
  MeshId mesh{};
  /// Places in Scene::materials: one for each slot of its mesh, or one for all of them.
  std::vector<int> materials{0};
  glm::dvec3 translation{0};
  glm::dquat rotation{1, 0, 0, 0};
  double scale = 1;
  /// rotation * (scale * offset) of its mesh, whose positions are about that (TriMesh::offset); 0
  /// of most, and when the scene was read without meshes.
  glm::dvec3 mesh_offset_world{0};

  glm::dvec3 world_from_model(const glm::dvec3& p) const {
    return place() + rotation * (scale * p);
  }
  glm::dvec3 model_from_world(const glm::dvec3& p) const {
    return glm::conjugate(rotation) * (p - place()) / scale;
  }
  glm::dvec3 place() const { return translation + mesh_offset_world; }
  glm::dmat4 matrix_world_from_model() const;
};

/// The rectangle of the x-y plane that is cut into view cells.
struct Area {
  glm::dvec2 lo{0}, hi{0};
};

struct Scene {
  std::string name;
  Area area;
  Lighting lighting;
  double ground_z = 0;
  std::vector<Material> materials;
  std::vector<ScenePicture> pictures;
  std::vector<SceneMesh> meshes;
  std::vector<SceneObject> objects;
  /// Of what scene.json says (white space aside) and of every mesh's and picture's bytes.
  std::string hash;
  std::string file_hash;             ///< hash_hex() of scene.json's bytes
  std::vector<FileRemarks> remarks;  ///< on scene.json and its meshes, where there are any

  const SceneMesh& mesh_of(const SceneObject& object) const { return meshes[index(object.mesh)]; }
  const Material& material_of(const SceneObject& object, std::size_t slot) const {
    const std::size_t at = object.materials.size() == 1 ? 0 : slot;
    return materials[static_cast<std::size_t>(object.materials[at])];
  }
  /// Whether some of its materials is seen from behind.
  bool is_double_sided(const SceneObject& object) const;
  /// Whether some of its materials has holes.
  bool is_masked(const SceneObject& object) const;
  bool has_masks() const;
  /// The picture of a material as its sides say; nothing where it has none.
  MipTexture texture_of(const Material& material) const {
    if (material.picture < 0) return {};
    return {&pictures[static_cast<std::size_t>(material.picture)].mips, material.wrap_u,
            material.wrap_v};
  }
};

struct ReadSceneOptions {
  /// False: only scene.json is parsed, and pictures are hashed; meshes and pictures stay empty.
  bool with_meshes = true;
  int n_threads = 0;
  MeshLimits limits = {};  ///< of each mesh file
};

/// Whether `up` is one of "x", "y", "z", "-x", "-y", "-z".
bool is_up_axis(const std::string& up);

/// A point or direction of a space whose axis `up` points up, turned so that z does.
glm::vec3 turn_up_axis(const std::string& up, const glm::vec3& p);

/// Reads scene.json and the meshes that it names. A mesh far from its origin must be brought near
/// the world's, by its object's translation or by its "place": floats would be too coarse. Every
/// path must stay inside its folder; a mesh file must be the one that the scene was written with
/// ("hash", "triangles"; a scene written by hand may leave both out, and its meshes are then read
/// even without with_meshes). Throws InputError (file, place).
Scene read_scene(const std::filesystem::path& file, const ReadSceneOptions& options = {});

/// scene.json without the mesh files, which the caller writes beside it.
/// provenance: {"tool", "version", "options"} of the maker. Each mesh's hash and n_triangles must
/// be set. What read_scene() reads back is equal, bit for bit.
Json format_scene(const Scene& scene, const Json& provenance);

/// Triangles of all objects together.
std::size_t count_triangles(const Scene& scene);

/// The object's box in the world, tight around its vertices. O(vertices); needs the mesh.
Box world_box(const Scene& scene, const SceneObject& object);

}  // namespace viewcell

// The nodes of a glTF file: what stands where in its scene. Private to the room.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <vector>

#include "formats/gltf_buffers.h"

namespace viewcell {

/// A mesh where a node of the scene has it.
struct GltfPlacement {
  std::size_t node = 0;
  std::int64_t mesh = 0, skin = -1;  ///< skin -1: none
  glm::dmat4 world_from_node{1};
  std::size_t n_instances = 1;  ///< of EXT_mesh_gpu_instancing
  bool has_weights = false;     ///< of its own, for the mesh's morph targets
};

/// Keeps the file by reference.
class GltfNodes {
 public:
  /// Throws InputError for children that do not exist.
  explicit GltfNodes(const GltfFile& gltf);

  /// The default scene's (or the first's; without scenes, of all nodes) meshes, in the order of its
  /// tree. Nodes that are not visible (KHR_node_visibility) are left out with what hangs on them.
  /// Throws InputError where nodes form no tree.
  std::vector<GltfPlacement> place_meshes(Remarks* remarks) const;

  /// Of each instance; one of the node alone.
  std::vector<glm::dmat4> world_from_instances(const GltfPlacement& placement) const;

  /// What takes a vertex that is bound to joint j to where it is as the joints rest: a matrix each.
  /// The node of a mesh with a skin has no part in that.
  const std::vector<glm::dmat4>& world_from_bound(std::int64_t skin);

 private:
  JsonCursor node_at(std::size_t id) const { return gltf_.root().at("nodes").at(id); }
  std::vector<std::size_t> root_nodes(Remarks* remarks) const;
  GltfPlacement place_mesh(std::size_t id, const glm::dmat4& world_from_node,
                           Remarks* remarks) const;
  const glm::dmat4& world_from_node(std::size_t id);

  const GltfFile& gltf_;
  std::vector<std::size_t> parents_;  // of each node: the one that has it among its children
  std::map<std::size_t, glm::dmat4> worlds_;  // as far as asked for
  std::map<std::int64_t, std::vector<glm::dmat4>> bound_;
};

}  // namespace viewcell

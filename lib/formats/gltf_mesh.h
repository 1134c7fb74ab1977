// The meshes of a glTF file: vertices and triangles as its primitives have them, with morph targets
// at their weights. Private to the room.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "formats/gltf_materials.h"
#include "formats/gltf_nodes.h"
#include "formats/mesh_file.h"
#include "mesh/mesh.h"

namespace viewcell {

/// Vertices that one or several primitives draw from. Arrays of positions' length, or empty.
struct GltfVertices {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec3> colors;     ///< the vertices' own times the material's
  std::vector<glm::vec2> texcoords;  ///< v runs up
  /// Of a skin: so many joints and weights a vertex; weights add up to 1.
  std::size_t n_influences = 0;
  std::vector<std::uint32_t> joints;
  std::vector<float> weights;
};

struct GltfPart {
  std::size_t vertices = 0;  ///< index of GltfMesh::vertices
  std::vector<Triangle> triangles;
  std::int64_t material = -1;  ///< of the file; -1: none
};

struct GltfMesh {
  std::vector<GltfVertices> vertices;
  std::vector<GltfPart> parts;
};

/// What a mesh grows to. Doubles, so that nothing overflows.
struct GltfMeshSize {
  double n_triangles = 0, n_vertices = 0;
};

/// Of the file's JSON alone: nothing is decoded. Throws InputError for a primitive that packs more
/// triangles than are believed. remarks: primitives that are left out.
GltfMeshSize measure_gltf_mesh(const GltfFile& gltf, std::int64_t mesh, const MeshLimits& limits,
                               Remarks* remarks);

/// The weights of morph targets where the mesh is placed; empty where all are 0.
std::vector<float> morph_weights(const GltfFile& gltf, const GltfPlacement& placement);

/// Throws InputError for indices out of range and attributes of different lengths. remarks: what of
/// it is shown in another way than the file says.
GltfMesh read_gltf_mesh(const GltfFile& gltf, const GltfPlacement& placement, Remarks* remarks);

}  // namespace viewcell

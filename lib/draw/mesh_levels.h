// The ladder of simplified meshes that mode `lod` draws from, and the order in which triangles are
// handed to the rasteriser.
#pragma once

#include <vector>

#include "mesh/optimize.h"
#include "scene/scene.h"

namespace viewcell {

struct MeshLevel {
  TriMesh mesh;                           ///< positions, normals, colours and triangles only
  double error = 0;                       ///< of DetailLevel, in model units; 0 for the original
  std::vector<glm::vec2> texcoords = {};  ///< by vertex, where the mesh's looks have them
  std::vector<SlotRange> slots = {};      ///< of all triangles, ascending
};

/// Level 0 is the original; errors do not fall from one level to the next.
using MeshLevels = std::vector<MeshLevel>;

/// The mesh's positions, normals, colours and triangles in an order for the vertex cache, those of
/// one slot side by side; vertices in order of first use. Vertices that no triangle uses are
/// dropped.
MeshLevel optimize_order(const TriMesh& mesh, const VertexLooks& looks = {});

/// Only the original, in optimized order.
MeshLevels make_single_level(const TriMesh& mesh, const VertexLooks& looks = {});

/// build_meshopt_levels of the welded surface, each level with vertices of its own, in optimized
/// order. Vertices of different looks are not welded: the simplifier keeps to such seams. Cost:
/// some 0.3 s a level and million triangles.
MeshLevels build_mesh_levels(const TriMesh& mesh, const DetailOptions& options = {},
                             const VertexWeld& weld = {}, const VertexLooks& looks = {});

/// build_mesh_levels or make_single_level of every mesh of the scene, by MeshId.
std::vector<MeshLevels> build_scene_levels(const Scene& scene, bool with_lod,
                                           const DetailOptions& options = {}, int n_threads = 0);

}  // namespace viewcell

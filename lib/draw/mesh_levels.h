// The ladder of simplified meshes that mode `lod` draws from, and the order in which triangles are
// handed to the rasteriser.
#pragma once

#include <vector>

#include "mesh/optimize.h"
#include "scene/scene.h"

namespace viewcell {

/// positions, normals and triangles only.
struct MeshLevel {
  TriMesh mesh;
  double error = 0;  ///< of DetailLevel, in model units; 0 for the original
};

/// Level 0 is the original; errors do not fall from one level to the next.
using MeshLevels = std::vector<MeshLevel>;

/// The mesh's positions, normals and triangles in an order for the vertex cache, vertices in order
/// of first use. Vertices that no triangle uses are dropped.
TriMesh optimize_order(const TriMesh& mesh);

/// Only the original, in optimized order.
MeshLevels make_single_level(const TriMesh& mesh);

/// build_meshopt_levels of the welded surface, each level with vertices of its own, in optimized
/// order. Cost: some 0.3 s a level and million triangles.
MeshLevels build_mesh_levels(const TriMesh& mesh, const DetailOptions& options = {},
                             const VertexWeld& weld = {});

/// build_mesh_levels or make_single_level of every mesh of the scene, by MeshId.
std::vector<MeshLevels> build_scene_levels(const Scene& scene, bool with_lod,
                                           const DetailOptions& options = {}, int n_threads = 0);

}  // namespace viewcell

// The ladder of simplified meshes that mode `lod` draws from, and the order in which triangles are
// handed to the rasteriser.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace viewcell {

/// positions, normals and triangles only.
struct MeshLevel {
  TriMesh mesh;
  double error = 0;  ///< meshoptimizer's, in model units; 0 for the original
};

/// Level 0 is the original; errors do not fall from one level to the next.
using MeshLevels = std::vector<MeshLevel>;

struct LevelOptions {
  int n_levels = 12;        ///< at most; fewer when simplification gets no further
  double ratio = 0.5;       ///< triangles of a level over those of the one before, in (0, 1)
  std::size_t fewest = 24;  ///< triangles; no level below
};

/// Copies of the mesh's positions, normals and triangles in meshoptimizer's order for the vertex
/// cache, vertices in order of first use. Vertices that no triangle uses are dropped.
TriMesh optimise_order(const TriMesh& mesh);

/// Only the original, in optimised order.
MeshLevels make_single_level(const TriMesh& mesh);

/// By meshopt_simplify from the original, each in optimised order with vertices of its own.
/// Cost: about n_levels / 4 seconds a million triangles.
MeshLevels build_mesh_levels(const TriMesh& mesh, const LevelOptions& options = {});

/// build_mesh_levels or make_single_level of every mesh of the scene, by MeshId.
std::vector<MeshLevels> build_scene_levels(const Scene& scene, bool with_lod,
                                           const LevelOptions& options = {}, int n_threads = 0);

}  // namespace viewcell

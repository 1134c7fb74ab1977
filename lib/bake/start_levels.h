// Levels of detail of a scene's meshes, from which collapses for the cells start, and what those
// collapses have to leave alone.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace viewcell {

/// A part whose diagonal is less than this many times an error may lose much of itself within it.
inline constexpr double kSmallPart = 16;
/// The share of the area of small parts, all together, that simplification may take away.
inline constexpr double kMostLost = 0.02;

/// The connected parts of a mesh, over its welded vertices.
struct MeshParts {
  std::vector<std::uint32_t> of_vertex;  ///< the part's number
  std::vector<double> diagonals, areas;  ///< of each part's box, and of its surface; model units
};

/// One level of detail of a mesh, ready to be placed: its surface, over welded vertices. Of twins
/// (SplitMesh) one stands for both.
struct StartLevel {
  TriMesh mesh;                              ///< model space; normals are the surface's
  std::vector<std::uint32_t> source_vertex;  ///< welded ones of the scene's mesh
  std::vector<bool> is_twin;                 ///< by triangle: it is drawn on both sides; or empty
  /// By vertex: on a rim that another object shares; or empty. Such vertices stay where they are,
  /// or a crack would open.
  std::vector<bool> is_shared;
  bool has_rim = false;   ///< some edge has one triangle
  double error = 0;       ///< model units
  double lost_share = 0;  ///< of the area of parts that are small beside the error
};

struct StartLevels {
  std::vector<StartLevel> levels;  ///< finest first
  MeshParts parts;
};

/// By mesh. Some seconds for a million triangles.
std::vector<StartLevels> build_start_levels(const Scene& scene, int n_threads);

}  // namespace viewcell

// The eight kinds of statue of a park [Chen06 Table 5.2], and the procedural ones.
#pragma once

#include <array>
#include <string>

#include "mesh/mesh.h"

namespace viewcell {

inline constexpr std::size_t kStatueKinds = 8;

/// A kind of statue. Width, depth, height along x, y, z; counts in the 2M, 4M and 8M parks.
struct StatueKind {
  const char* name;
  std::size_t n_triangles;
  glm::dvec3 size;
  std::array<int, 3> counts;
  const char* figure;  ///< what the procedural one shows
};

/// In the order of Table 5.2.
const std::array<StatueKind, kStatueKinds>& statue_kinds();

/// The procedural statue of a kind: exactly its triangles and size, standing on z = 0 and centred
/// on the z axis, with normals. Connected and manifold; closed, except that a kind with an odd
/// number of triangles is open at its base. The same bytes for any number of threads.
TriMesh make_statue(const StatueKind& kind, int n_threads = 0);

/// Scales the mesh, each axis by itself, and moves it so that its box is exactly `size`, on z = 0
/// and centred on the z axis.
void fit_to_size(TriMesh& mesh, const glm::dvec3& size);

}  // namespace viewcell

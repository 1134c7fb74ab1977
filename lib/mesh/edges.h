// Edges of a mesh, each with the triangles along it; any number of them.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

inline constexpr std::uint32_t kNoEdge = 0xffffffffu;

/// Half-edge 3 t + k runs from corner k of triangle t to corner (k + 1) % 3. Edges are numbered by
/// their lower, then their higher vertex.
struct EdgeTable {
  std::vector<std::uint32_t>
      edge_of;                        ///< per half-edge; kNoEdge in triangles with a repeated index
  std::vector<std::uint32_t> sorted;  ///< half-edges, by edge, then by number
  std::vector<std::uint32_t> starts;  ///< edge e has sorted[starts[e], starts[e + 1])

  std::size_t size() const { return starts.size() - 1; }
  std::span<const std::uint32_t> halves(std::size_t edge) const {
    return {sorted.data() + starts[edge], sorted.data() + starts[edge + 1]};
  }
  /// As the edge's first half-edge runs.
  std::pair<std::uint32_t, std::uint32_t> ends(std::size_t edge, const TriMesh& mesh) const {
    const std::uint32_t half = sorted[starts[edge]];
    const Triangle& t = mesh.triangles[half / 3];
    return {t[half % 3], t[(half + 1) % 3]};
  }
};

/// O(n log n).
EdgeTable build_edge_table(const TriMesh& mesh);

}  // namespace viewcell

// The vertices that triangles use, numbered without gaps.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// The order of the new indices: that of the old ones, or that of first use by the triangles.
enum class VertexOrder { old, first_use };

inline constexpr std::uint32_t kUnusedVertex = 0xffffffffu;

struct UsedVertices {
  std::vector<std::uint32_t> source;     ///< new index -> old
  std::vector<std::uint32_t> new_index;  ///< old index -> new, or kUnusedVertex

  std::size_t size() const { return source.size(); }
  Triangle renumber(const Triangle& t) const {
    return {new_index[t[0]], new_index[t[1]], new_index[t[2]]};
  }
  std::vector<Triangle> renumber(std::span<const Triangle> triangles) const;
  /// The used ones' values, in their new order; of an attribute that is not there, none.
  template <typename Value>
  std::vector<Value> pick(const std::vector<Value>& values) const;
};

/// Of n_vertices, those that triangles use. O(vertices + triangles).
UsedVertices find_used_vertices(std::span<const Triangle> triangles, std::size_t n_vertices,
                                VertexOrder order = VertexOrder::old);

/// The box around them; empty when there is none.
Box surface_box(const TriMesh& mesh);

struct CompactMesh {
  TriMesh mesh;                              ///< positions, and normals and colours where given
  std::vector<std::uint32_t> source_vertex;  ///< of each vertex, its number in the input
};

/// Triangles over a mesh's vertices as a mesh of the vertices that they use, in their old order.
CompactMesh compact(const TriMesh& mesh, std::span<const Triangle> triangles);

template <typename Value>
std::vector<Value> UsedVertices::pick(const std::vector<Value>& values) const {
  std::vector<Value> out;
  if (values.empty()) return out;
  out.reserve(source.size());
  for (const std::uint32_t v : source) out.push_back(values[v]);
  return out;
}

}  // namespace viewcell

// A mesh as it is drawn, with one normal a vertex, and which of those vertices are one vertex of
// the surface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/buckets.h"
#include "mesh/mesh.h"

namespace viewcell {

/// The vertices of a drawn mesh at one position are one vertex of its surface: files split it where
/// normals or texture coordinates jump, and soups at every triangle. All empty where each vertex is
/// alone, as in most meshes.
struct VertexWeld {
  std::vector<std::uint32_t> welded;  ///< vertex -> the lowest one at its position
  std::vector<glm::vec3> normals;  ///< per vertex, unit: the surface's, one for all at a position
  Buckets<std::uint32_t> members;  ///< of the lowest one: all that triangles use, ascending

  bool is_empty() const { return welded.empty(); }
  std::uint32_t of(std::uint32_t vertex) const { return welded.empty() ? vertex : welded[vertex]; }
  /// Over welded vertices; a triangle may come to name one twice.
  std::vector<Triangle> weld(std::span<const Triangle> triangles) const;
};

/// What vertices of a drawn mesh have besides; empty where nobody asks for it.
struct VertexLooks {
  std::vector<glm::vec2> texcoords;
  std::vector<std::int32_t> slots;  ///< of TriMesh::materials; the same for all three of a triangle

  bool is_empty() const { return texcoords.empty() && slots.empty(); }
  std::int32_t slot_of(const Triangle& t) const { return slots.empty() ? 0 : slots[t[0]]; }
};

/// Triangles of one material.
struct SlotRange {
  std::int32_t slot = 0;
  std::size_t first_triangle = 0, n_triangles = 0;
};

/// Puts those of each slot side by side, slots ascending, in the order in which they come.
std::vector<SlotRange> group_by_slot(const VertexLooks& looks, std::vector<Triangle>& triangles);

struct SplitMesh {
  TriMesh mesh;  ///< has `normals`, no corner_normals
  VertexWeld weld;
  VertexLooks looks;
  /// Some triangle has a twin of the same vertices in the opposite turn: the surface is seen from
  /// both sides there.
  bool has_twins = false;
};

/// What vertices are split by, besides normals; where the mesh has it.
struct SplitOptions {
  bool texcoords = false, materials = false;
};

/// Vertices of several normals are split: the first normal stays with the vertex, in the order of
/// the triangles, and vertices for the others stand behind all of the input. Without normals they
/// are computed (compute_corner_normals). O(n log n).
SplitMesh split_corners(TriMesh mesh, const SplitOptions& options = {});

/// Unit normals by corner, from the triangles around each position, weighted by angle, as
/// make_vertex_normals has them; where twins meet, those of the two sides apart. O(n log n).
std::vector<glm::vec3> compute_corner_normals(const TriMesh& mesh);

/// Triangles over welded vertices as they are drawn: at each corner, of the vertices welded there,
/// the one whose normal is nearest to the triangle's own.
std::vector<Triangle> choose_drawn_vertices(const TriMesh& mesh, const VertexWeld& weld,
                                            std::span<const Triangle> triangles);

}  // namespace viewcell

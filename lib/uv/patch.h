// Disks cut from a mesh: connected, manifold, with one boundary loop and no handle.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// Every triangle that can be joined.
inline constexpr std::size_t kAllFaces = ~std::size_t{0};

struct Patch {
  TriMesh
      mesh;  ///< positions, unit normals, triangles; vertices and triangles in the input's order
  std::vector<std::uint32_t> source_vertex;    ///< per vertex: the first of the input at its place
  std::vector<std::uint32_t> source_triangle;  ///< per triangle: the input's
  std::size_t n_component_faces = 0;           ///< reached from the start across edges
};

/// Grows a disk of n_faces triangles around a vertex, in the order of their distance from it, which
/// is measured along edges; ties by triangle number. Vertices at equal positions count as one, and
/// triangles of fewer than three positions as none. What the disk would enclose (an ear, as it
/// closes behind it) is taken in before it goes on; not so what has an end of the surface in it, or
/// the farthest triangle of all.
///
/// After each triangle the patch is a disk: one that would pinch it, close a ring or a sphere, or
/// be a third on an edge or turned the other way waits or stays out. So past a handle, a hole of
/// the surface or an edge of three triangles a slit is left open, to the patch's boundary. When no
/// more can be joined the patch has fewer triangles.
///
/// `around` must be a start (is_patch_start), else BugError. O(n log n) of the whole mesh; n^2 of
/// the most triangles at one vertex (20,000: a second).
Patch cut_patch(const TriMesh& mesh, std::uint32_t around, std::size_t n_faces);

/// True when a patch can start at the vertex.
bool is_patch_start(const TriMesh& mesh, std::uint32_t vertex);

/// The vertex, of those that a patch can start at, farthest along a direction; the first of
/// several. None when a patch can start nowhere.
std::optional<std::uint32_t> find_top_vertex(const TriMesh& mesh, const glm::dvec3& up);

/// The vertices of the boundary, the surface on the left, from the lowest number on. BugError when
/// the mesh's boundary is not one simple loop; vertices of equal positions are not one here.
std::vector<std::uint32_t> find_boundary_loop(const TriMesh& mesh);

}  // namespace viewcell

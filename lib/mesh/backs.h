// Sheets that a file tells from both sides, whose back is cut along other diagonals than its front.
#pragma once

#include <cstdint>
#include <span>

#include "mesh/mesh.h"

namespace viewcell {

/// What is said where cut_backs_alike() did something.
inline constexpr const char* kBacksRecut =
    "triangles on the backs of others, cut along the diagonals of their fronts";

/// Whether a mesh of so many triangles over so many places may have such sheets: a surface of one
/// side has no more than two triangles a vertex.
inline bool may_have_backs(std::size_t n_triangles, std::size_t n_vertices) {
  return n_triangles > 2 * n_vertices;
}

/// Programs that cut each quad from its first corner on cut the back of a sheet the other way:
///
///      front d--c   back d--c     two triangles of the back over the corners of two of the front
///            | /|        |\ |     become the front's, the other way round; their corners keep
///            |/ |        | \|     what they have
///            a--b        a--b
///
/// Where the corners are in a plane the surface stays as it is, otherwise the back becomes the
/// front. Left alone: two triangles of a back that differ in material, or at the diagonal in vertex
/// or texture coordinates; quads whose sides are triangles already told twice. place: of each
/// vertex, equal where vertices stand at one place. Gives the number of triangles of backs that are
/// cut anew. O(n log n).
std::size_t cut_backs_alike(TriMesh& mesh, std::span<const std::uint32_t> place);
/// The same where may_have_backs(), by equal positions.
std::size_t cut_backs_alike(TriMesh& mesh);

}  // namespace viewcell

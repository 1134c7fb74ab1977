// Meshes far from the origin, as maps have them: positions about an offset (TriMesh::offset).
#pragma once

#include <span>

#include "mesh/mesh.h"

namespace viewcell {

/// No coordinate of an offset is larger: a vertex' place is within floats, an offset near it.
inline constexpr double kMostOffset = 0x1p128;

/// Zero while the step between floats as large as the box's largest coordinate is at most 2^-18 of
/// the box's longest side: for every mesh nearer to the origin than some 32 of its sizes; and for a
/// point that floats hold. Otherwise, for each axis on which coordinates are above 8 longest sides,
/// the box's middle, rounded to a multiple of a power of two not below the longest side: floats
/// less the offset, and the sums of both as doubles, are exact.
glm::dvec3 choose_offset(const Box& box);

/// Whether positions about the offset are as fine as about the one chosen: the box is within 8 of
/// its longest sides from it.
bool is_offset_near(const Box& box, const glm::dvec3& offset);

/// Sets offset and positions to vertices at `places`.
void place_vertices(TriMesh& mesh, std::span<const glm::dvec3> places, const glm::dvec3& offset);

/// Positions about another offset; each is rounded once.
void change_offset(TriMesh& mesh, const glm::dvec3& offset);

/// Where a vertex is.
inline glm::dvec3 place_of(const TriMesh& mesh, std::size_t vertex) {
  return mesh.offset + glm::dvec3(mesh.positions[vertex]);
}

}  // namespace viewcell

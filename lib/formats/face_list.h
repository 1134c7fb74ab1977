// Faces as files have them, polygons of any length, on their way to triangles. Private to this room
// and its tests.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/remarks.h"
#include "mesh/mesh.h"

namespace viewcell {

/// Face f has the corners [starts[f], starts[f + 1]).
struct FaceList {
  std::vector<std::uint32_t> vertices;  ///< of corners
  std::vector<std::uint64_t> starts{0};

  std::size_t size() const { return starts.size() - 1; }
  void end_face() { starts.push_back(vertices.size()); }
};

/// The same for equal positions.
std::uint64_t hash_position(const glm::vec3& p);

/// Where the triangles of a FaceList come from.
struct TriangleSources {
  std::vector<std::uint64_t> corners;  ///< three a triangle: of the list
  std::vector<std::uint32_t> faces;    ///< one a triangle
};

/// Sets mesh.triangles to the faces, cut (mesh/triangulate.h); one whose corners stand where an
/// earlier one's do, either way round, as that one was. Those of fewer than three corners are left
/// out. Vertices must be in range. sources: if wanted.
void cut_faces(const FaceList& faces, TriMesh& mesh, TriangleSources* sources, Remarks* remarks);

/// The vertices of a mesh's triangles, three each.
inline std::span<const std::uint32_t> corners_of(const TriMesh& mesh) {
  if (mesh.triangles.empty()) return {};
  return {mesh.triangles[0].data(), 3 * mesh.triangles.size()};
}

/// A vertex that no corner names may be nowhere (NaN, infinite), as in scans that are a grid with
/// holes: it goes where the first corner is, remarked. Throws InputError(file) for one that is
/// named, and where none is named, for any. lines: of the file, of those that are nowhere, in
/// order; empty: not known.
void mend_unused_places(std::vector<glm::dvec3>& places, std::span<const std::uint32_t> corners,
                        const std::string& file, Remarks* remarks,
                        std::span<const std::int64_t> lines = {});

/// Sets positions and offset (mesh/offset.h) to vertices at `places`, of which those count that
/// corners name; where none is named, all. stated: an offset that the file names, taken if it
/// serves.
void place_vertices(std::span<const glm::dvec3> places, std::span<const std::uint32_t> corners,
                    TriMesh& mesh, Remarks* remarks,
                    const std::optional<glm::dvec3>& stated = std::nullopt);
/// The same for positions that the mesh has.
void choose_offset_of(std::span<const std::uint32_t> corners, TriMesh& mesh, Remarks* remarks);

}  // namespace viewcell

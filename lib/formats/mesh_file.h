// Reading and writing meshes. Readers trust nothing: counts are checked against the file's size
// before anything is allocated, coordinates must be finite, indices in range.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "base/remarks.h"
#include "mesh/mesh.h"

namespace viewcell {

/// What a reader knows of a file beside the mesh.
struct MeshSource {
  std::string hash;  ///< hash_hex of the bytes that were parsed (of a pipe too, which is read once)
  Remarks remarks;   ///< what was passed over
};

/// How far a file may grow as it is read: a few bytes can place one mesh many times, or pack many
/// triangles.
struct MeshLimits {
  std::size_t max_triangles = 0;  ///< 0: 2^24, or 8 for each byte of the file where that is more
};

/// Reads OBJ, PLY (also .ply.gz), OFF, STL, GLB/glTF, 3DS by the file's extension; "-" (standard
/// input) and names without a known one, by what the file holds. Polygons are cut
/// into fans; vertex order and numbers stay those of the file (STL: equal positions become one
/// vertex). Normals come out of unit length. Colours in files are taken as sRGB, except glTF's,
/// which are linear. Texture coordinates have (0, 0) at the image's lower left; glTF's are turned
/// over. A glTF scene's nodes are flattened into one mesh, as it rests: docs/formats.md. Throws
/// InputError (file, place) for anything malformed, for a mesh with no faces, and beyond the
/// limits. source: what else is known of the file, if wanted.
TriMesh read_mesh(const std::filesystem::path& file, MeshSource* source = nullptr,
                  const MeshLimits& limits = {});

/// read_mesh, and an InputError when all faces together have no area.
TriMesh read_surface(const std::filesystem::path& file, MeshSource* source = nullptr,
                     const MeshLimits& limits = {});

/// Binary little-endian PLY: positions, and normals, colours and texture coordinates (as a list
/// "texcoord" of each face) where present. comments: lines of
/// provenance. Whole or not at all.
void write_ply(const std::filesystem::path& file, const TriMesh& mesh,
               const std::vector<std::string>& comments = {});

/// What an OBJ file says beside the mesh.
struct ObjOptions {
  std::vector<std::string> comments;  ///< lines at the head; line breaks in them become blanks
  std::string material_library;       ///< file beside it, for "mtllib"; empty: none
  std::string material;               ///< for "usemtl", where the mesh has no materials; or empty
};

/// Wavefront OBJ: positions, and normals, texture coordinates and materials' names where present;
/// colours are left out. Numbers are the shortest that read back to the same floats; of equal
/// texture coordinates one is written. Whole or not at all.
void write_obj(const std::filesystem::path& file, const TriMesh& mesh,
               const ObjOptions& options = {});

}  // namespace viewcell

// Reading and writing meshes. Readers trust nothing: counts are checked against the file's size
// before anything is allocated, coordinates must be finite, indices in range.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

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
/// input) and names without a known one, by what the file holds. Polygons are cut into triangles
/// (mesh/triangulate.h); vertex order and numbers stay those of the file (STL: equal positions
/// become one vertex). Normals come out of unit length, by corner where those of a vertex differ.
/// Colours in files are taken as sRGB, except glTF's, which are linear. Texture coordinates have
/// (0, 0) at the image's lower left; glTF's are turned over. A glTF scene's nodes are flattened
/// into one mesh, as it rests: docs/formats.md. Far from the origin positions are about an offset
/// (mesh/offset.h). Throws InputError (file, place) for anything malformed, for a mesh with no
/// faces, and beyond the limits. source: what else is known of the file, if wanted.
TriMesh read_mesh(const std::filesystem::path& file, MeshSource* source = nullptr,
                  const MeshLimits& limits = {});

/// read_mesh, and an InputError when all faces together have no area.
TriMesh read_surface(const std::filesystem::path& file, MeshSource* source = nullptr,
                     const MeshLimits& limits = {});

/// read_surface, but a file without faces gives its vertices, a point cloud; there must be one.
TriMesh read_surface_or_points(const std::filesystem::path& file, MeshSource* source = nullptr,
                               const MeshLimits& limits = {});

/// Binary little-endian PLY: positions, and normals, colours and texture coordinates (as a list
/// "texcoord" of each face) where present. comments: lines of provenance. Vertices of several
/// normals are split, and a comment and a remark say so. About an offset coordinates are doubles,
/// and a comment names it. Whole or not at all, as all that follow. remarks: what is left out.
void write_ply(const std::filesystem::path& file, const TriMesh& mesh,
               const std::vector<std::string>& comments = {}, Remarks* remarks = nullptr);

/// What an OBJ file says beside the mesh.
struct ObjOptions {
  std::vector<std::string> comments;  ///< lines at the head; line breaks in them become blanks
  std::string material_library;  ///< file beside it, for "mtllib"; empty: those that the mesh names
  std::string material;          ///< for "usemtl", where the mesh has no materials; or empty
};

/// Wavefront OBJ: positions, and colours ("v x y z r g b", sRGB), normals, texture coordinates and
/// materials' names where present. Numbers are the shortest that read back to the same floats
/// (about an offset: doubles); of equal texture coordinates and normals of corners one is written.
void write_obj(const std::filesystem::path& file, const TriMesh& mesh,
               const ObjOptions& options = {});

/// Binary STL, with the triangles' own normals; about an offset text, which holds its digits.
/// comments: the first stands in the header, as far as it fits.
void write_stl(const std::filesystem::path& file, const TriMesh& mesh,
               const std::vector<std::string>& comments = {}, Remarks* remarks = nullptr);

/// OFF: positions, and colours (COFF, bytes) and normals of vertices (NOFF) where present.
void write_off(const std::filesystem::path& file, const TriMesh& mesh,
               const std::vector<std::string>& comments = {}, Remarks* remarks = nullptr);

enum class MeshFormat { ply, obj, stl, off, glb };
/// The endings that write_mesh knows: ".ply" and on, in MeshFormat's order.
extern const std::vector<std::string> kWrittenEndings;
/// By the name's ending; otherwise: of a name without a known one ("-", a device).
MeshFormat written_format(const std::filesystem::path& file, MeshFormat otherwise);

/// In that format: as the functions above and write_glb, without pictures.
void write_mesh(const std::filesystem::path& file, MeshFormat format, const TriMesh& mesh,
                const std::vector<std::string>& comments = {}, Remarks* remarks = nullptr);

}  // namespace viewcell

// A mesh with its textures as one file: binary glTF 2.0.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/remarks.h"
#include "formats/glb_material.h"
#include "mesh/mesh.h"

namespace viewcell {

/// What a GLB holds beside the mesh.
struct GlbOptions {
  std::string base_color;  ///< a PNG's or JPEG's bytes (encode_png); empty: no texture
  std::string normal_map;  ///< the same, in tangent space, y up; empty: none
  std::string generator;   ///< "texadapt 0.1.0"; empty: "viewcell" and the version
  /// Instead of base_color and normal_map: of the mesh's materials, by their numbers.
  std::vector<GlbMaterial> materials = {};
};

/// Writes positions, and normals and texture coordinates where present, as one primitive of one
/// material (white times base_color, dielectric, rough), or one primitive for each of the materials
/// given that has triangles, all over the same vertices; equal pictures are written once. Whole or
/// not at all; "-": standard output. The same input gives the same bytes: no date.
///
/// Vertices 0 .. n - 1 are the mesh's; where a vertex's corners have several normals, copies of it
/// follow from n on, in the order of the corners, and behind these others where they have several
/// texture coordinates. Triangles keep their order, and so
/// do their corners. v is turned over, as read_mesh turns it: v comes back exactly if it is a
/// multiple of 2^-24 in [0, 1], else to within 2^-25. Axes stay as they are, though glTF holds that
/// y points up. Indices are uint16 up to 65535 vertices, else uint32.
///
/// A mesh's offset is the node's translation. remarks: vertices added for their normals, and what
/// is left out: materials and their names, unless given; vertex colours where there is a base
/// colour texture or materials are given, which they would multiply. Tangents (mesh/tangents.h)
/// are written where there are a normal map and normals; where a texture meets its mirror image on
/// one vertex, that too has copies.
///
/// The mesh must have a triangle; a texture needs texture coordinates. Throws InputError for
/// positions or texture coordinates that are not finite, for bytes that are neither PNG nor JPEG,
/// and beyond 4 GiB; MachineError when it cannot be written.
void write_glb(const std::filesystem::path& file, const TriMesh& mesh,
               const GlbOptions& options = {}, Remarks* remarks = nullptr);

}  // namespace viewcell

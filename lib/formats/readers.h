// The readers behind read_mesh, one a format, and what they share. Private to this room and its
// tests. bytes: the whole file; file: its name, for errors and for finding files beside it;
// remarks: where it is to be said what was passed over.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "formats/mesh_file.h"

namespace viewcell {

TriMesh parse_ply_mesh(std::string_view bytes, const std::filesystem::path& file,
                       Remarks* remarks = nullptr);
/// OFF, and COFF, NOFF, STOFF and their mixtures; colours of faces are passed over.
TriMesh parse_off(std::string_view bytes, const std::filesystem::path& file,
                  Remarks* remarks = nullptr);
/// Text or binary, told apart by the size that a binary file states. Equal positions are welded.
bool is_binary_stl(std::string_view bytes);
TriMesh parse_stl(std::string_view bytes, const std::filesystem::path& file,
                  Remarks* remarks = nullptr);
/// Material libraries that it names must lie in its folder; they may be missing.
TriMesh parse_obj(std::string_view bytes, const std::filesystem::path& file,
                  Remarks* remarks = nullptr);
/// glTF 2.0 as .glb or .gltf. Buffers are embedded or lie in the file's folder. What it grows to is
/// held against the limits before anything is decoded.
TriMesh parse_gltf(std::string_view bytes, const std::filesystem::path& file,
                   Remarks* remarks = nullptr, const MeshLimits& limits = {});
/// 3D Studio: all objects of the file, one after another.
TriMesh parse_3ds(std::string_view bytes, const std::filesystem::path& file,
                  Remarks* remarks = nullptr);

/// The bytes inside a gzip file. Output past 64 MiB + 100 times the input, or past 4 GiB, is
/// refused as it comes: meshes do not compress that well.
std::string gunzip(std::string_view bytes, const std::filesystem::path& file);

/// Adds the triangles (p0, p1, p2), (p0, p2, p3), ... of a polygon of at least three vertices.
void append_fan(std::span<const std::uint32_t> polygon, std::vector<Triangle>& triangles);

/// What every reader's result must be: at least one face, finite numbers, indices in
/// range, attribute arrays of the right length. Throws InputError naming the vertex or triangle.
void check_mesh(const TriMesh& mesh, const std::string& file);

/// Normals of unit length; a zero normal is computed from the triangles around its vertex.
void normalize_normals(TriMesh& mesh);

}  // namespace viewcell

// The readers behind read_mesh, one a format, and what they share. Private to this room and its
// tests. bytes: the whole file; file: its name, for errors and for finding files beside it;
// remarks: where it is to be said what was passed over.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "formats/mesh_file.h"

namespace viewcell {

TriMesh parse_ply_mesh(std::string_view bytes, const std::filesystem::path& file,
                       Remarks* remarks = nullptr);
/// OFF, and COFF, NOFF, STOFF and their mixtures; colours of faces are passed over.
bool starts_as_off(std::string_view bytes);
TriMesh parse_off(std::string_view bytes, const std::filesystem::path& file,
                  Remarks* remarks = nullptr);
/// Text or binary, told apart by the size that a binary file states. One that states none (0, or
/// the largest number) holds what its size has room for. Equal positions are welded.
bool is_binary_stl(std::string_view bytes);
/// Text, or binary with its count left open.
bool may_be_stl(std::string_view bytes);
TriMesh parse_stl(std::string_view bytes, const std::filesystem::path& file,
                  Remarks* remarks = nullptr);
/// Material libraries are kept by name and not opened. Elements may stand below the faces that name
/// them. Corners whose normal is none (index 0, not a number) have the normal (0, 0, 0).
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

/// What every reader's result must be: finite numbers (but for normals and colours), indices in
/// range, attribute arrays of the right length. Throws InputError naming the vertex or triangle.
void check_mesh(const TriMesh& mesh, const std::string& file);

/// Colours that are no numbers become white, as where a file gives none.
void fill_colors(TriMesh& mesh, Remarks* remarks);

/// Normals of unit length. Where one is zero or not finite it is computed from the triangles around
/// its vertex (make_vertex_normals). Normals of corners become normals of vertices where all
/// corners of every vertex agree.
void normalize_normals(TriMesh& mesh, Remarks* remarks);

}  // namespace viewcell

// The weighted meshes of one cell as a PLY (docs/formats.md, weighted meshes).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bake/cell_mesh.h"

namespace viewcell {

/// One cell's SVMeshes or MVMeshes.
struct WeightedMeshes {
  Representation kind = Representation::single_view;
  CellId cell{};
  std::string captures;  ///< key of the captures that they were derived from
  /// Hash of those and of the options: both kinds of one bake share it.
  std::string made_from;
  std::vector<CellMesh> meshes;  ///< ascending by object
  std::string file_hash = {};    ///< hash_hex() of the bytes that were parsed
};

/// "cell-00012.ply"
std::string weighted_mesh_name(CellId cell);

void write_weighted_meshes(const std::filesystem::path& file, const WeightedMeshes& meshes,
                           const std::string& provenance);

/// Checks what the header says, and every index against the scene: objects, source vertices, vertex
/// ranges of one object. Throws InputError (file, place).
WeightedMeshes read_weighted_meshes(const std::filesystem::path& file, const Scene& scene);

/// The same, which must be those of that kind and cell.
WeightedMeshes read_weighted_meshes(const std::filesystem::path& file, const Scene& scene,
                                    Representation kind, CellId cell);

/// Whether the file is there, whole and of that made_from: such a file is not derived again. Throws
/// InputError when it holds another kind or another cell, which writing would destroy.
bool is_derived(const std::filesystem::path& file, Representation kind, CellId cell,
                const std::string& made_from);

}  // namespace viewcell

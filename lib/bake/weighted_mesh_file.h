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
};

/// "cell-00012.ply"
std::string weighted_mesh_name(CellId cell);

void write_weighted_meshes(const std::filesystem::path& file, const WeightedMeshes& meshes,
                           const std::string& provenance);

/// Checks every index against the scene: objects, source vertices, vertex ranges of one object.
WeightedMeshes read_weighted_meshes(const std::filesystem::path& file, const Scene& scene);

/// The made_from of an existing whole file, or empty when there is none: such a file is not derived
/// again.
std::string made_from_of(const std::filesystem::path& file);

}  // namespace viewcell

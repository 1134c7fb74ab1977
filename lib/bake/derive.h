// All SVMeshes or all MVMeshes of a cell, from a folder of captures.
#pragma once

#include <filesystem>

#include "bake/weighted_mesh_file.h"
#include "capture/captures.h"

namespace viewcell {

/// Sums over the objects of a cell, or over cells.
struct DeriveCounts {
  std::size_t n_meshes = 0;
  std::size_t n_unseen = 0;      ///< of objects that the cell never sees: levels without views
  std::size_t n_uncaptured = 0;  ///< meshes that no view captured: drawn lit
  CellMeshCounts triangles;
  void add(const DeriveCounts& other);
};

/// The weighted meshes of one kind of one cell. An SVMesh reads the cell's own centre, an MVMesh
/// all seven. What stands for unseen objects is among the SVMeshes.
WeightedMeshes derive_cell(const BakeScene& bake, const std::filesystem::path& captures,
                           const CaptureSettings& settings, CellId cell, Representation kind,
                           const BakeOptions& options, DeriveCounts& counts);

/// The options that change the meshes, for provenance.
Json format_options(const BakeOptions& options);

}  // namespace viewcell

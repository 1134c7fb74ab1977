// The meshes of a park: procedural ones, or real models from a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/remarks.h"
#include "scene/scene.h"

namespace viewcell {

struct ParkMeshes {
  std::vector<SceneMesh> meshes;  ///< one a kind, in the order of statue_kinds(); no hash yet
  std::vector<std::string> source_hashes;  ///< of the model files; empty for a procedural mesh
  std::vector<std::string> notes;    ///< lines for people: what was missing, scaled, simplified
  std::vector<FileRemarks> remarks;  ///< on models.json and the model files, where there are any
};

/// The meshes of all kinds. folder empty: all procedural. Otherwise the folder's models.json says
/// which file is which kind (docs/formats.md); without one, a file named by its kind (dragon.ply,
/// bunny.off, ...) is taken. Kinds without a file are procedural, with a note.
///
/// A model is turned upright, scaled, the same along all axes, to a box of the volume of the
/// table's, centred on the z axis and set on z = 0; one with more triangles than the table's is
/// simplified to them (one fewer where the parity does not allow it). Smaller ones stay.
/// Throws InputError.
ParkMeshes make_park_meshes(const std::filesystem::path& folder, int n_threads = 0,
                            const MeshLimits& limits = {});

}  // namespace viewcell

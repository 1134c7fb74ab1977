// Statuary parks [Chen06 5.3.1].
#pragma once

#include <array>
#include <filesystem>

#include "base/parallel.h"
#include "park/walk.h"

namespace viewcell {

struct ParkPreset {
  const char* name;
  ParkSize size;
  bool is_brief;  ///< with the short piece of the walk only
};

/// 2m, 4m, 8m, and demo: the 4M park with a short walk.
const std::array<ParkPreset, 4>& park_presets();

struct Park {
  Scene scene;
  CameraPath path;
  WalkReport report;
};

/// meshes: of make_park_meshes(). Parks of one seed and one set of meshes are subsets of each
/// other, and their walks are the same (the demo's a piece of it).
Park make_park(std::vector<SceneMesh> meshes, const ParkPreset& preset, std::uint64_t seed,
               int n_threads = 0);

/// folder/meshes/*.ply, folder/path.json and, last, folder/scene.json; sets the meshes' hashes.
/// Each file whole or not at all; without scene.json there is no park.
void write_park(Park& park, const std::filesystem::path& folder, const Json& provenance,
                const Progress& progress = {});

}  // namespace viewcell

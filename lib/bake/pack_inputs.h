// What cellpack reads, all of it checked before anything is written. Private to this room.
#pragma once

#include <map>
#include <set>

#include "bake/pack.h"

namespace viewcell {

/// The meshes of a cell, both kinds, by object; with every outside object exactly once.
struct CellMeshes {
  std::vector<CellMesh> meshes;
  std::vector<Representation> kinds;
  std::string hash;  ///< of both files' bytes
};

/// Throws InputError (file, place) that says what to run.
CellMeshes read_cell_meshes(const Scene& scene, const CellSet& cells, const PackInputs& inputs,
                            const std::string& captures_key, CellId cell);

/// Which objects' tiles a centre's textures need.
using TilesNeeded = std::map<CentreId, std::set<ObjectId>>;

struct CheckedInputs {
  CaptureSettings settings;
  std::vector<std::string> mesh_hashes;  ///< CellMeshes::hash of each cell of the list
  TilesNeeded tiles;
};

/// Reads every weighted mesh and the head of every capture. Throws InputError.
CheckedInputs check_pack_inputs(const Scene& scene, const CellSet& cells, const PackInputs& inputs,
                                const std::vector<CellId>& list, int n_threads);

/// The bytes of a file that was read before, with that hash. Throws InputError when they changed.
std::string read_unchanged(const std::filesystem::path& file, const std::string& hash);

}  // namespace viewcell

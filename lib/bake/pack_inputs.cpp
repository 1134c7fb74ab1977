#include "bake/pack_inputs.h"

#include <mutex>

#include "base/error.h"
#include "base/file.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

// A .gltf keeps its buffers in other files, which a bundle would lack.
void check_self_contained(const Scene& scene, const fs::path& scene_file) {
  for (const SceneMesh& mesh : scene.meshes)
    if (fs::path(mesh.file).extension() == ".gltf")
      throw InputError(scene_file.string(), "mesh '" + mesh.file + "'",
                       "keeps its buffers in other files; a bundle takes .glb, .ply, .obj, .off");
}

void check_has_objects(const Scene& scene, const fs::path& scene_file) {
  if (scene.objects.empty())
    throw InputError(scene_file.string(), "objects",
                     "is empty: there is nothing to pack; put objects into the scene and run "
                     "hexcells, depthcap, svmesh and mvmesh again");
}

void check_all_there(const CellSet& cells, const PackInputs& inputs, CellId cell,
                     const std::vector<int>& n_times) {
  for (std::size_t o = 0; o < n_times.size(); ++o) {
    const int expected = is_original(cells, cell, ObjectId(o)) ? 0 : 1;
    if (n_times[o] != expected)
      throw InputError(inputs.svmesh.string(), "cell " + std::to_string(static_cast<int>(cell)),
                       "object " + std::to_string(o) + " is in " + std::to_string(n_times[o]) +
                           " of svmesh and mvmesh, not in " + std::to_string(expected) +
                           "; run svmesh and mvmesh with the same options");
  }
}

void add_needed(const CellSet& cells, CellId cell, const CellMeshes& meshes, TilesNeeded& needed) {
  const auto views = views_of(cells.grid, cell);
  for (std::size_t m = 0; m < meshes.meshes.size(); ++m)
    for (std::size_t k = 0; k < views.size() && meshes.kinds[m] != Representation::unseen; ++k)
      if (k == 0 || meshes.kinds[m] == Representation::multi_view)
        needed[views[k]].insert(meshes.meshes[m].object);
}

}  // namespace

CellMeshes read_cell_meshes(const Scene& scene, const CellSet& cells, const PackInputs& inputs,
                            const std::string& captures_key, CellId cell) {
  CellMeshes out;
  std::string made_from;  // of the first file
  std::vector<int> n_times(scene.objects.size(), 0);
  for (const auto& [folder, kind] : {std::pair(inputs.svmesh, Representation::single_view),
                                     std::pair(inputs.mvmesh, Representation::multi_view)}) {
    const fs::path file = folder / weighted_mesh_name(cell);
    WeightedMeshes read = read_weighted_meshes(file, scene, kind, cell);
    if (read.captures != captures_key)
      throw InputError(file.string(), "header",
                       "was derived from other captures; run svmesh and mvmesh again");
    if (!made_from.empty() && read.made_from != made_from)
      throw InputError(file.string(), "header",
                       "was derived with other options than its counterpart in svmesh; run svmesh "
                       "and mvmesh with the same options");
    made_from = read.made_from;
    out.hash += read.file_hash;
    for (CellMesh& mesh : read.meshes) {
      ++n_times[index(mesh.object)];
      out.kinds.push_back(is_unseen(cells, cell, mesh.object) ? Representation::unseen : kind);
      out.meshes.push_back(std::move(mesh));
    }
  }
  check_all_there(cells, inputs, cell, n_times);
  return out;
}

CheckedInputs check_pack_inputs(const Scene& scene, const CellSet& cells, const PackInputs& inputs,
                                const std::vector<CellId>& list, int n_threads) {
  check_has_objects(scene, inputs.scene_file);
  check_self_contained(scene, inputs.scene_file);
  check_tested(cells, list, inputs.cells_file);
  CheckedInputs out;
  out.settings = read_settings(inputs.captures, scene, cells.file_hash);
  out.mesh_hashes.resize(list.size());
  std::mutex mutex;  // guards out.tiles
  parallel_for(list.size(), n_threads, [&](std::size_t i) {
    const CellMeshes meshes = read_cell_meshes(scene, cells, inputs, out.settings.key(), list[i]);
    out.mesh_hashes[i] = meshes.hash;
    const std::lock_guard lock(mutex);
    add_needed(cells, list[i], meshes, out.tiles);
  });
  std::vector<CentreId> centres;
  for (const auto& [centre, objects] : out.tiles) centres.push_back(centre);
  parallel_for(centres.size(), n_threads, [&](std::size_t i) {
    CentreCaptures(capture_file_of(inputs.captures, centres[i]), out.settings);
  });
  return out;
}

std::string read_unchanged(const fs::path& file, const std::string& hash) {
  std::string bytes = read_file(file);
  if (hash_hex(bytes) != hash)
    throw InputError(file.string(), "", "changed while it was packed; run cellpack again");
  return bytes;
}

}  // namespace viewcell

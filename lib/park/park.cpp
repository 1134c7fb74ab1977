#include "park/park.h"

#include "base/error.h"
#include "base/file.h"
#include "formats/mesh_file.h"

namespace viewcell {
namespace fs = std::filesystem;
namespace {

// A material a kind, in the order of statue_kinds(): light and dark, warm and cool stand beside
// each other.
std::vector<Material> make_materials() {
  return {{"jade", {0.15f, 0.38f, 0.25f}, "", false},
          {"white marble", {0.70f, 0.68f, 0.64f}, "", false},
          {"red sandstone", {0.52f, 0.25f, 0.15f}, "", false},
          {"bronze", {0.24f, 0.14f, 0.07f}, "", false},
          {"grey granite", {0.36f, 0.37f, 0.41f}, "", false},
          {"basalt", {0.14f, 0.14f, 0.16f}, "", false},
          {"yellow sandstone", {0.62f, 0.46f, 0.23f}, "", false},
          {"Carrara marble", {0.72f, 0.73f, 0.77f}, "", false}};
}

}  // namespace

const std::array<ParkPreset, 4>& park_presets() {
  static const std::array<ParkPreset, 4> presets{{{"demo", ParkSize::k4m, true},
                                                  {"2m", ParkSize::k2m, false},
                                                  {"4m", ParkSize::k4m, false},
                                                  {"8m", ParkSize::k8m, false}}};
  return presets;
}

Park make_park(std::vector<SceneMesh> meshes, const ParkPreset& preset, std::uint64_t seed,
               int n_threads) {
  std::vector<SceneObject> objects = scatter_statues(meshes, seed);
  Walks walks = make_walks(meshes, objects, seed, n_threads);
  Walk& walk = preset.is_brief ? walks.brief : walks.whole;
  objects.resize(count_statues(preset.size));
  Park park;
  park.scene.name = preset.name;
  park.scene.area = kParkArea;
  park.scene.materials = make_materials();
  park.scene.meshes = std::move(meshes);
  park.scene.objects = std::move(objects);
  park.path = std::move(walk.path);
  park.report = walk.report;
  return park;
}

void write_park(Park& park, const fs::path& folder, const Json& provenance,
                const Progress& progress) {
  make_folder(folder);
  make_folder(folder / "meshes");
  std::error_code none;  // an old scene.json would name meshes that are about to change
  fs::remove(folder / "scene.json", none);
  std::vector<SceneMesh>& meshes = park.scene.meshes;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const fs::path file = folder / meshes[i].file;
    write_ply(file, meshes[i].mesh, {"made by " + provenance.at("tool").get<std::string>()});
    meshes[i].hash = hash_file(file);
    if (progress) progress(i + 1, meshes.size());
  }
  write_file(folder / "path.json", format_json(format_path(park.path, provenance)));
  write_file(folder / "scene.json", format_json(format_scene(park.scene, provenance)));
}

}  // namespace viewcell

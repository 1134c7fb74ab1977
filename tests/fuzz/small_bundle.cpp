#include "small_bundle.h"

#include "base/file.h"
#include "formats/mesh_file.h"
#include "mesh/cube.h"

namespace viewcell {
namespace fs = std::filesystem;

Scene write_small_scene(const fs::path& folder) {
  Scene scene;
  scene.area = {{0, 0}, {40, 40}};
  scene.materials = {{"clay", {0.5f, 0.4f, 0.3f}, "", false},
                     {"tin", {0.5f, 0.5f, 0.5f}, "", true}};
  SceneMesh cube;
  cube.name = "cube", cube.file = "cube.ply", cube.place = "ground";
  cube.n_triangles = cube_triangles().size();
  write_ply(folder / cube.file, make_cube());
  cube.hash = hash_file(folder / cube.file);
  scene.meshes = {cube};
  for (int i = 0; i < 3; ++i) {
    SceneObject object;
    object.name = "cube " + std::to_string(i);
    object.materials = {i % 2};
    object.translation = {35.0 + i, 30.0 - 9 * i, 15};
    scene.objects.push_back(object);
  }
  write_file(folder / "scene.json", format_json(format_scene(scene, Json::object())));
  return read_scene(folder / "scene.json");
}

CellSet make_small_cells(const Scene& scene) {
  return make_cells(scene, 20, {});
}

CellGeometry make_small_geometry() {
  CellGeometry g;
  g.objects = {
      {0, 1, 4, 2, {0, 0, 0}, {1, 1, 1}}, {1, 2, 3, 1, {0, 0, 0}, {1, 1, 1}}, {2, 1, 0, 0}};
  g.source_vertices = {0, 1, 2, 3, 4, 5, 6};
  g.offsets = {0, 1, -1, 2, -2, 3, -3};
  g.indices = {0, 1, 2, 0, 2, 3, 0, 1, 2};
  g.views = {1, 2, 127};
  return g;
}

CentreTextures make_small_textures(const CellSet& cells) {
  const glm::dvec3 eye = eye_of(cells, kFuzzCentre);
  CentreTextures out;
  for (int i = 0; i < 2; ++i) {
    BundleTile tile;
    tile.object = 2 * i;
    tile.width_px = 4 + i, tile.height_px = 6;
    tile.source_px = 64;
    for (int k = 0; k < 3; ++k) tile.eye[k] = eye[k];
    tile.right[0] = 1, tile.up[2] = 1, tile.forward[1] = 1;
    tile.focal_px = 100;
    tile.code_scale = 50, tile.code_bias = -3;
    tile.first_texel = out.texels.size();
    out.tiles.push_back(tile);
    const std::size_t n = static_cast<std::size_t>(tile.width_px * tile.height_px);
    for (std::size_t t = 0; t < n; ++t)
      out.texels.push_back({std::uint8_t(t), std::uint8_t(40 * i), 7, std::uint8_t(255 - t)});
  }
  return out;
}

BundleManifest make_small_manifest(const Scene& scene, TextureFormat format) {
  BundleManifest m;
  m.scene_hash = scene.hash;
  m.cells_hash = m.captures = m.meshes = kFuzzKey;
  m.resolution_px = 64;
  m.texture_format = format;
  m.cells = {kFuzzCell}, m.centres = {kFuzzCentre};
  m.made_by = Json::object();
  for (const SceneMesh& mesh : scene.meshes) m.files[mesh.file] = mesh.hash;
  m.files[cell_name(kFuzzCell)] = m.files[centre_name(kFuzzCentre)] = kFuzzKey;
  return m;
}

fs::path write_small_bundle(const fs::path& folder, TextureFormat format) {
  make_folder(folder);
  const Scene scene = write_small_scene(folder);
  const BundleManifest manifest = make_small_manifest(scene, format);
  const fs::path bake = bake_folder(folder, manifest);
  make_folder(bake / "cells"), make_folder(bake / "centres");
  for (const char* name : {"scene.json", "cube.ply"}) fs::rename(folder / name, bake / name);
  const CellSet cells = make_small_cells(scene);
  write_file(bake / "cells.json", format_json(format_cells(cells, Json::object())));
  write_cell_geometry(bake / cell_name(kFuzzCell), kFuzzCell, kFuzzKey, make_small_geometry());
  write_centre_textures(bake / centre_name(kFuzzCentre), kFuzzCentre, kFuzzKey,
                        make_small_textures(cells), format);
  write_file(folder / kManifestName, format_json(format_manifest(manifest)));
  return bake;
}

}  // namespace viewcell

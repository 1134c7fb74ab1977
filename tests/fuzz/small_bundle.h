// A bundle of three cubes and a few cells, whose files are fuzzed one by one.
#pragma once

#include "bundle/bundle.h"

namespace viewcell {

inline constexpr CellId kFuzzCell{0};
inline constexpr CentreId kFuzzCentre{0};

/// Writes scene.json and its mesh into the folder.
Scene write_small_scene(const std::filesystem::path& folder);
CellSet make_small_cells(const Scene& scene);
/// What the bundle holds of one cell and one centre.
CellGeometry make_small_geometry();
CentreTextures make_small_textures(const CellSet& cells);
BundleManifest make_small_manifest(const Scene& scene, TextureFormat format);
/// Writes a bundle into the folder. Returns the folder of its files.
std::filesystem::path write_small_bundle(const std::filesystem::path& folder, TextureFormat format);
/// Its key: of a program in which all hashes are 0.
inline constexpr const char* kFuzzKey = "0000000000000000";

}  // namespace viewcell

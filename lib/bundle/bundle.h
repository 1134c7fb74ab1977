// What the player loads: a folder that needs nothing beside it (docs/formats.md, bundle).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/folder_lock.h"
#include "bundle/representation.h"
#include "cells/cells.h"
#include "image/bc.h"
#include "image/image.h"
#include "scene/scene.h"

namespace viewcell {

/// One outside object of a cell, as drawn.
struct BundleObject {
  std::int32_t object = 0;
  std::uint32_t kind = 0;  ///< a Representation
  std::uint32_t n_vertices = 0;
  std::uint32_t n_triangles = 0;
  float lo[3] = {}, hi[3] = {};  ///< box of its vertices, world; zeros when it has none
};

/// Geometry of a cell: objects one after another, indices counted from each object's first vertex.
struct CellGeometry {
  std::vector<BundleObject> objects;
  std::vector<std::uint32_t> source_vertices;  ///< numbers in each object's original mesh
  /// How far each vertex lies off its original along the normal, in 1/1024 of the scene's unit.
  std::vector<std::int16_t> offsets;
  std::vector<std::uint32_t> indices;  ///< 3 a triangle
  std::vector<std::uint8_t> views;     ///< 1 a triangle
};

/// One object's crop as seen from a centre.
struct BundleTile {
  std::int32_t object = 0;
  std::int32_t x = 0, y = 0, width_px = 0, height_px = 0;  ///< the crop in the source image
  std::int32_t source_px = 0;
  double eye[3] = {}, right[3] = {}, up[3] = {}, forward[3] = {};
  double focal_px = 1;
  /// A texel's alpha is code = scale / depth + bias, rounded, 0..255 from far to near; of objects
  /// with masks 1..255, and 0 where the crop shows nothing of the object.
  double code_scale = 0, code_bias = 0;
  std::uint64_t first_texel = 0;  ///< row by row from here
};

/// Textures of a centre: 4 bytes a texel, sRGB colour and a depth code as alpha.
struct CentreTextures {
  std::vector<BundleTile> tiles;  ///< ascending by object; their texels one after another
  std::vector<Rgba8> texels;
};

enum class TextureFormat { rgba8, bc3 };

struct BundleManifest {
  std::string scene_hash;  ///< Scene::hash
  std::string cells_hash;  ///< of cells.json's bytes
  std::string captures;    ///< key of the captures
  std::string meshes;      ///< hash of the weighted meshes' hashes
  int resolution_px = 0;
  TextureFormat texture_format = TextureFormat::rgba8;
  /// Whether the scene has masks: bundles that were packed before tiles told their holes say no.
  bool has_masks = false;
  std::vector<CellId> cells;
  std::vector<CentreId> centres;
  Json made_by;
  /// Of meshes (by their path in scene.json) the hash of the bytes, of section files
  /// ("cells/cell-00012.geo") their table_hash(), as hash_hex.
  std::map<std::string, std::string> files = {};
};

inline constexpr double kOffsetUnit = 1.0 / 1024;

/// Opens a bundle; everything else is read from it on demand. Reading is const and thread-safe.
class Bundle {
 public:
  /// Throws InputError unless the folder holds a whole bundle whose manifest, scene, meshes and
  /// cells are those that were packed. While it lives cellpack leaves its files there.
  explicit Bundle(const std::filesystem::path& folder, const ReadSceneOptions& options = {});

  const BundleManifest& manifest() const { return manifest_; }
  const Scene& scene() const { return scene_; }
  const CellSet& cells() const { return cells_; }
  bool has(CellId cell) const;
  bool has(CentreId centre) const;
  /// Throw InputError when the file is missing, damaged, of another cell or centre, of another
  /// bake, or not the file that was packed.
  CellGeometry read_cell(CellId cell) const;
  /// texels: memory to read into, its contents lost.
  CentreTextures read_centre(CentreId centre, std::vector<Rgba8> texels = {}) const;

 private:
  BundleManifest manifest_;
  std::string key_;
  std::filesystem::path bake_;  // the folder of its files
  FolderHold hold_;
  Scene scene_;
  CellSet cells_;
};

/// What tells a bake from every other: a hash of all that the manifest says but `files`.
std::string bake_key(const BundleManifest& manifest);
/// The folder of a bake's files in the bundle's. Its name is of all that the manifest says.
std::filesystem::path bake_folder(const std::filesystem::path& bundle,
                                  const BundleManifest& manifest);
/// "cells/cell-00012.geo", "centres/centre-00034.tex": in the bake's folder.
std::string cell_name(CellId cell);
std::string centre_name(CentreId centre);

/// Return the file's entry for BundleManifest::files. key: of the bake.
std::string write_cell_geometry(const std::filesystem::path& file, CellId cell,
                                const std::string& key, const CellGeometry& geometry);
std::string write_centre_textures(const std::filesystem::path& file, CentreId centre,
                                  const std::string& key, const CentreTextures& textures,
                                  TextureFormat format, ZeroAlpha zero = ZeroAlpha::nearest);
Json format_manifest(const BundleManifest& manifest);
inline constexpr const char* kManifestName = "bundle.json";

}  // namespace viewcell

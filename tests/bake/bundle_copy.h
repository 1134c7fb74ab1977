// A copy of a bundle, to be damaged or changed.
#pragma once

#include "bake/small_bake.h"

namespace viewcell {

/// The manifest's hash of all that it says.
inline void seal_manifest(Json& json) {
  json.erase("hash");
  json["hash"] = hash_hex(json.dump());
}

class BundleCopy {
 public:
  explicit BundleCopy(const std::filesystem::path& of = shared_bundle()) {
    std::filesystem::copy(of, path(), std::filesystem::copy_options::recursive);
  }

  std::filesystem::path path() const { return folder_.path() / "bundle"; }
  /// Of the bake, and a file of it.
  std::string key() const { return manifest().at("key").get<std::string>(); }
  std::filesystem::path file(const std::string& name) const {
    return path() / ("bake-" + manifest().at("hash").get<std::string>()) / name;
  }

  /// Writes it anew, by the bundle's own hand: the manifest says so. For values that no packer
  /// writes.
  void write(CellId cell, const CellGeometry& geometry) const {
    enter(cell_name(cell), write_cell_geometry(file(cell_name(cell)), cell, key(), geometry));
  }
  void write(CentreId centre, const CentreTextures& textures,
             TextureFormat format = TextureFormat::rgba8) const {
    enter(centre_name(centre),
          write_centre_textures(file(centre_name(centre)), centre, key(), textures, format));
  }

 private:
  Json manifest() const { return Json::parse(read_file(path() / kManifestName)); }
  void enter(const std::string& name, const std::string& hash) const {
    const std::filesystem::path old = file("");
    Json json = manifest();
    json["files"][name] = hash;
    seal_manifest(json);
    put_bytes(path() / kManifestName, json.dump());
    std::filesystem::rename(old, file(""));
  }

  TemporaryFolder folder_;
};

}  // namespace viewcell

// A copy of a bundle, to be damaged or changed.
#pragma once

#include "bake/small_bake.h"

namespace viewcell {

class BundleCopy {
 public:
  explicit BundleCopy(const std::filesystem::path& of = shared_bundle()) {
    std::filesystem::copy(of, path(), std::filesystem::copy_options::recursive);
  }

  std::filesystem::path path() const { return folder_.path() / "bundle"; }
  std::string key() const {
    return Json::parse(read_file(path() / kManifestName)).at("key").get<std::string>();
  }
  /// A file of the bake.
  std::filesystem::path file(const std::string& name) const {
    return bake_folder(path(), key()) / name;
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
  void enter(const std::string& name, const std::string& hash) const {
    Json manifest = Json::parse(read_file(path() / kManifestName));
    manifest["files"][name] = hash;
    put_bytes(path() / kManifestName, manifest.dump());
  }

  TemporaryFolder folder_;
};

}  // namespace viewcell

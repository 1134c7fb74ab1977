// A bundle's next bake, written beside the one that plays.
#pragma once

#include <mutex>

#include "base/temporaries.h"
#include "bundle/bundle.h"

namespace viewcell {

/// Until commit() the bundle is what it was; without it nothing is left of what was written, and a
/// folder that was not there is not there again. What a killed run left is removed by the next.
class BundleWriter {
 public:
  /// manifest: without `files`. Throws MachineError, or InputError while another process packs
  /// into the folder.
  BundleWriter(const std::filesystem::path& folder, BundleManifest manifest);

  /// From any thread.
  void write(CellId cell, const CellGeometry& geometry);
  void write(CentreId centre, const CentreTextures& textures);
  /// The bytes of scene.json, cells.json or, with their hash, of a mesh.
  void write_copy(const std::string& name, std::string_view bytes, const std::string& hash = "");

  /// Puts the manifest, and with it the bake, into place; then removes earlier bakes but those that
  /// a player holds.
  void commit();

 private:
  void add_file(const std::string& name, const std::string& hash);

  // In this order: what is made last goes first.
  std::filesystem::path folder_;
  Temporary new_folder_;  // the bundle's, where it is new
  FolderLock lock_;
  BundleManifest manifest_;
  std::string key_;
  std::filesystem::path bake_;
  Temporary new_bake_;  // unless the bundle has that bake: then the same bytes are written again
  std::mutex mutex_;    // guards manifest_.files
};

}  // namespace viewcell

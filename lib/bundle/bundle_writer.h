// A bundle's next bake, written beside the one that plays.
#pragma once

#include <mutex>

#include "base/file.h"
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

  /// Puts the bake and the manifest, which names it, into place; then removes earlier bakes but
  /// those that a player holds.
  void commit();

 private:
  void add_file(const std::string& name, const std::string& hash);

  // In this order: what is made last goes first.
  std::filesystem::path folder_;
  Temporary new_folder_;  // the bundle's, where it is new
  FolderLock lock_;
  PendingFolder bake_;
  BundleManifest manifest_;
  std::string key_;
  std::mutex mutex_;  // guards manifest_.files
};

}  // namespace viewcell

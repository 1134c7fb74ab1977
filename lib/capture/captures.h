// A folder of captures: one EXR a centre and a manifest (docs/formats.md, captures).
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "capture/tile.h"
#include "cells/cells.h"
#include "image/capture_file.h"

namespace viewcell {

/// What all files of one folder have in common: captures.json.
struct CaptureSettings {
  std::string scene_hash;
  std::string cells_hash;  ///< of cells.json's bytes
  CaptureDensity density;
  std::string engine;  ///< "embree" or "gl"
  /// A hash of all of the above: files that carry another belong to another bake.
  std::string key() const;
};

inline constexpr const char* kCapturesManifest = "captures.json";

Json format_settings(const CaptureSettings& settings, const Json& provenance);
/// Throws InputError unless the folder holds captures of this scene and these cells.
CaptureSettings read_settings(const std::filesystem::path& folder, const Scene& scene,
                              const std::string& cells_hash);

/// folder/centre-00012.exr
std::filesystem::path capture_file_of(const std::filesystem::path& folder, CentreId centre);

/// The objects that a centre captures: those that some cell of its closed neighbourhood may see
/// and does not draw as they are; where cells were tested for that, the others do not count.
std::vector<ObjectId> objects_seen_from(const CellSet& cells, CentreId centre);

/// Writes a centre's tiles, whole or not at all.
void write_captures(const std::filesystem::path& file, const std::vector<CaptureTile>& tiles,
                    const CaptureSettings& settings);

/// Whether the file is there, whole, and of these settings.
bool is_captured(const std::filesystem::path& file, const CaptureSettings& settings);

/// A centre's captures, read object by object.
class CentreCaptures {
 public:
  /// Throws InputError when the file is missing, damaged, or of other settings.
  CentreCaptures(const std::filesystem::path& file, const CaptureSettings& settings);
  /// Nothing when the centre does not capture the object (the eye is inside it or touches it).
  std::optional<CaptureTile> read(ObjectId object);
  bool has(ObjectId object) const { return part_of_.contains(object); }

 private:
  std::filesystem::path path_;
  CaptureFile file_;
  std::map<ObjectId, std::size_t> part_of_;  // object -> part
};

}  // namespace viewcell

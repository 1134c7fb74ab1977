// Pictures of a mesh from all sides, as files: view-00.png and on, and a contact sheet.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/parallel.h"
#include "base/remarks.h"
#include "draw/mesh_renderer.h"

namespace viewcell {

struct MeshShotOptions {
  std::size_t n_views = 8;       ///< in [1, kMostViews]
  std::filesystem::path folder;  ///< of the pictures; made if missing
  std::filesystem::path sheet;   ///< the contact sheet; empty: none
  std::string title;             ///< on the sheet
  int n_threads = 0;             ///< that encode pictures
  Remarks* remarks = nullptr;    ///< of the sheet (report/contact_sheet.h)
};

struct MeshShot {
  std::string name;  ///< of the file: "view-00.png", with as many digits as the last needs
  Camera view;
  std::size_t n_covered = 0;  ///< pixels with alpha
};

/// Throws InputError when the folder has view-*.png that n_views views would not overwrite: a
/// comparison of folders would take them for new ones.
void check_shot_folder(const std::filesystem::path& folder, std::size_t n_views);

/// The sheet's name when none is given: FOLDER.sheet.png beside the folder, since a comparison of
/// folders takes every picture in them.
std::filesystem::path sheet_beside(const std::filesystem::path& folder);

/// Draws make_views(n_views) and writes each picture, whole, with alpha; then the sheet. The same
/// bytes for any number of threads. Throws what check_shot_folder and write_png throw.
std::vector<MeshShot> write_mesh_shots(const MeshRenderer& renderer, const MeshShotOptions& options,
                                       const Progress& progress = {});

/// [{"name", "eye", "forward", "up", "elevation_deg", "azimuth_deg", "covered_px"}]; eye, forward
/// and up in the mesh's own coordinates.
Json format_shots(const std::vector<MeshShot>& shots, const MeshFrame& frame);
/// {"centre", "radius", "up", "fov_y_deg"}.
Json format_frame(const MeshFrame& frame);
/// What changes the bytes of a picture, for provenance.
Json format_style(const MeshStyle& style);

}  // namespace viewcell

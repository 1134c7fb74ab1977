// A level of any program as a scene: read, turned, scaled, cut into pieces, with its materials.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "formats/mesh_file.h"
#include "image/header.h"
#include "import/pieces.h"
#include "scene/scene.h"

namespace viewcell {

/// Scenes are baked and walked through at an eye height of kEyeHeight units (hexcells, 16 to 20);
/// people have theirs at kEyeHeight_m.
inline constexpr double kEyeHeight = 18, kEyeHeight_m = 1.6;
inline constexpr double kUnitsPerMetre = kEyeHeight / kEyeHeight_m;

struct ImportOptions {
  double unit_m = 1;          ///< what the file's 1 is, in metres
  std::string up = "y";       ///< of is_up_axis()
  double piece_m = 0;         ///< side of a piece; 0: choose_piece_m() of the level
  int max_texture_px = 2048;  ///< larger pictures are made smaller
  /// Height in the file that people stand at, in metres; none: find_floor().
  std::optional<double> floor_m;
  MeshLimits limits = {};
  ImageLimits image_limits = {};
};

struct ImportedPicture {
  std::string file;   ///< as the scene's materials name it
  std::string bytes;  ///< as they were in the level, or a smaller picture's
};

struct ImportedLevel {
  Scene scene;  ///< with meshes as they are to be written, not yet split or welded
  std::vector<ImportedPicture> pictures;
  LevelPieces pieces;  ///< counts; the meshes are the scene's
  Box box_m;           ///< of the level, in metres, z up, as the scene has it
  double piece_m = 0;  ///< side of a piece
  double floor_m = 0;  ///< where the file has what is z = 0 now
  std::string hash;    ///< of the level's file
  Remarks remarks;
};

/// The height above the mesh's offset, z up, that most of the area lies at that faces upwards: 5 cm
/// count as one, and the lowest of several. 0 where nothing faces upwards. unit_m: metres of the
/// mesh's 1.
double find_floor(const TriMesh& mesh, double unit_m);

/// 8 m, or as much as makes of the surface some thousand pieces. area_m2: of all triangles.
double choose_piece_m(double area_m2);

/// The floor comes to z = 0, where the ground is. Throws InputError for a level that has no
/// triangles with area, or that cannot be read.
ImportedLevel import_level(const std::filesystem::path& file, const ImportOptions& options);

/// folder/meshes/*, folder/textures/* and, last, folder/scene.json; sets the meshes' hashes. Each
/// file whole or not at all; without scene.json there is no scene.
void write_level(ImportedLevel& level, const std::filesystem::path& folder, const Json& provenance,
                 const Progress& progress = {});

}  // namespace viewcell

// What is typed at texadapt.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapt/adapt_levels.h"
#include "adapt/normal_map.h"
#include "common/tool.h"

namespace viewcell {

enum class AdaptEngine { cpu, gl, rebake };
enum class LevelFormat { png, glb, map };

/// A further texture, and where its like for a level goes.
struct FurtherTexture {
  std::string from, to;
};

struct TexadaptArguments {
  std::string pm, texture;
  std::vector<std::size_t> levels;  ///< faces
  bool names_levels = false;        ///< files have the level's faces in their names
  std::string mesh, index_map, log, replay, start;
  std::string onto;  ///< a mesh to rebake onto, instead of levels
  bool has_normal_map = false;
  FurtherTexture normal_map;  ///< from "": the finest mesh's shading; to "": into the GLB alone
  NormalMapOptions normal_map_options;
  std::vector<FurtherTexture> further;
  AdaptEngine engine = AdaptEngine::cpu;
  LevelFormat format = LevelFormat::png;
  AdaptLevelsOptions options;
  bool allows_overlap = false;
  std::optional<std::size_t> max_pixels;  ///< of pictures that are read
  bool no_normal_map = false;             ///< a model's own is left out
  bool keeps_repeating = false;           ///< pictures that repeat stay as they are
  std::optional<int> quality;  ///< of pictures that are stored as JPEG; without: their own
  int texture_side = 0;        ///< of pictures that are written, at most; 0: as they are

  /// The name of an output at a level: with --levels "head.png" becomes "head-500.png".
  std::string name_at(const std::string& file, std::size_t level) const;

  // As typed; finish_arguments() makes the above of it.
  std::optional<std::size_t> faces;
  std::string level_list, engine_name = "cpu", gl = "osmesa", format_name, texel_name = "float",
                          size, start_text;
  std::string normal_map_text, normal_map_y = "up";
  std::vector<std::string> further_texts;
  bool bake = false, one_by_one = false;
};

void declare_arguments(Tool& tool, TexadaptArguments& arguments);

/// Registers the files of all levels. Throws UsageError for what does not fit together.
void finish_arguments(Tool& tool, TexadaptArguments& arguments);

}  // namespace viewcell

// What is typed at meshshot.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "common/tool.h"
#include "draw/mesh_shots.h"

namespace viewcell {

struct MeshshotArguments {
  std::string mesh_file, texture, normal_map, map_file, like_file, box;
  std::string mesh_hash, texture_hash, normal_map_hash, map_hash, like_hash;  // once they are read
  std::string normal_map_y = "up", up = "auto", normals = "mesh", gl = "osmesa", sheet;
  std::optional<std::size_t> max_pixels;
  bool unlit = false, fixed_light = false, no_sheet = false;
  MeshStyle style;
  MeshShotOptions shots;
};

void declare_arguments(Tool& tool, MeshshotArguments& arguments);

/// Sets style and shots, and registers the sheet. Throws UsageError.
void finish_arguments(Tool& tool, MeshshotArguments& arguments);

}  // namespace viewcell

// What is typed at scenedraw.
#pragma once

#include <optional>
#include <string>

#include "common/tool.h"
#include "scene/camera.h"

namespace viewcell {

struct ScenedrawArguments {
  std::string scene_file, cells_file, path_file, from = "corner", eye, toward;
  std::string size = "1280x960", gl = "osmesa";
  double at_s = 0, fov_y_deg = 0;
  int width_px = 0, height_px = 0;
  std::optional<std::size_t> max_pixels;
};

void declare_arguments(Tool& tool, ScenedrawArguments& arguments);

/// Sets width_px and height_px. Throws UsageError.
void finish_arguments(ScenedrawArguments& arguments);

/// Of --from eye: where --eye and --toward, or --path and --at, say. Throws UsageError.
Camera choose_eye(const ScenedrawArguments& arguments, const std::optional<CameraPath>& path);

}  // namespace viewcell

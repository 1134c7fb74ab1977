// What is typed at depthcap.
#pragma once

#include <optional>
#include <string>

#include "capture/view.h"
#include "common/tool.h"

namespace viewcell {

struct DepthcapArguments {
  std::string scene_file, cells_file;
  std::string cell_list = "all", slice;
  CaptureDensity density;
  std::string engine = "embree", gl = "osmesa";
  std::optional<std::size_t> max_pixels;
  double budget_mb = 512;
};

void declare_arguments(Tool& tool, DepthcapArguments& arguments);

}  // namespace viewcell

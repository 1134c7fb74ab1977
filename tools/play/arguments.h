// What is typed at play.
#pragma once

#include <string>

#include "common/tool.h"
#include "play/session.h"

namespace viewcell {

struct PlayArguments {
  std::string bundle, path_file, modes = "frustum,hybrid", reference = "frustum";
  std::string size = "1024x1024", gl = "osmesa";
  std::string stats_file, plots_folder, sheet_file, table_file;
  double fov_y_deg = 0;
  int texture_mb = 256;
  bool no_quality = false, no_prefetch = false;
  SessionOptions session;
};

void declare_arguments(Tool& tool, PlayArguments& arguments);

/// Sets arguments.session and returns the player's options. Throws UsageError.
PlayerOptions finish_arguments(const Tool& tool, PlayArguments& arguments);

}  // namespace viewcell

// What is typed at uvpatch.
#pragma once

#include <string>

#include "common/tool.h"
#include "uv/textured_patch.h"

namespace viewcell {

struct UvpatchArguments {
  std::string mesh, faces, up = "z", distort = "none", boundary = "circle", texture;
  int size_px = 1024, n_squares = 16;
  TexturedPatchOptions patch;  ///< after finish_arguments
};

void declare_arguments(Tool& tool, UvpatchArguments& arguments);

/// Sets arguments.patch from the words typed. Throws UsageError for what does not fit together.
void finish_arguments(const CommonOptions& common, UvpatchArguments& arguments);

}  // namespace viewcell

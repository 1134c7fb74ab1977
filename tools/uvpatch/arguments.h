// What is typed at uvpatch.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "common/tool.h"
#include "uv/textured_patch.h"

namespace viewcell {

struct UvpatchArguments {
  std::string mesh, faces, up = "z", distort = "none", boundary = "circle", texture;
  std::optional<std::size_t> max_pixels;  ///< of the texture
  int size_px = 1024, n_squares = 16;
  TexturedPatchOptions patch;  ///< after finish_arguments
};

void declare_arguments(Tool& tool, UvpatchArguments& arguments);

/// Sets arguments.patch from the words typed, and registers what is written beside -o, but for a
/// picture that is copied. Throws UsageError for what does not fit together.
void finish_arguments(Tool& tool, UvpatchArguments& arguments);

/// Registers the file beside -o with this extension, unless -o is standard output.
void register_beside(Tool& tool, const std::string& extension);

}  // namespace viewcell

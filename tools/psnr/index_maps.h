// psnr --index-maps: two indexing maps compared.
#pragma once

#include <string>

#include "common/tool.h"

namespace viewcell {

/// Writes the line and the report. inside: a mesh whose charts hold the texels that count; empty:
/// all count. Throws InputError for files that are no maps or of other sizes, and a mesh without
/// texture coordinates.
void compare_index_map_files(const Tool& tool, const std::string& reference,
                             const std::string& tested, const std::string& inside);

}  // namespace viewcell

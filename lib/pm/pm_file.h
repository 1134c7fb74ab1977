// Reads and writes progressive meshes: .pm, a section file (docs/formats.md).
#pragma once

#include <filesystem>

#include "pm/progressive_mesh.h"

namespace viewcell {

/// Whole or not at all.
void write_pm(const std::filesystem::path& file, const ProgressiveRecord& record);

/// Throws InputError for a file that is not whole, or whose splits cannot be made.
ProgressiveRecord read_pm(const std::filesystem::path& file);

}  // namespace viewcell

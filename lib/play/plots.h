// Line plots along the camera path, as SVG.
#pragma once

#include <filesystem>

#include "play/timeline.h"

namespace viewcell {

/// frame_ms.svg, triangles.svg, psnr.svg, psnr_covered.svg into the folder, which is made: every
/// mode in each, the reference left out of the PSNR, the yardstick dashed. Marks: changes of cell.
void write_plots(const std::filesystem::path& folder, const Timeline& timeline);

}  // namespace viewcell

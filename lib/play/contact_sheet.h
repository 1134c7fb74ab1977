// Chosen frames side by side: one row a frame, one column a mode, and the differences.
#pragma once

#include <string>
#include <vector>

#include "image/image.h"

namespace viewcell {

struct SheetRow {
  std::string label;                 ///< "frame 120, 41.2 s, cell 77"
  std::vector<ImageRgba8> pictures;  ///< one a column; all of the same size; empty: left blank
  std::vector<std::string> notes;    ///< under each picture, "37.3 dB"; may be fewer
};

struct SheetOptions {
  int tile_px = 384;  ///< width of a picture on the sheet; larger ones are averaged down
};

/// Opaque. The same rows give the same bytes.
ImageRgba8 make_contact_sheet(const std::vector<std::string>& columns,
                              const std::vector<SheetRow>& rows, const SheetOptions& options = {});

/// Averages encoded values over the area that each new pixel covers; never enlarges.
ImageRgba8 shrink_to_width(const ImageRgba8& image, int width_px);

}  // namespace viewcell

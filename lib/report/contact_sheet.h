// Pictures side by side: frames of several modes, views of a mesh.
#pragma once

#include <string>
#include <vector>

#include "base/remarks.h"
#include "image/image.h"

namespace viewcell {

struct SheetRow {
  std::string label;                 ///< "frame 120, 41.2 s, cell 77"; no line when all are empty
  std::vector<ImageRgba8> pictures;  ///< one a column; all of the same size; empty: left blank
  std::vector<std::string> notes;    ///< under each picture, "37.3 dB"; may be fewer
};

/// What a colour means, for the line below all.
struct SheetKey {
  Rgba8 color{};
  std::string words;
};

struct SheetOptions {
  int tile_px = 384;  ///< width of a picture on the sheet; larger ones are averaged down
  std::vector<SheetKey> key = {};
  Remarks* remarks = nullptr;  ///< letters that show as boxes (report/label.h)
};

/// Opaque. The same rows give the same bytes.
ImageRgba8 make_contact_sheet(const std::vector<std::string>& columns,
                              const std::vector<SheetRow>& rows, const SheetOptions& options = {});

/// Cuts all to the smallest rectangle that holds every pixel with alpha of any, a few pixels wider:
/// they still show the same view. All must be of one size; empty ones, and pictures all without
/// alpha, stay.
void trim_alike(std::vector<ImageRgba8>& pictures);

/// Pixels without alpha get the sheet's colour and are opaque.
void lay_on_paper(ImageRgba8& picture);

/// Keeps so many bits of each channel but alpha, in [1, 8], white and black as they are: fewer make
/// smaller files.
void round_channels(ImageRgba8& image, int n_bits);

/// Averages encoded values over the area that each new pixel covers; never enlarges.
ImageRgba8 shrink_to_width(const ImageRgba8& image, int width_px);

}  // namespace viewcell

// Letters beyond ASCII, from a font of the system's.
#pragma once

#include <cstdint>
#include <vector>

namespace viewcell {

/// How much of each pixel a letter covers, row by row; its upper left corner lies at (left, top)
/// from where the letter's cell begins and its baseline is.
struct Glyph {
  int width_px = 0, height_px = 0, left_px = 0, top_px = 0;
  std::vector<std::uint8_t> coverage;
};

/// DejaVu Sans Mono (Debian: fonts-dejavu-core), the first of a few usual places, read once.
bool has_font();

/// The letter in a font whose letters are advance_px wide. False when the font has none such, or
/// there is no font.
bool draw_glyph(char32_t letter, int advance_px, Glyph& out);

}  // namespace viewcell

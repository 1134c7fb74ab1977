// Words in pictures: ASCII from a font of 5 x 7 dots, other letters from a font of the system's.
#pragma once

#include <cstddef>
#include <string>

#include "base/remarks.h"
#include "image/image.h"

namespace viewcell {

/// Dots from the start of one character to the next, and height of a line.
inline constexpr int kGlyphWidth = 6, kGlyphHeight = 8;

/// Width of the text (UTF-8) in pixels, each dot scale x scale.
int label_width(const std::string& text, int scale = 1);

/// Writes the text with its upper left corner at (x, y); what falls outside is cut. Accents that
/// stand behind their letters are drawn over them. Bytes that are no UTF-8 show as '?', letters
/// that no font has (report/font.h) as a box, which is remarked.
void draw_label(ImageRgba8& image, int x, int y, const std::string& text, const Rgba8& color,
                int scale = 1, Remarks* remarks = nullptr);

}  // namespace viewcell

// Words in pictures, from a font of 5 x 7 dots.
#pragma once

#include <string>

#include "image/image.h"

namespace viewcell {

/// Dots from the start of one character to the next, and height of a line.
inline constexpr int kGlyphWidth = 6, kGlyphHeight = 8;

/// Width of the text in pixels, each dot scale x scale.
inline int label_width(const std::string& text, int scale = 1) {
  return static_cast<int>(text.size()) * kGlyphWidth * scale;
}

/// Writes the text with its upper left corner at (x, y); what falls outside is cut. ASCII; other
/// bytes show as '?'.
void draw_label(ImageRgba8& image, int x, int y, const std::string& text, const Rgba8& color,
                int scale = 1);

}  // namespace viewcell

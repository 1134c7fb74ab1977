// Pieces of SVG text, for drawings that programs make.
#pragma once

#include <string>

namespace viewcell {

/// As text or an attribute of XML: markup escaped, control characters as spaces, bytes that are not
/// UTF-8 as '?'.
std::string svg_escape(const std::string& text);

/// One decimal, never "-0.0": a coordinate in px.
std::string svg_number(double x_px);

/// attributes: further ones, for example "stroke=\"#888\"".
std::string svg_line(double x0, double y0, double x1, double y1, const std::string& attributes);

/// anchor: start | middle | end.
std::string svg_text(double x, double y, const std::string& anchor, const std::string& text,
                     const std::string& attributes = "");

/// A picture of that size on white, 12 px sans-serif in dark gray, with a title for screen readers.
std::string svg_document(double width_px, double height_px, const std::string& title,
                         const std::string& content);

/// No less than the width of text in px, in most sans-serif fonts.
double svg_text_width(const std::string& text, double font_px = 12);

}  // namespace viewcell

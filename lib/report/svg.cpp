#include "report/svg.h"

#include <algorithm>
#include <cstdio>

namespace viewcell {
namespace {

constexpr double kSvgGlyphWidth = 0.61;  // of the font's size: DejaVu Sans, a wide one, on average

bool is_continuation(unsigned char byte) {
  return (byte & 0xc0) == 0x80;
}

// Bytes of the UTF-8 sequence at `at`; 0 where there is none. Overlong forms and surrogates do not
// matter to who reads the picture, XML's forbidden U+FFFE and U+FFFF neither.
std::size_t utf8_length(const std::string& text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t n = lead < 0x80                    ? 1
                        : lead >= 0xc2 && lead <= 0xdf ? 2
                        : (lead & 0xf0) == 0xe0        ? 3
                        : lead >= 0xf0 && lead <= 0xf4 ? 4
                                                       : 0;
  if (n == 0 || at + n > text.size()) return 0;
  for (std::size_t k = 1; k < n; ++k)
    if (!is_continuation(static_cast<unsigned char>(text[at + k]))) return 0;
  return n;
}

std::string escape_ascii(char c) {
  switch (c) {
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '&':
      return "&amp;";
    case '"':
      return "&quot;";
    default:
      return std::string(1, static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c);
  }
}

}  // namespace

std::string svg_escape(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t n = utf8_length(text, at);
    if (n == 0)
      out += '?';
    else if (n == 1)
      out += escape_ascii(text[at]);
    else
      out += text.substr(at, n);
    at += std::max<std::size_t>(n, 1);
  }
  return out;
}

std::string svg_number(double x_px) {
  char text[400];
  std::snprintf(text, sizeof text, "%.1f", x_px);
  return std::string(text) == "-0.0" ? "0.0" : text;
}

std::string svg_line(double x0, double y0, double x1, double y1, const std::string& attributes) {
  return "<line x1=\"" + svg_number(x0) + "\" y1=\"" + svg_number(y0) + "\" x2=\"" +
         svg_number(x1) + "\" y2=\"" + svg_number(y1) + "\" " + attributes + "/>\n";
}

std::string svg_text(double x, double y, const std::string& anchor, const std::string& text,
                     const std::string& attributes) {
  return "<text x=\"" + svg_number(x) + "\" y=\"" + svg_number(y) + "\" text-anchor=\"" + anchor +
         "\"" + (attributes.empty() ? "" : " " + attributes) + ">" + svg_escape(text) + "</text>\n";
}

std::string svg_document(double width_px, double height_px, const std::string& title,
                         const std::string& content) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + svg_number(width_px) + " " +
         svg_number(height_px) +
         "\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#333\" role=\"img\">\n<title>" +
         svg_escape(title) + "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" +
         content + "</svg>\n";
}

double svg_text_width(const std::string& text, double font_px) {
  const auto n = std::count_if(text.begin(), text.end(), [](char c) {
    return !is_continuation(static_cast<unsigned char>(c));
  });
  return kSvgGlyphWidth * font_px * static_cast<double>(n);
}

}  // namespace viewcell

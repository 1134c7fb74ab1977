#include "cells/map.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cstdio>

#include "cells/small_scene.h"

namespace viewcell {
namespace {

// The tags of a text as XML has them: balanced, attributes quoted, no stray < or &.
// Returns the first fault, or "".
std::string find_xml_fault(const std::string& text) {
  std::vector<std::string> open;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '&' && text.find(';', i) > i + 6) return "a stray &";
    if (text[i] != '<') continue;
    std::size_t end = i + 1;
    char quote = 0;
    for (; end < text.size() && (quote || text[end] != '>'); ++end) {
      if (text[end] == '<') return "< inside a tag";
      if (quote && text[end] == quote)
        quote = 0;
      else if (!quote && (text[end] == '\'' || text[end] == '"'))
        quote = text[end];
    }
    if (end == text.size()) return "a tag without an end";
    const std::string tag = text.substr(i + 1, end - i - 1);
    const std::string name =
        tag.substr(tag[0] == '/', tag.find_first_of(" /", 1) - (tag[0] == '/'));
    if (name.empty() || !std::isalpha(static_cast<unsigned char>(name[0]))) return "tag " + tag;
    if (tag[0] == '/') {
      if (open.empty() || open.back() != name) return "</" + name + "> closes nothing";
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    i = end;
  }
  return open.empty() ? "" : "<" + open.back() + "> stays open";
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(DrawMap, IsWellFormedAndComplete) {
  const Scene scene = make_box_scene({{0, 0}, {240, 200}}, {{10, 10, 0}, {100, 90, 0}});
  const CellSet cells = make_cells(scene, 50, {16, 20});
  const CameraPath path{{{0, {0, 0, 18}, {1, 0, 0}}, {9, {150, 20, 18}, {1, 0, 0}}}};
  const std::string svg = draw_map(scene, cells, &path);
  EXPECT_EQ(find_xml_fault(svg), "");
  EXPECT_EQ(svg.substr(0, 5), "<svg ");
  EXPECT_EQ(count(svg, "<polygon"), 12u + 2u);
  EXPECT_EQ(count(svg, "<polyline"), 1u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  const std::string without = draw_map(scene, cells, nullptr);
  EXPECT_EQ(find_xml_fault(without), "");
  EXPECT_EQ(count(without, "<polyline"), 0u);
}

// The cell with the greatest figure is the deepest blue, one with none the palest.
TEST(DrawMap, ColoursByTheFigure) {
  const Scene scene = make_box_scene({{0, 0}, {240, 200}}, {});
  const CellSet cells = make_cells(scene, 50, {16, 20});
  MapOptions options{"triangles", std::vector<double>(12, 0)};
  options.values[3] = 1234;
  const std::string svg = draw_map(scene, cells, nullptr, options);
  EXPECT_EQ(count(svg, "#2166ac"), 1u);
  EXPECT_EQ(count(svg, "#f7fbff"), 11u);
  EXPECT_NE(svg.find("cell 3: 1234"), std::string::npos);
  EXPECT_NE(svg.find("coloured by triangles"), std::string::npos);
}

// The number behind `key='` in the text from `at` on.
double attribute(const std::string& svg, std::size_t at, const std::string& key) {
  return std::stod(svg.substr(svg.find(key + "='", at) + key.size() + 2));
}

// Whatever the size: each cell has its number, and the words find room within the picture.
TEST(DrawMap, NumbersAndCaptionFindRoom) {
  for (const double size : {0.01, 50.0, 4000.0}) {
    SCOPED_TRACE(size);
    const Scene scene = make_box_scene({{0, 0}, {0.5 * size, 0.5 * size}}, {});
    const CellSet cells = make_cells(scene, size, {0, 1});
    const std::string svg = draw_map(scene, cells, nullptr);
    EXPECT_EQ(find_xml_fault(svg), "");
    EXPECT_EQ(count(svg, "<text "), static_cast<std::size_t>(cells.grid.n_cells()) + 1);
    EXPECT_EQ(count(svg, ">0</text>"), 1u);
    double x = 0, y = 0, width = 0, height = 0;
    ASSERT_EQ(std::sscanf(svg.c_str() + svg.find("viewBox='") + 9, "%lf %lf %lf %lf", &x, &y,
                          &width, &height),
              4);
    for (std::size_t at = svg.find("<text "); at != std::string::npos;
         at = svg.find("<text ", at + 1)) {
      const std::string words =
          svg.substr(svg.find('>', at) + 1, svg.find("</text>", at) - svg.find('>', at) - 1);
      const double letters = attribute(svg, at, "font-size");
      const bool is_caption = words.find("cells of size") != std::string::npos;
      const double half = 0.5 * 0.6 * letters * double(words.size());
      const double left = attribute(svg, at, " x") - (is_caption ? 0 : half);
      EXPECT_GE(left, x) << words;
      EXPECT_LE(left + 2 * half, x + width) << words;
      EXPECT_GE(attribute(svg, at, " y") - letters, y) << words;
      EXPECT_LE(attribute(svg, at, " y"), y + height) << words;
    }
  }
}

// Names come from scene.json.
TEST(DrawMap, NamesAreEscaped) {
  Scene scene = make_box_scene({{0, 0}, {240, 200}}, {{10, 10, 0}});
  scene.meshes[0].name = "a<b & </svg>";
  const CellSet cells = make_cells(scene, 50, {16, 20});
  const std::string svg = draw_map(scene, cells, nullptr, {"x < y & z", {}});
  EXPECT_EQ(find_xml_fault(svg), "");
  EXPECT_NE(svg.find("a&lt;b &amp; &lt;/svg&gt;"), std::string::npos);
  scene.meshes[0].name = "no\x01text\xff";  // neither is XML
  EXPECT_NE(draw_map(scene, cells, nullptr).find("no text?"), std::string::npos);
}

}  // namespace
}  // namespace viewcell

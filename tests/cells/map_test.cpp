#include "cells/map.h"

#include <gtest/gtest.h>

#include <cctype>

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

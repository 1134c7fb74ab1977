#include "cells/map.h"

#include <algorithm>
#include <cstdio>

#include "report/svg.h"

namespace viewcell {
namespace {

std::string format(const char* pattern, double a, double b = 0) {
  char text[96];
  std::snprintf(text, sizeof text, pattern, a, b);
  return text;
}

// Lengths of strokes and letters are of a map with cells of this size.
constexpr double kDrawnFor = 50;

std::string points(const std::vector<glm::dvec2>& polygon) {
  std::string out;
  for (const glm::dvec2& p : polygon) out += format("%.9g,%.9g ", p.x, -p.y);
  return out;
}

std::string text_at(const glm::dvec2& at, double size, const std::string& attributes,
                    const std::string& words) {
  return format("<text x='%.9g' y='%.9g' ", at.x, -at.y) + "font-family='sans-serif'" +
         format(" font-size='%.6g'", size) + attributes + ">" + svg_escape(words) + "</text>\n";
}

// From pale to deep blue; t in [0, 1].
std::string color_of(double t) {
  const auto mix = [&](int a, int b) { return static_cast<int>(a + (b - a) * t); };
  char text[32];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", mix(247, 33), mix(251, 102), mix(255, 172));
  return text;
}

void draw_cells(const CellSet& cells, const std::vector<double>& values, std::string& svg) {
  const double most = std::max(1e-12, *std::max_element(values.begin(), values.end()));
  svg += "<g stroke='#9ab'" + format(" stroke-width='%.6g'>\n", cells.grid.size / kDrawnFor);
  for (int i = 0; i < cells.grid.n_cells(); ++i) {
    const double value = values[static_cast<std::size_t>(i)];
    svg += "<polygon points='" + points(corners_of(cells.grid, coord_of(cells.grid, CellId(i)))) +
           "' fill='" + color_of(std::clamp(value / most, 0.0, 1.0)) + "'><title>cell " +
           std::to_string(i) + ": " + format("%g", value) + "</title></polygon>\n";
  }
  svg += "</g>\n";
}

// What --cells takes. Beyond some thousand cells nobody could read them.
void draw_ids(const CellSet& cells, std::string& svg) {
  constexpr int kMostNumbered = 5000;
  const HexGrid& grid = cells.grid;
  if (grid.n_cells() > kMostNumbered) return;
  svg += "<g fill='#567' text-anchor='middle'>\n";
  for (int i = 0; i < grid.n_cells(); ++i) {
    glm::dvec2 middle(0);
    for (const glm::dvec2& corner : corners_of(grid, coord_of(grid, CellId(i))))
      middle += corner / 6.0;
    svg +=
        text_at(middle - glm::dvec2(0, 0.1 * grid.size), 0.32 * grid.size, "", std::to_string(i));
  }
  svg += "</g>\n";
}

void draw_objects(const Scene& scene, double unit, std::string& svg) {
  constexpr const char* kColors[] = {"#b3261e", "#e08e0b", "#6a4c93", "#7a4b22",
                                     "#2e7d32", "#455a64", "#c2185b", "#00838f"};
  svg += "<g stroke='#222' fill-opacity='0.85'" + format(" stroke-width='%.6g'>\n", 0.5 * unit);
  const auto footprints = make_footprints(scene);
  for (std::size_t o = 0; o < footprints.size(); ++o) {
    const SceneObject& object = scene.objects[o];
    svg += std::string("<polygon points='") + points(footprints[o]) + "' fill='" +
           kColors[index(object.mesh) % std::size(kColors)] + "'><title>object " +
           std::to_string(o) + ": " + svg_escape(scene.mesh_of(object).name) +
           "</title></polygon>\n";
  }
  svg += "</g>\n";
}

void draw_path(const CameraPath& path, double unit, std::string& svg) {
  std::vector<glm::dvec2> line;
  for (const PathSample& sample : path.samples) line.emplace_back(sample.eye);
  svg += "<polyline points='" + points(line) + "' fill='none' stroke='red'" +
         format(" stroke-width='%.6g'/>\n", 4 * unit);
  svg += format("<circle cx='%.9g' cy='%.9g' ", line[0].x, -line[0].y) +
         format("r='%.6g' fill='red'/>\n", 8 * unit);
}

}  // namespace

std::string draw_map(const Scene& scene, const CellSet& cells, const CameraPath* path,
                     const MapOptions& options) {
  std::vector<double> values = options.values;
  for (std::size_t i = 0; values.size() < cells.inside.size(); ++i)
    values.push_back(static_cast<double>(cells.inside[i].size()));
  const double s = cells.grid.size, unit = s / kDrawnFor;
  const std::string caption = std::to_string(cells.grid.columns) + " x " +
                              std::to_string(cells.grid.rows) + " cells of size " +
                              format("%g", s) + ", coloured by " + options.figure;
  glm::dvec2 lo = scene.area.lo - glm::dvec2(1.5 * s);
  const double width = scene.area.hi.x - scene.area.lo.x + 3 * s;
  // As large as finds room; below all.
  const double letters = std::min(36 * unit, 0.96 * width / svg_text_width(caption, 1));
  lo.y -= 1.5 * letters;
  const glm::dvec2 size(width, scene.area.hi.y + 1.5 * s - lo.y);
  std::string svg = "<svg xmlns='http://www.w3.org/2000/svg' width='900' viewBox='" +
                    format("%.9g %.9g ", lo.x, -lo.y - size.y) +
                    format("%.9g %.9g", size.x, size.y) + "'>\n<rect " +
                    format("x='%.9g' y='%.9g' ", lo.x, -lo.y - size.y) +
                    format("width='%.9g' height='%.9g' fill='white'/>\n", size.x, size.y);
  draw_cells(cells, values, svg);
  svg += format("<rect x='%.9g' y='%.9g' ", scene.area.lo.x, -scene.area.hi.y) +
         format("width='%.9g' height='%.9g' fill='none' stroke='#333'",
                scene.area.hi.x - scene.area.lo.x, scene.area.hi.y - scene.area.lo.y) +
         format(" stroke-width='%.6g'/>\n", 2 * unit);
  draw_objects(scene, unit, svg);
  draw_ids(cells, svg);
  if (path) draw_path(*path, unit, svg);
  svg += text_at({lo.x + 0.02 * width, lo.y + 0.4 * letters}, letters, "", caption) + "</svg>\n";
  return svg;
}

}  // namespace viewcell

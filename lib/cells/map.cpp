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

std::string points(const std::vector<glm::dvec2>& polygon) {
  std::string out;
  for (const glm::dvec2& p : polygon) out += format("%.2f,%.2f ", p.x, -p.y);
  return out;
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
  svg += "<g stroke='#9ab' stroke-width='1'>\n";
  for (int i = 0; i < cells.grid.n_cells(); ++i) {
    const double value = values[static_cast<std::size_t>(i)];
    svg += "<polygon points='" + points(corners_of(cells.grid, coord_of(cells.grid, CellId(i)))) +
           "' fill='" + color_of(std::clamp(value / most, 0.0, 1.0)) + "'><title>cell " +
           std::to_string(i) + ": " + format("%g", value) + "</title></polygon>\n";
  }
  svg += "</g>\n";
}

void draw_objects(const Scene& scene, std::string& svg) {
  constexpr const char* kColors[] = {"#b3261e", "#e08e0b", "#6a4c93", "#7a4b22",
                                     "#2e7d32", "#455a64", "#c2185b", "#00838f"};
  svg += "<g stroke='#222' stroke-width='0.5' fill-opacity='0.85'>\n";
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

void draw_path(const CameraPath& path, std::string& svg) {
  std::vector<glm::dvec2> line;
  for (const PathSample& sample : path.samples) line.emplace_back(sample.eye);
  svg += "<polyline points='" + points(line) + "' fill='none' stroke='red' stroke-width='4'/>\n";
  svg += format("<circle cx='%.2f' cy='%.2f' r='8' fill='red'/>\n", line[0].x, -line[0].y);
}

}  // namespace

std::string draw_map(const Scene& scene, const CellSet& cells, const CameraPath* path,
                     const MapOptions& options) {
  std::vector<double> values = options.values;
  for (std::size_t i = 0; values.size() < cells.inside.size(); ++i)
    values.push_back(static_cast<double>(cells.inside[i].size()));
  const double s = cells.grid.size;
  const glm::dvec2 lo = scene.area.lo - glm::dvec2(1.5 * s);
  const glm::dvec2 size = scene.area.hi - scene.area.lo + glm::dvec2(3 * s);
  std::string svg = "<svg xmlns='http://www.w3.org/2000/svg' width='900' viewBox='" +
                    format("%.2f %.2f ", lo.x, -lo.y - size.y) +
                    format("%.2f %.2f", size.x, size.y) + "'>\n<rect " +
                    format("x='%.2f' y='%.2f' ", lo.x, -lo.y - size.y) +
                    format("width='%.2f' height='%.2f' fill='white'/>\n", size.x, size.y);
  draw_cells(cells, values, svg);
  svg += format("<rect x='%.2f' y='%.2f' ", scene.area.lo.x, -scene.area.hi.y) +
         format("width='%.2f' height='%.2f' fill='none' stroke='#333' stroke-width='2'/>\n",
                scene.area.hi.x - scene.area.lo.x, scene.area.hi.y - scene.area.lo.y);
  draw_objects(scene, svg);
  if (path) draw_path(*path, svg);
  svg += format("<text x='%.2f' y='%.2f' font-family='sans-serif' font-size='36'>", lo.x + 20,
                -lo.y - 20) +
         std::to_string(cells.grid.columns) + " x " + std::to_string(cells.grid.rows) +
         " cells of size " + format("%g", s) + ", coloured by " + svg_escape(options.figure) +
         "</text>\n</svg>\n";
  return svg;
}

}  // namespace viewcell

// Logs of adaptations that are written by hand, on places of a texture.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "adapt/adaptation.h"

namespace viewcell {

using Place = glm::dvec2;  // texel centres at whole numbers, rows down

struct HandLog {
  int width_px, height_px;
  AdaptationLog log;
  LevelCharts charts;

  HandLog(int width, int height, std::size_t n_charts) : width_px(width), height_px(height) {
    log.first_point = log.first_triangle = {0};
    log.n_charts = n_charts;
  }
  glm::vec2 uv(const Place& p) const {
    return {(p.x + 0.5) / width_px, 1 - (p.y + 0.5) / height_px};
  }
  void add_step(const std::vector<Place>& before, const std::vector<Place>& after,
                const std::vector<AdaptationTriangle>& triangles) {
    for (std::size_t i = 0; i < before.size(); ++i)
      log.points.push_back({uv(before[i]), uv(after[i])});
    log.triangles.insert(log.triangles.end(), triangles.begin(), triangles.end());
    log.first_point.push_back(static_cast<std::uint32_t>(log.points.size()));
    log.first_triangle.push_back(static_cast<std::uint32_t>(log.triangles.size()));
  }
  // A rectangle of two triangles; its outline is the chart's border, or lies inside.
  //   0-1
  //   |\|
  //   3-2
  void add_box(const glm::dvec4& before, const glm::dvec4& after, std::uint32_t chart,
               bool has_border) {
    const auto corners = [](const glm::dvec4& b) {
      return std::vector<Place>{{b.x, b.y}, {b.z, b.y}, {b.z, b.w}, {b.x, b.w}};
    };
    const std::uint16_t first = has_border ? 0b011 : 0, second = has_border ? 0b110 : 0;
    add_step(corners(before), corners(after),
             {{{0, 1, 2}, first, chart}, {{0, 2, 3}, second, chart}});
  }
  void add_chart(const glm::dvec4& box, std::uint32_t chart) {
    const glm::vec2 a = uv({box.x, box.y}), b = uv({box.z, box.y}), c = uv({box.z, box.w}),
                    d = uv({box.x, box.w});
    charts.faces.push_back({a, b, c}), charts.faces.push_back({a, c, d});
    charts.charts.push_back(chart), charts.charts.push_back(chart);
  }
};

}  // namespace viewcell

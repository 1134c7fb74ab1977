// Fans of triangles and what a metric needs of a mesh.
#pragma once

#include <cmath>
#include <vector>

#include "pm/mapping_metric.h"
#include "pm/shapes.h"
#include "pm/texture_fold.h"

namespace viewcell {

// A fan of n triangles around vertex 0; rim vertices 1 ... n. Positions and texture coordinates are
// near a regular n-gon, off by up to `noise`; heights are random.
inline TriMesh make_fan(std::uint32_t n, double noise, double height, Random& random) {
  TriMesh mesh;
  std::vector<glm::vec2> uv;
  const auto add = [&](double x, double y) {
    const auto off = [&] { return random.uniform(-noise, noise); };
    mesh.positions.emplace_back(x + off(), y + off(), random.uniform(-height, height));
    uv.emplace_back(x + off(), y + off());
  };
  add(0, 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 6.283185307179586 * i / n;
    add(std::cos(angle), std::sin(angle));
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
    for (const std::uint32_t v : mesh.triangles.back()) mesh.texcoords.push_back(uv[v]);
  }
  return mesh;
}

// The parts that a metric needs.
struct Parts {
  WedgeMesh wedges;
  std::vector<Triangle> triangles;
  CollapseMesh mesh;
  WedgeTable table;
  explicit Parts(const TriMesh& input)
      : wedges(make_wedges(input)),
        triangles(wedges.vertex_triangles()),
        mesh(wedges.positions, triangles),
        table(wedges) {}
  bool turns_over(std::uint32_t u, std::uint32_t v) {
    if (!table.match(mesh, u, v)) return false;
    std::vector<glm::vec2> merged;
    for (const auto& pair : table.pairs()) merged.push_back(wedges.texcoords[pair.to]);
    return turns_over_texture(mesh, table, wedges.texcoords, u, v, merged, false);
  }
  MappingMetric metric(Matching matching, bool total) {
    return {mesh,
            table,
            wedges.positions,
            wedges.texcoords,
            triangles,
            {.matching = matching, .total = total}};
  }
};

}  // namespace viewcell

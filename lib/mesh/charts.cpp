#include "mesh/charts.h"

#include <algorithm>

#include "base/disjoint_sets.h"
#include "mesh/edges.h"

namespace viewcell {
namespace {

bool has_texture(const Triangle& t) {
  return std::find(t.begin(), t.end(), kNoTextureVertex) == t.end();
}

// Sets of triangles.
DisjointSets join_at_edges(const std::vector<Triangle>& texture_vertices) {
  DisjointSets sets(texture_vertices.size());
  TriMesh mesh;
  for (const Triangle& t : texture_vertices)
    mesh.triangles.push_back(has_texture(t) ? t : Triangle{});  // no edges
  const EdgeTable edges = build_edge_table(mesh);
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const std::uint32_t half : edges.halves(e)) sets.join(edges.halves(e)[0] / 3, half / 3);
  return sets;
}

// Sets of texture vertices.
DisjointSets join_at_corners(const std::vector<Triangle>& texture_vertices, std::size_t n) {
  DisjointSets sets(n);
  for (const Triangle& t : texture_vertices) {
    if (!has_texture(t)) continue;
    sets.join(t[0], t[1]);
    sets.join(t[0], t[2]);
  }
  return sets;
}

}  // namespace

Charts connect_charts(const std::vector<Triangle>& texture_vertices, std::size_t n_texture_vertices,
                      ChartLink link) {
  const bool by_corner = link == ChartLink::corner;
  DisjointSets sets = by_corner ? join_at_corners(texture_vertices, n_texture_vertices)
                                : join_at_edges(texture_vertices);
  Charts charts;
  charts.of.assign(texture_vertices.size(), kNoChart);
  std::vector<std::uint32_t> chart_of(by_corner ? n_texture_vertices : texture_vertices.size(),
                                      kNoChart);  // by set
  for (std::uint32_t t = 0; t < texture_vertices.size(); ++t) {
    if (!has_texture(texture_vertices[t])) continue;
    std::uint32_t& chart = chart_of[sets.find(by_corner ? texture_vertices[t][0] : t)];
    if (chart == kNoChart) {
      chart = static_cast<std::uint32_t>(charts.size());
      charts.first.push_back(t);
    }
    charts.of[t] = chart;
  }
  return charts;
}

}  // namespace viewcell

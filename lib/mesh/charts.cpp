#include "mesh/charts.h"

#include <algorithm>

#include "base/disjoint_sets.h"
#include "mesh/edges.h"

namespace viewcell {
namespace {

bool has_texture(const Triangle& t) {
  return std::find(t.begin(), t.end(), kNoTextureVertex) == t.end();
}

void join_at_corners(const std::vector<Triangle>& texture_vertices, std::size_t n_texture_vertices,
                     DisjointSets& sets) {
  std::vector<std::uint32_t> first_at(n_texture_vertices, kNoChart);  // triangle
  for (std::uint32_t t = 0; t < texture_vertices.size(); ++t) {
    if (!has_texture(texture_vertices[t])) continue;
    for (const std::uint32_t v : texture_vertices[t]) {
      if (first_at[v] == kNoChart) first_at[v] = t;
      sets.join(first_at[v], t);
    }
  }
}

void join_at_edges(const std::vector<Triangle>& texture_vertices, DisjointSets& sets) {
  TriMesh mesh;
  for (const Triangle& t : texture_vertices)
    mesh.triangles.push_back(has_texture(t) ? t : Triangle{});  // no edges
  const EdgeTable edges = build_edge_table(mesh);
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const std::uint32_t half : edges.halves(e)) sets.join(edges.halves(e)[0] / 3, half / 3);
}

}  // namespace

Charts connect_charts(const std::vector<Triangle>& texture_vertices, std::size_t n_texture_vertices,
                      ChartLink link) {
  DisjointSets sets(texture_vertices.size());
  if (link == ChartLink::corner)
    join_at_corners(texture_vertices, n_texture_vertices, sets);
  else
    join_at_edges(texture_vertices, sets);
  Charts charts;
  charts.of.assign(texture_vertices.size(), kNoChart);
  for (std::uint32_t t = 0; t < texture_vertices.size(); ++t) {
    if (!has_texture(texture_vertices[t])) continue;
    const std::uint32_t root = sets.find(t);  // the lowest
    if (root == t) charts.first.push_back(t);
    charts.of[t] = root == t ? static_cast<std::uint32_t>(charts.size() - 1) : charts.of[root];
  }
  return charts;
}

}  // namespace viewcell

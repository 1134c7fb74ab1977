#include "pm/simplify.h"

#include <algorithm>

#include "pm/qem.h"

namespace viewcell {

SimplifyResult compact(const TriMesh& mesh, const std::vector<Triangle>& triangles) {
  constexpr std::uint32_t kUnused = 0xffffffffu;
  std::vector<std::uint32_t> place(mesh.positions.size(), kUnused);
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) place[v] = 0;
  SimplifyResult result;
  for (std::uint32_t v = 0; v < place.size(); ++v) {
    if (place[v] == kUnused) continue;
    place[v] = static_cast<std::uint32_t>(result.source_vertex.size());
    result.source_vertex.push_back(v);
    result.mesh.positions.push_back(mesh.positions[v]);
    if (!mesh.normals.empty()) result.mesh.normals.push_back(mesh.normals[v]);
    if (!mesh.colors.empty()) result.mesh.colors.push_back(mesh.colors[v]);
  }
  result.mesh.triangles.reserve(triangles.size());
  for (const Triangle& t : triangles)
    result.mesh.triangles.push_back({place[t[0]], place[t[1]], place[t[2]]});
  return result;
}

SimplifyResult simplify(const TriMesh& mesh, const SimplifyOptions& options) {
  CollapseMesh work(mesh.positions, mesh.triangles);
  QemMetric metric(mesh.positions, mesh.triangles);
  CollapseLoop loop(work, metric);
  const CollapseCounts counts =
      loop.run({.target_triangles = options.target_triangles, .max_cost = options.max_error});
  SimplifyResult result = compact(mesh, work.triangles());
  result.error = counts.last_cost;
  result.counts = counts;
  return result;
}

std::vector<Level> build_levels(const TriMesh& mesh, std::size_t min_triangles) {
  CollapseMesh work(mesh.positions, mesh.triangles);
  QemMetric metric(mesh.positions, mesh.triangles);
  CollapseLoop loop(work, metric);
  std::vector<Level> levels{{work.triangles(), 0}};
  while (work.n_triangles() / 2 >= min_triangles) {
    const std::size_t before = work.n_triangles();
    const CollapseCounts counts = loop.run({.target_triangles = before / 2});
    if (counts.n_collapses == 0) break;
    levels.push_back({work.triangles(), std::max(levels.back().error, counts.last_cost)});
    if (work.n_triangles() > before * 9 / 10) break;  // all but stuck
  }
  return levels;
}

}  // namespace viewcell

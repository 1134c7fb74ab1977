#include "pm/simplify.h"

#include <algorithm>
#include <utility>

#include "mesh/used_vertices.h"
#include "pm/qem.h"

namespace viewcell {

SimplifyResult simplify(const TriMesh& mesh, const SimplifyOptions& options) {
  CollapseMesh work(mesh.positions, mesh.triangles);
  QemMetric metric(mesh.positions, mesh.triangles);
  CollapseLoop loop(work, metric);
  const CollapseCounts counts =
      loop.run({.target_triangles = options.target_triangles, .max_cost = options.max_error});
  CompactMesh left = compact(mesh, work.triangles());
  return {std::move(left.mesh), std::move(left.source_vertex), counts.last_cost, counts};
}

namespace {

class LevelsMetric : public QemMetric {
 public:
  LevelsMetric(const TriMesh& mesh, const LevelsOptions& options)
      : QemMetric(mesh.positions, mesh.triangles), options_(options) {}

  float cost(std::uint32_t u, std::uint32_t v) const {
    const bool stays = !options_.is_locked.empty() && options_.is_locked[u];
    return stays ? std::numeric_limits<float>::infinity() : QemMetric::cost(u, v);
  }
  bool allows(const CollapseMesh& mesh, std::uint32_t u, std::uint32_t v) const {
    return !options_.keep_parts || !mesh.is_lone_triangle(u, v);
  }

 private:
  const LevelsOptions& options_;
};

}  // namespace

std::vector<Level> build_levels(const TriMesh& mesh, const LevelsOptions& options) {
  CollapseMesh work(mesh.positions, mesh.triangles);
  LevelsMetric metric(mesh, options);
  CollapseLoop loop(work, metric);
  std::vector<Level> levels{{work.triangles(), work.triangle_numbers(), 0}};
  while (work.n_triangles() / 2 >= options.min_triangles) {
    const std::size_t before = work.n_triangles();
    const CollapseCounts counts = loop.run({.target_triangles = before / 2});
    if (counts.n_collapses == 0) break;
    levels.push_back({work.triangles(), work.triangle_numbers(),
                      std::max(levels.back().error, counts.last_cost)});
    if (work.n_triangles() > before * 9 / 10) break;  // all but stuck
  }
  return levels;
}

}  // namespace viewcell

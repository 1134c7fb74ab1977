#include "mesh/optimize.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "base/error.h"
#include "mesh/used_vertices.h"

namespace viewcell {
namespace {

static_assert(sizeof(Triangle) == 3 * sizeof(unsigned));
static_assert(sizeof(glm::vec3) == 3 * sizeof(float));

const unsigned* flat(const std::vector<Triangle>& triangles) {
  return triangles.data()->data();
}
unsigned* flat(std::vector<Triangle>& triangles) {
  return triangles.data()->data();
}
const float* flat(const std::vector<glm::vec3>& positions) {
  return &positions.data()->x;
}

// ---- levels ----

// One level of about n_target triangles; the error is relative to the mesh's extent.
DetailLevel simplify_once(const TriMesh& mesh, std::size_t n_target, float& relative_error) {
  constexpr float kAnyError = 1.0f;  // the whole extent
  DetailLevel level;
  level.triangles.resize(mesh.triangles.size());
  const std::size_t n_indices = meshopt_simplify(
      flat(level.triangles), flat(mesh.triangles), 3 * mesh.triangles.size(), flat(mesh.positions),
      mesh.positions.size(), sizeof(glm::vec3), 3 * n_target, kAnyError, 0, &relative_error);
  level.triangles.resize(n_indices / 3);
  return level;
}

}  // namespace

std::vector<Triangle> optimize_index_order(const std::vector<Triangle>& triangles,
                                           std::size_t n_vertices) {
  if (triangles.empty()) return {};
  std::vector<Triangle> out(triangles.size());
  meshopt_optimizeVertexCache(flat(out), flat(triangles), 3 * triangles.size(), n_vertices);
  return out;
}

std::vector<std::uint32_t> make_fetch_order(const std::vector<Triangle>& triangles,
                                            std::size_t n_vertices) {
  UsedVertices used = find_used_vertices(triangles, n_vertices, VertexOrder::first_use);
  auto n = static_cast<std::uint32_t>(used.size());
  for (std::uint32_t& id : used.new_index)
    if (id == kUnusedVertex) id = n++;
  return std::move(used.new_index);
}

std::vector<DetailLevel> build_meshopt_levels(const TriMesh& all, const DetailOptions& options) {
  VIEWCELL_CHECK(options.ratio > 0 && options.ratio < 1, options.ratio);
  // A vertex that no triangle uses, at the place of one that some do, would hold that one where it
  // is.
  const UsedVertices used = find_used_vertices(all.triangles, all.positions.size());
  const bool is_compact = used.size() == all.positions.size();
  TriMesh compacted;
  if (!is_compact) {
    compacted.positions = used.pick(all.positions);
    compacted.triangles = used.renumber(all.triangles);
  }
  const TriMesh& mesh = is_compact ? all : compacted;
  constexpr double kLeastGain = 0.95;  // a level of hardly fewer triangles is not worth keeping
  std::vector<DetailLevel> levels(1);
  levels[0].triangles = optimize_index_order(mesh.triangles, mesh.positions.size());
  if (mesh.triangles.empty()) return levels;
  const double scale =
      meshopt_simplifyScale(flat(mesh.positions), mesh.positions.size(), sizeof(glm::vec3));
  while (static_cast<int>(levels.size()) < options.n_most) {
    const std::size_t n_finer = levels.back().triangles.size();
    const auto n_target = static_cast<std::size_t>(static_cast<double>(n_finer) * options.ratio);
    if (n_target < options.min_triangles) break;
    float relative_error = 0;
    DetailLevel level = simplify_once(mesh, n_target, relative_error);
    if (level.triangles.empty() ||
        static_cast<double>(level.triangles.size()) > kLeastGain * static_cast<double>(n_finer))
      break;
    level.triangles = optimize_index_order(level.triangles, mesh.positions.size());
    level.error = std::max(levels.back().error, scale * static_cast<double>(relative_error));
    levels.push_back(std::move(level));
  }
  if (is_compact) return levels;
  for (DetailLevel& level : levels)
    for (Triangle& t : level.triangles)
      for (std::uint32_t& v : t) v = used.source[v];
  return levels;
}

}  // namespace viewcell

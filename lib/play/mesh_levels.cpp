#include "play/mesh_levels.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "base/error.h"
#include "base/parallel.h"

namespace viewcell {
namespace {

constexpr unsigned kUnused = ~0u;

unsigned* indices_of(std::vector<Triangle>& triangles) {
  return triangles.data()->data();
}
const unsigned* indices_of(const std::vector<Triangle>& triangles) {
  return triangles.data()->data();
}

// As many triangles of the mesh as asked for, or as few as simplification reaches.
std::vector<Triangle> simplify_to(const TriMesh& mesh, std::size_t n_triangles, double& error) {
  std::vector<Triangle> out(mesh.triangles.size());
  float relative_error = 0;
  const std::size_t n = meshopt_simplify(
      indices_of(out), indices_of(mesh.triangles), 3 * mesh.triangles.size(), &mesh.positions[0].x,
      mesh.positions.size(), sizeof(glm::vec3), 3 * n_triangles, 1e30f, 0, &relative_error);
  out.resize(n / 3);
  error = static_cast<double>(relative_error) *
          static_cast<double>(meshopt_simplifyScale(&mesh.positions[0].x, mesh.positions.size(),
                                                    sizeof(glm::vec3)));
  return out;
}

}  // namespace

TriMesh optimise_order(const TriMesh& mesh) {
  VIEWCELL_CHECK(mesh.normals.size() == mesh.positions.size(), mesh.normals.size(),
                 mesh.positions.size());
  TriMesh out;
  if (mesh.triangles.empty()) return out;
  const std::size_t n_indices = 3 * mesh.triangles.size(), n_vertices = mesh.positions.size();
  out.triangles.resize(mesh.triangles.size());
  meshopt_optimizeVertexCache(indices_of(out.triangles), indices_of(mesh.triangles), n_indices,
                              n_vertices);
  std::vector<unsigned> place(n_vertices);
  const std::size_t n_used = meshopt_optimizeVertexFetchRemap(
      place.data(), indices_of(out.triangles), n_indices, n_vertices);
  out.positions.resize(n_used);
  out.normals.resize(n_used);
  for (std::size_t v = 0; v < n_vertices; ++v) {
    if (place[v] == kUnused) continue;
    out.positions[place[v]] = mesh.positions[v];
    out.normals[place[v]] = mesh.normals[v];
  }
  for (Triangle& t : out.triangles) t = {place[t[0]], place[t[1]], place[t[2]]};
  return out;
}

MeshLevels make_single_level(const TriMesh& mesh) {
  MeshLevels levels(1);
  levels[0].mesh = optimise_order(mesh);
  return levels;
}

MeshLevels build_mesh_levels(const TriMesh& mesh, const LevelOptions& options) {
  MeshLevels levels = make_single_level(mesh);
  double wanted = static_cast<double>(mesh.triangles.size());
  while (static_cast<int>(levels.size()) < options.n_levels) {
    wanted *= options.ratio;
    if (wanted < static_cast<double>(options.fewest)) break;
    TriMesh coarse{mesh.positions, mesh.normals, {}, {}, {}, {}, {}};
    double error = 0;
    coarse.triangles = simplify_to(mesh, static_cast<std::size_t>(wanted), error);
    // Stuck: topology keeps the simplifier from going on.
    if (coarse.triangles.size() * 10 > levels.back().mesh.triangles.size() * 9) break;
    if (coarse.triangles.empty()) break;
    levels.push_back({optimise_order(coarse), std::max(error, levels.back().error)});
  }
  return levels;
}

std::vector<MeshLevels> build_scene_levels(const Scene& scene, bool with_lod,
                                           const LevelOptions& options, int n_threads) {
  std::vector<MeshLevels> levels(scene.meshes.size());
  parallel_for(scene.meshes.size(), n_threads, [&](std::size_t i) {
    const TriMesh& mesh = scene.meshes[i].mesh;
    levels[i] = with_lod ? build_mesh_levels(mesh, options) : make_single_level(mesh);
  });
  return levels;
}

}  // namespace viewcell

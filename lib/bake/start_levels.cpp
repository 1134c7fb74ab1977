#include "bake/start_levels.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "mesh/edges.h"
#include "mesh/topology.h"
#include "mesh/used_vertices.h"
#include "pm/simplify.h"

namespace viewcell {
namespace {

// Vertices of two objects' rims nearer than this share of the scene's size are at one place: the
// rounding of positions and of the objects' placement.
constexpr double kSamePlace = 1e-6;

// A mesh's surface over welded vertices; of twins the first stands for both.
struct Surface {
  TriMesh mesh;               // positions and triangles
  std::vector<bool> is_twin;  // by triangle; or empty
};

Surface make_surface(const SceneMesh& mesh) {
  Surface out;
  out.mesh.positions = mesh.mesh.positions;
  out.mesh.triangles = mesh.weld.weld(mesh.mesh.triangles);
  if (!mesh.has_twins) return out;
  const std::vector<Triangle> all = std::exchange(out.mesh.triangles, {});
  const std::vector<std::uint32_t> twins = match_twins(all, mesh.mesh.positions.size());
  for (std::uint32_t t = 0; t < all.size(); ++t) {
    const bool has_twin = twins[t] != kNoTwin;
    if (has_twin && twins[t] < t) continue;
    out.mesh.triangles.push_back(all[t]);
    out.is_twin.push_back(has_twin);
  }
  return out;
}

std::vector<bool> find_rim(const TriMesh& surface) {
  std::vector<bool> is_rim(surface.positions.size(), false);
  const EdgeTable edges = build_edge_table(surface);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges.halves(e).size() != 1) continue;
    const auto [a, b] = edges.ends(e, surface);
    is_rim[a] = is_rim[b] = true;
  }
  return is_rim;
}

// ---- rims that objects share ----

struct RimVertex {
  glm::i64vec3 box;  // of a grid of boxes
  std::uint32_t object, vertex;
  glm::dvec3 at;
  auto key() const { return std::tie(box.x, box.y, box.z, object, vertex); }
};

std::vector<RimVertex> gather_rims(const Scene& scene, const std::vector<std::vector<bool>>& rims,
                                   double box_side) {
  std::vector<RimVertex> out;
  for (std::uint32_t o = 0; o < scene.objects.size(); ++o) {
    const SceneObject& object = scene.objects[o];
    const std::vector<bool>& is_rim = rims[index(object.mesh)];
    const std::vector<glm::vec3>& positions = scene.mesh_of(object).mesh.positions;
    for (std::uint32_t v = 0; v < is_rim.size(); ++v) {
      if (!is_rim[v]) continue;
      const glm::dvec3 at = object.world_from_model(glm::dvec3(positions[v]));
      out.push_back({glm::i64vec3(glm::floor(at / box_side)), o, v, at});
    }
  }
  std::sort(out.begin(), out.end(),
            [](const RimVertex& a, const RimVertex& b) { return a.key() < b.key(); });
  return out;
}

// Whether another object's rim has a vertex at that place.
bool is_met(const std::vector<RimVertex>& sorted, const RimVertex& rim, double tolerance) {
  for (int k = 0; k < 27; ++k) {
    const glm::i64vec3 box = rim.box + glm::i64vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    const auto place = [](const RimVertex& r) { return std::tie(r.box.x, r.box.y, r.box.z); };
    auto other =
        std::lower_bound(sorted.begin(), sorted.end(), std::tie(box.x, box.y, box.z),
                         [&](const RimVertex& r, const auto& wanted) { return place(r) < wanted; });
    for (; other != sorted.end() && other->box == box; ++other)
      if (other->object != rim.object && glm::distance(other->at, rim.at) <= tolerance) return true;
  }
  return false;
}

// By mesh and vertex, where there are any: in some object it meets another's rim.
std::vector<std::vector<std::uint8_t>> find_shared_rims(
    const Scene& scene, const std::vector<std::vector<bool>>& rims) {
  std::vector<std::vector<std::uint8_t>> out(scene.meshes.size());
  Box box;
  for (const SceneObject& object : scene.objects) {
    const Box own = world_box(scene, object);
    box.add(own.lo), box.add(own.hi);
  }
  const double tolerance = kSamePlace * glm::length(box.size());
  if (!(tolerance > 0)) return out;
  const std::vector<RimVertex> all = gather_rims(scene, rims, tolerance);
  for (const RimVertex& rim : all) {
    std::vector<std::uint8_t>& is_shared = out[index(scene.objects[rim.object].mesh)];
    if (!is_met(all, rim, tolerance)) continue;
    if (is_shared.empty()) is_shared.assign(rims[index(scene.objects[rim.object].mesh)].size(), 0);
    is_shared[rim.vertex] = 1;
  }
  return out;
}

// ---- parts and levels ----

double area_of(const TriMesh& mesh, const Triangle& t) {
  return 0.5 * glm::length(area_normal(mesh, t));
}

MeshParts find_parts(const TriMesh& surface) {
  const std::size_t n = surface.positions.size();
  DisjointSets sets(n);
  for (const Triangle& t : surface.triangles) sets.join(t[0], t[1]), sets.join(t[0], t[2]);
  MeshParts out;
  out.of_vertex.resize(n);
  std::vector<Box> boxes;
  for (std::uint32_t v = 0; v < n; ++v) {
    const std::uint32_t lowest = sets.find(v);
    if (lowest == v) {
      out.of_vertex[v] = static_cast<std::uint32_t>(boxes.size());
      boxes.emplace_back();
    } else {
      out.of_vertex[v] = out.of_vertex[lowest];
    }
    boxes[out.of_vertex[v]].add(glm::dvec3(surface.positions[v]));
  }
  for (const Box& box : boxes) out.diagonals.push_back(glm::length(box.size()));
  out.areas.assign(boxes.size(), 0);
  for (const Triangle& t : surface.triangles) out.areas[out.of_vertex[t[0]]] += area_of(surface, t);
  return out;
}

// Of the parts that are small beside the error: the share of their area that the level lacks.
double measure_loss(const TriMesh& surface, const std::vector<Triangle>& level,
                    const MeshParts& parts, double error) {
  const auto is_small = [&](std::uint32_t part) {
    return parts.diagonals[part] < kSmallPart * error;
  };
  double before = 0, after = 0;
  for (std::uint32_t p = 0; p < parts.areas.size(); ++p)
    if (is_small(p)) before += parts.areas[p];
  if (!(before > 0)) return 0;
  for (const Triangle& t : level)
    if (is_small(parts.of_vertex[t[0]])) after += area_of(surface, t);
  return 1 - after / before;
}

StartLevels build_levels_of(const SceneMesh& mesh, const Surface& surface, bool has_rim,
                            const std::vector<std::uint8_t>& is_shared) {
  StartLevels out;
  out.parts = find_parts(surface.mesh);
  TriMesh shown = surface.mesh;  // with the surface's normals
  shown.normals = mesh.weld.is_empty() ? mesh.mesh.normals : mesh.weld.normals;
  for (const Level& level :
       build_levels(surface.mesh, {.is_locked = is_shared, .keep_parts = true})) {
    CompactMesh compacted = compact(shown, level.triangles);
    StartLevel& to = out.levels.emplace_back();
    to.error = level.error;
    to.has_rim = has_rim;
    to.lost_share = measure_loss(surface.mesh, level.triangles, out.parts, level.error);
    for (const std::uint32_t t : level.source_triangle)
      if (!surface.is_twin.empty()) to.is_twin.push_back(surface.is_twin[t]);
    for (const std::uint32_t v : compacted.source_vertex)
      if (!is_shared.empty()) to.is_shared.push_back(is_shared[v] != 0);
    to.mesh = std::move(compacted.mesh);
    to.source_vertex = std::move(compacted.source_vertex);
  }
  return out;
}

}  // namespace

std::vector<StartLevels> build_start_levels(const Scene& scene, int n_threads) {
  const std::size_t n = scene.meshes.size();
  std::vector<Surface> surfaces(n);
  std::vector<std::vector<bool>> rims(n);
  parallel_for(n, n_threads, [&](std::size_t m) {
    surfaces[m] = make_surface(scene.meshes[m]);
    rims[m] = find_rim(surfaces[m].mesh);
  });
  const std::vector<std::vector<std::uint8_t>> shared = find_shared_rims(scene, rims);
  std::vector<StartLevels> out(n);
  parallel_for(n, n_threads, [&](std::size_t m) {
    const bool has_rim = std::find(rims[m].begin(), rims[m].end(), true) != rims[m].end();
    out[m] = build_levels_of(scene.meshes[m], surfaces[m], has_rim, shared[m]);
  });
  return out;
}

}  // namespace viewcell

#include "bake/cell_mesh.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "capture/view.h"
#include "cells/self_occluding.h"
#include "mesh/used_vertices.h"
#include "pm/simplify.h"
#include "visibility/regional.h"

namespace viewcell {
namespace {

// The ball around the cell's prism.
struct Ball {
  glm::dvec3 centre{0};
  double radius = 0;
};

Ball ball_of(const CellSet& cells, CellId cell) {
  const double half_height = 0.5 * (cells.eye_height.hi - cells.eye_height.lo);
  return {eye_of(cells, cell), std::hypot(cells.grid.size, half_height)};
}

double distance_to(const Box& box, const glm::dvec3& p) {
  return glm::length(glm::max(glm::max(box.lo - p, p - box.hi), glm::dvec3(0)));
}

// The coarsest level whose error, seen from the nearest point of the cell, stays below
// start_error_px.
const StartLevel& choose_start(const BakeScene& bake, CellId cell, ObjectId id,
                               const BakeOptions& options) {
  const SceneObject& object = bake.scene.objects[index(id)];
  const Ball ball = ball_of(bake.cells, cell);
  const double distance =
      std::max(distance_to(bake.boxes[index(id)], ball.centre) - ball.radius, bake.cells.near);
  const double px_per_unit = focal_of_face(options.resolution_px) / distance * object.scale;
  const auto& levels = bake.levels[index(object.mesh)];
  std::size_t best = 0;
  for (std::size_t i = 1; i < levels.size(); ++i)
    if (levels[i].error * px_per_unit < options.start_error_px) best = i;
  return levels[best];
}

// The level's vertices in the world.
ViewVertices place_vertices(const TriMesh& mesh, const SceneObject& object) {
  ViewVertices out;
  out.positions.reserve(mesh.positions.size());
  out.normals.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions)
    out.positions.emplace_back(object.world_from_model(glm::dvec3(p)));
  for (const glm::vec3& n : mesh.normals) out.normals.emplace_back(object.rotation * glm::dvec3(n));
  return out;
}

std::vector<bool> find_back_faces(const BakeScene& bake, CellId cell, const SceneObject& object,
                                  const std::vector<glm::vec3>& positions,
                                  const std::vector<Triangle>& triangles) {
  if (bake.scene.material_of(object).double_sided)
    return std::vector<bool>(triangles.size(), false);  // both sides are seen
  return find_regional_back_faces(positions, triangles, prism_of(bake.cells, cell));
}

// Whether the object as captured from the cell's centre alone leaves no hole of T_s or more.
bool needs_one_view(const BakeScene& bake, CellId cell, const CellObject& object,
                    const BakeOptions& options) {
  const glm::dvec3 centre = ball_of(bake.cells, cell).centre;
  const std::vector<glm::vec3>& positions = object.vertices.positions;
  const std::vector<glm::dvec3> points(positions.begin(), positions.end());
  if (!choose_view(centre, points, {.resolution_px = options.resolution_px})) return false;
  const ObjectDepth depth =
      measure_depth(centre, positions, object.level->mesh.triangles, object.is_back_facing);
  const double s = self_occluding_error_px(bake.cells.grid.size, depth.nearest, depth.depth,
                                           options.resolution_px);
  return s < options.ts_px;
}

// Points spread evenly over the cell's hexagon, at the eye's middle height.
std::vector<glm::dvec3> sample_cell(const CellSet& cells, CellId cell) {
  const glm::dvec3 centre = ball_of(cells, cell).centre;
  std::vector<glm::dvec3> samples{centre};
  for (const double share : {0.45, 0.85})
    for (const glm::dvec2& corner : corners_of(cells.grid, coord_of(cells.grid, cell)))
      samples.emplace_back(glm::mix(glm::dvec2(centre), corner, share), centre.z);
  return samples;
}

ViewMetricOptions make_metric_options(const BakeScene& bake, CellId cell, Representation kind,
                                      const BakeOptions& options) {
  const Ball ball = ball_of(bake.cells, cell);
  ViewMetricOptions metric;
  metric.centre = ball.centre;
  metric.radius = ball.radius;
  metric.samples = sample_cell(bake.cells, cell);
  metric.focal_px = focal_of_face(options.resolution_px);
  metric.keep_common_views = kind == Representation::multi_view;
  metric.tl_px = options.tl_px;
  metric.max_drift_px = options.max_drift_px;
  return metric;
}

// What is left after collapsing and culling, renumbered.
CellMesh gather(const ViewVertices& all, const std::vector<std::uint32_t>& source_vertex,
                const std::vector<Triangle>& triangles, const std::vector<bool>& is_culled) {
  std::vector<Triangle> left;
  CellMesh out;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (is_culled[t]) continue;
    left.push_back(triangles[t]);
    unsigned views = 0x7f;
    for (const std::uint32_t v : triangles[t]) views &= all.views[v];
    out.views.push_back(static_cast<std::uint8_t>(views));
  }
  const UsedVertices used = find_used_vertices(left, all.positions.size(), VertexOrder::first_use);
  out.triangles = used.renumber(left);
  out.source_vertex = used.pick(source_vertex);
  out.vertices = {used.pick(all.positions), used.pick(all.normals), used.pick(all.weights),
                  used.pick(all.views)};
  return out;
}

std::vector<StartLevel> build_start_levels(const TriMesh& mesh) {
  std::vector<StartLevel> out;
  for (const Level& level : build_levels(mesh)) {
    CompactMesh compacted = compact(mesh, level.triangles);
    out.push_back({std::move(compacted.mesh), std::move(compacted.source_vertex), level.error});
  }
  return out;
}

}  // namespace

BakeScene build_bake_scene(const Scene& scene, const CellSet& cells, int n_threads) {
  BakeScene bake{scene, cells, {}, {}};
  bake.levels.resize(scene.meshes.size());
  parallel_for(scene.meshes.size(), n_threads,
               [&](std::size_t m) { bake.levels[m] = build_start_levels(scene.meshes[m].mesh); });
  for (const SceneObject& object : scene.objects) bake.boxes.push_back(world_box(scene, object));
  return bake;
}

CellObject choose_representation(const BakeScene& bake, CellId cell, ObjectId id,
                                 const BakeOptions& options) {
  CellObject out;
  out.object = id;
  if (is_inside(bake.cells, cell, id)) return out;
  const SceneObject& object = bake.scene.objects[index(id)];
  out.level = &choose_start(bake, cell, id, options);
  const std::vector<Triangle>& triangles = out.level->mesh.triangles;
  out.vertices = place_vertices(out.level->mesh, object);
  out.is_back_facing = find_back_faces(bake, cell, object, out.vertices.positions, triangles);
  out.kind = needs_one_view(bake, cell, out, options) ? Representation::single_view
                                                      : Representation::multi_view;
  return out;
}

CellMesh derive_mesh(const BakeScene& bake, CellId cell, CellObject object,
                     std::span<const ClassifiedView> views, const BakeOptions& options,
                     CellMeshCounts& counts) {
  VIEWCELL_CHECK(object.kind != Representation::inside && object.level);
  const SceneObject& placed = bake.scene.objects[index(object.object)];
  const std::vector<Triangle>& start = object.level->mesh.triangles;
  ViewVertices& vertices = object.vertices;
  weigh_vertices(start, object.is_back_facing, views, options.weights, vertices);

  const ViewMetricOptions metric_options = make_metric_options(bake, cell, object.kind, options);
  CollapseMesh work(vertices.positions, start);
  ViewMetric metric(vertices, start, metric_options);
  CollapseLoop loop(work, metric);
  counts.collapses = loop.run({.max_cost = static_cast<float>(options.tl_px)});

  const std::vector<Triangle> left = work.triangles();
  for (std::uint32_t v = 0; v < vertices.positions.size(); ++v)
    if (work.has_triangles(v)) vertices.positions[v] += metric.offset(v) * vertices.normals[v];
  CellMesh out = gather(vertices, object.level->source_vertex, left,
                        find_back_faces(bake, cell, placed, vertices.positions, left));
  out.object = object.object;
  counts.n_original = bake.scene.mesh_of(placed).mesh.triangles.size();
  counts.n_start = start.size();
  const std::vector<bool>& back = object.is_back_facing;
  counts.n_back_facing = static_cast<std::size_t>(std::count(back.begin(), back.end(), true));
  counts.n_out = out.triangles.size();
  return out;
}

}  // namespace viewcell

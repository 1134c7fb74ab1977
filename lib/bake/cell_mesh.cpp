#include "bake/cell_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "capture/view.h"
#include "cells/self_occluding.h"
#include "mesh/used_vertices.h"
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

// The coarsest level whose error, seen from the nearest point of the cell, stays below that.
const StartLevel& choose_start(const BakeScene& bake, CellId cell, ObjectId id,
                               const BakeOptions& options, double most_error_px) {
  const SceneObject& object = bake.scene.objects[index(id)];
  const Ball ball = ball_of(bake.cells, cell);
  const double distance =
      std::max(distance_to(bake.boxes[index(id)], ball.centre) - ball.radius, bake.cells.near);
  const double px_per_unit = focal_of_face(options.resolution_px) / distance * object.scale;
  const auto& levels = bake.meshes[index(object.mesh)].levels;
  std::size_t best = 0;
  for (std::size_t i = 1; i < levels.size(); ++i)
    if (levels[i].error * px_per_unit < most_error_px && levels[i].lost_share <= kMostLost)
      best = i;
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
  if (bake.scene.is_double_sided(object))
    return std::vector<bool>(triangles.size(), false);  // both sides are seen
  return find_regional_back_faces(positions, triangles, prism_of(bake.cells, cell));
}

FaceSides find_sides(const BakeScene& bake, CellId cell, const SceneObject& object,
                     const StartLevel& level, const std::vector<glm::vec3>& positions) {
  FaceSides out{find_back_faces(bake, cell, object, positions, level.mesh.triangles),
                level.is_twin};
  if (bake.scene.is_double_sided(object))
    out.is_two_sided.assign(level.mesh.triangles.size(), true);
  for (std::size_t t = 0; t < out.is_two_sided.size(); ++t)
    if (out.is_two_sided[t]) out.is_back_facing[t] = false;
  return out;
}

// Whether the object as captured from the cell's centre alone leaves no hole of T_s or more.
bool needs_one_view(const BakeScene& bake, CellId cell, const CellObject& object,
                    const BakeOptions& options) {
  const glm::dvec3 centre = ball_of(bake.cells, cell).centre;
  const std::vector<glm::vec3>& positions = object.vertices.positions;
  const std::vector<glm::dvec3> points(positions.begin(), positions.end());
  if (!choose_view(centre, points, {.resolution_px = options.resolution_px})) return false;
  const ObjectDepth depth =
      measure_depth(centre, positions, object.level->mesh.triangles, object.sides.is_back_facing);
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

// The parts of a level's surface in the world.
struct SurfaceParts {
  std::vector<std::uint32_t> of_vertex;
  std::vector<double> diagonals;
};

SurfaceParts place_parts(const MeshParts& parts, const StartLevel& level,
                         const SceneObject& object) {
  SurfaceParts out;
  out.of_vertex.reserve(level.source_vertex.size());
  for (const std::uint32_t v : level.source_vertex) out.of_vertex.push_back(parts.of_vertex[v]);
  for (const double diagonal : parts.diagonals) out.diagonals.push_back(diagonal * object.scale);
  return out;
}

// The triangles that collapses have left, twins apart again: over vertices of the level.
std::vector<Triangle> part_twins(const CollapseMesh& work, const std::vector<bool>& is_twin) {
  std::vector<Triangle> out = work.triangles();
  if (is_twin.empty()) return out;
  const std::vector<std::uint32_t> numbers = work.triangle_numbers();
  const std::size_t n = numbers.size();
  for (std::size_t t = 0; t < n; ++t)
    if (is_twin[numbers[t]]) out.push_back({out[t][2], out[t][1], out[t][0]});
  return out;
}

// Triangles over the level's vertices as corners that are drawn, and each of these once, in the
// order of first use.
struct DrawnCorners {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> level_vertex, source_vertex;  // of each
};

DrawnCorners choose_corners(const SceneMesh& mesh, const StartLevel& level,
                            const std::vector<Triangle>& triangles) {
  std::vector<Triangle> of_source = triangles;
  for (Triangle& t : of_source)
    for (std::uint32_t& v : t) v = level.source_vertex[v];
  of_source = choose_drawn_vertices(mesh.mesh, mesh.weld, of_source);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> corners;  // of the level, drawn
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) corners.emplace_back(triangles[t][k], of_source[t][k]);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> each = corners;
  std::sort(each.begin(), each.end());
  each.erase(std::unique(each.begin(), each.end()), each.end());
  std::vector<Triangle> numbered(triangles.size());
  for (std::size_t c = 0; c < corners.size(); ++c)
    numbered[c / 3][c % 3] = static_cast<std::uint32_t>(
        std::lower_bound(each.begin(), each.end(), corners[c]) - each.begin());
  const UsedVertices used = find_used_vertices(numbered, each.size(), VertexOrder::first_use);
  DrawnCorners out{used.renumber(numbered), {}, {}};
  for (const std::uint32_t i : used.source) {
    out.level_vertex.push_back(each[i].first);
    out.source_vertex.push_back(each[i].second);
  }
  return out;
}

// What is left after collapsing and culling, renumbered.
CellMesh gather(const SceneMesh& mesh, const SceneObject& object, const StartLevel& level,
                const ViewVertices& all, const std::vector<Triangle>& triangles,
                const std::vector<bool>& is_culled) {
  std::vector<Triangle> left;
  CellMesh out;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (is_culled[t]) continue;
    left.push_back(triangles[t]);
    unsigned views = 0x7f;
    for (const std::uint32_t v : triangles[t]) views &= all.views[v];
    out.views.push_back(static_cast<std::uint8_t>(views));
  }
  DrawnCorners drawn = choose_corners(mesh, level, left);
  out.triangles = std::move(drawn.triangles);
  for (std::size_t i = 0; i < drawn.level_vertex.size(); ++i) {
    const std::uint32_t v = drawn.level_vertex[i];
    out.vertices.positions.push_back(all.positions[v]);
    out.vertices.normals.emplace_back(object.rotation *
                                      glm::dvec3(mesh.mesh.normals[drawn.source_vertex[i]]));
    out.vertices.weights.push_back(all.weights[v]);
    out.vertices.views.push_back(all.views[v]);
  }
  out.source_vertex = std::move(drawn.source_vertex);
  return out;
}

}  // namespace

BakeScene build_bake_scene(const Scene& scene, const CellSet& cells, int n_threads) {
  BakeScene bake{scene, cells, build_start_levels(scene, n_threads), {}};
  for (const SceneObject& object : scene.objects) bake.boxes.push_back(world_box(scene, object));
  return bake;
}

CellObject choose_representation(const BakeScene& bake, CellId cell, ObjectId id,
                                 const BakeOptions& options) {
  CellObject out;
  out.object = id;
  if (is_original(bake.cells, cell, id)) return out;
  const SceneObject& object = bake.scene.objects[index(id)];
  const bool unseen = is_unseen(bake.cells, cell, id);
  out.level = &choose_start(bake, cell, id, options,
                            unseen ? options.unseen_error_px : options.start_error_px);
  out.vertices = place_vertices(out.level->mesh, object);
  out.sides = find_sides(bake, cell, object, *out.level, out.vertices.positions);
  if (unseen) {
    out.kind = Representation::unseen;
    return out;
  }
  out.kind = needs_one_view(bake, cell, out, options) ? Representation::single_view
                                                      : Representation::multi_view;
  return out;
}

CellMesh derive_mesh(const BakeScene& bake, CellId cell, CellObject object,
                     std::span<const ClassifiedView> views, const BakeOptions& options,
                     CellMeshCounts& counts) {
  VIEWCELL_CHECK(object.kind != Representation::original && object.level);
  const SceneObject& placed = bake.scene.objects[index(object.object)];
  const StartLevel& level = *object.level;
  const std::vector<Triangle>& start = level.mesh.triangles;
  ViewVertices& vertices = object.vertices;
  weigh_vertices(start, object.sides, views, options.weights, vertices);

  ViewMetricOptions metric_options = make_metric_options(bake, cell, object.kind, options);
  const SurfaceParts parts = place_parts(bake.meshes[index(placed.mesh)].parts, level, placed);
  metric_options.parts = parts.of_vertex;
  metric_options.part_diagonals = parts.diagonals;
  metric_options.has_rim = level.has_rim;
  metric_options.is_shared = level.is_shared;
  CollapseMesh work(vertices.positions, start);
  ViewMetric metric(vertices, start, metric_options);
  CollapseLoop loop(work, metric);
  if (object.kind != Representation::unseen)
    counts.collapses = loop.run({.max_cost = static_cast<float>(options.tl_px)});

  const std::vector<Triangle> left = part_twins(work, level.is_twin);
  for (std::uint32_t v = 0; v < vertices.positions.size(); ++v)
    if (work.has_triangles(v)) vertices.positions[v] += metric.offset(v) * vertices.normals[v];
  CellMesh out = gather(bake.scene.mesh_of(placed), placed, level, vertices, left,
                        find_back_faces(bake, cell, placed, vertices.positions, left));
  out.object = object.object;
  counts.n_original = bake.scene.mesh_of(placed).mesh.triangles.size();
  counts.n_start = start.size();
  const std::vector<bool>& back = object.sides.is_back_facing;
  counts.n_back_facing = static_cast<std::size_t>(std::count(back.begin(), back.end(), true));
  counts.n_out = out.triangles.size();
  return out;
}

}  // namespace viewcell

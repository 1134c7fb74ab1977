#include "cells/cells.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace viewcell {
namespace {

constexpr const char* kFormat = "viewcell-cells";

// How far the near plane's corner is from the eye: the eye may stand on the cell's edge.
double near_corner_distance(double near) {
  const double half = std::tan(glm::radians(kFovYDeg) / 2);
  return near * std::sqrt(1 + 2 * half * half);
}

ConvexPolygon make_footprint(const Scene& scene, const SceneObject& object) {
  std::vector<glm::dvec2> points;
  for (const glm::vec3& p : scene.mesh_of(object).mesh.positions)
    points.emplace_back(object.world_from_model(glm::dvec3(p)));
  return convex_hull(std::move(points));
}

// The second adds what the cells see and what is drawn as it is; without them the first is written.
constexpr JsonVersions kVersions{1, 2};

std::vector<ObjectId> read_objects(const JsonCursor& cursor, std::size_t n_objects) {
  std::vector<ObjectId> ids;
  const std::size_t n = cursor.size(n_objects);
  for (std::size_t i = 0; i < n; ++i) {
    const auto id = cursor.at(i).integer(0, static_cast<std::int64_t>(n_objects) - 1);
    ids.push_back(ObjectId(id));
    if (i > 0 && ids[i] <= ids[i - 1]) cursor.at(i).fail("is not in ascending order");
  }
  return ids;
}

void refuse_inside(const JsonCursor& list, const std::vector<ObjectId>& objects,
                   const CellSet& cells) {
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (is_inside(cells, CellId(cells.inside.size() - 1), objects[i]))
      list.at(i).fail("is inside the cell");
}

void read_own(const JsonCursor& cell, CellSet& cells) {
  if (!cell.has("own")) return;
  cells.own.resize(static_cast<std::size_t>(cells.grid.n_cells()));
  std::vector<ObjectId>& own = cells.own[cells.inside.size() - 1];
  own = read_objects(cell.at("own"), cells.n_objects);
  refuse_inside(cell.at("own"), own, cells);
}

void read_unseen(const JsonCursor& cell, CellSet& cells) {
  cells.is_tested.push_back(cell.has("unseen"));
  std::vector<ObjectId>& unseen = cells.unseen.emplace_back();
  if (!cells.is_tested.back()) return;
  unseen = read_objects(cell.at("unseen"), cells.n_objects);
  refuse_inside(cell.at("unseen"), unseen, cells);
}

Json format_objects(const std::vector<ObjectId>& ids) {
  Json out = Json::array();
  for (const ObjectId id : ids) out.push_back(static_cast<int>(id));
  return out;
}

Json format_cell(const CellSet& cells, CellId cell) {
  const HexCoord hex = coord_of(cells.grid, cell);
  const glm::dvec2 centre = centre_of(cells.grid, hex);
  Json neighbours = Json::array();
  for (int face = 0; face < 6; ++face) {
    const auto next = cell_at(cells.grid, neighbour(hex, face));
    neighbours.push_back(next ? static_cast<int>(*next) : -1);
  }
  Json out = {{"id", static_cast<int>(cell)},
              {"centre", {centre.x, centre.y}},
              {"neighbours", neighbours},
              {"inside", format_objects(cells.inside[index(cell)])}};
  if (!cells.own.empty() && !cells.own[index(cell)].empty())
    out["own"] = format_objects(cells.own[index(cell)]);
  if (!cells.is_tested.empty() && cells.is_tested[index(cell)])
    out["unseen"] = format_objects(cells.unseen[index(cell)]);
  return out;
}

}  // namespace

std::vector<ConvexPolygon> make_footprints(const Scene& scene) {
  std::vector<ConvexPolygon> footprints;
  for (const SceneObject& object : scene.objects)
    footprints.push_back(make_footprint(scene, object));
  return footprints;
}

CellSet make_cells(const Scene& scene, double size, const EyeHeight& eye_height) {
  CellSet cells;
  cells.grid = make_grid(scene.area, size);
  cells.eye_height = eye_height;
  cells.scene_hash = scene.hash;
  cells.n_objects = scene.objects.size();
  const auto footprints = make_footprints(scene);
  const double margin = near_corner_distance(cells.near);
  for (int i = 0; i < cells.grid.n_cells(); ++i) {
    const ConvexPolygon hexagon = corners_of(cells.grid, coord_of(cells.grid, CellId(i)));
    std::vector<ObjectId> inside;
    for (std::size_t o = 0; o < footprints.size(); ++o)
      if (distance(hexagon, footprints[o]) <= margin) inside.push_back(ObjectId(o));
    cells.inside.push_back(std::move(inside));
  }
  return cells;
}

bool is_inside(const CellSet& cells, CellId cell, ObjectId object) {
  const auto& inside = cells.inside[index(cell)];
  return std::binary_search(inside.begin(), inside.end(), object);
}

bool is_unseen(const CellSet& cells, CellId cell, ObjectId object) {
  if (cells.unseen.empty()) return false;
  const auto& unseen = cells.unseen[index(cell)];
  return std::binary_search(unseen.begin(), unseen.end(), object);
}

bool is_original(const CellSet& cells, CellId cell, ObjectId object) {
  if (is_inside(cells, cell, object)) return true;
  if (cells.own.empty()) return false;
  const auto& own = cells.own[index(cell)];
  return std::binary_search(own.begin(), own.end(), object) && !is_unseen(cells, cell, object);
}

std::vector<ObjectId> originals_of(const CellSet& cells, CellId cell) {
  std::vector<ObjectId> out = cells.inside[index(cell)];
  if (cells.own.empty()) return out;
  for (const ObjectId object : cells.own[index(cell)])
    if (!is_unseen(cells, cell, object)) out.push_back(object);
  std::sort(out.begin(), out.end());
  return out;
}

void check_tested(const CellSet& cells, const std::vector<CellId>& list,
                  const std::filesystem::path& file) {
  if (cells.is_tested.empty()) return;
  for (const CellId cell : list)
    if (!cells.is_tested[index(cell)])
      throw InputError(file.string(), "cells[" + std::to_string(static_cast<int>(cell)) + "]",
                       "was not tested for what it sees, as others were; run pvs with the same "
                       "--cells");
}

std::vector<glm::dvec3> prism_of(const CellSet& cells, CellId cell) {
  std::vector<glm::dvec3> corners;
  for (const double z : {cells.eye_height.lo, cells.eye_height.hi})
    for (const glm::dvec2& p : corners_of(cells.grid, coord_of(cells.grid, cell)))
      corners.emplace_back(p, z);
  return corners;
}

glm::dvec3 eye_of(const CellSet& cells, CentreId centre) {
  return {centre_of(cells.grid, coord_of(cells.grid, centre)), cells.eye_height.middle()};
}

glm::dvec3 eye_of(const CellSet& cells, CellId cell) {
  return eye_of(cells, views_of(cells.grid, cell)[0]);
}

CellSet read_cells(const std::filesystem::path& file) {
  CellSet cells;
  const Json json = read_json(file, kFormat, kVersions, "", &cells.file_hash);
  const JsonCursor root(json, file);
  cells.scene_hash = root.at("scene_hash").string();
  cells.n_objects = static_cast<std::size_t>(root.at("objects").integer(0, 1 << 24));
  const auto origin = root.at("origin").numbers(2, -1e9, 1e9);
  cells.grid.origin = {origin[0], origin[1]};
  cells.grid.size = root.at("size").number(1e-6, 1e9);
  cells.grid.columns = static_cast<int>(root.at("columns").integer(1, 10000));
  cells.grid.rows = static_cast<int>(root.at("rows").integer(1, 10000));
  const auto height = root.at("eye_height").numbers(2, -1e9, 1e9);
  cells.eye_height = {height[0], height[1]};
  if (height[0] > height[1]) root.at("eye_height").fail("is not LO, HI with LO <= HI");
  cells.near = root.at("near").number(1e-9, 1e6);
  const bool is_second = root.at("version").integer(kVersions.first, kVersions.last) == 2;
  const bool has_tests = is_second && root.has("seen_by");
  if (has_tests) cells.seen_by = root.at("seen_by").value();
  const JsonCursor list = root.at("cells");
  if (list.size() != static_cast<std::size_t>(cells.grid.n_cells()))
    list.fail("has " + std::to_string(list.size()) + " cells, not columns x rows");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const JsonCursor cell = list.at(i);
    cell.at("id").integer(static_cast<std::int64_t>(i), static_cast<std::int64_t>(i));
    cells.inside.push_back(read_objects(cell.at("inside"), cells.n_objects));
    if (is_second) read_own(cell, cells);
    if (has_tests) read_unseen(cell, cells);
  }
  return cells;
}

Json format_cells(const CellSet& cells, const Json& provenance) {
  Json list = Json::array();
  for (int i = 0; i < cells.grid.n_cells(); ++i) list.push_back(format_cell(cells, CellId(i)));
  const bool has_tests = !cells.is_tested.empty();
  const bool has_own = std::any_of(cells.own.begin(), cells.own.end(),
                                   [](const std::vector<ObjectId>& own) { return !own.empty(); });
  Json out = {{"format", kFormat},
              {"version", has_tests || has_own ? kVersions.last : kVersions.first},
              {"made_by", provenance},
              {"scene_hash", cells.scene_hash},
              {"objects", cells.n_objects},
              {"size", cells.grid.size},
              {"origin", {cells.grid.origin.x, cells.grid.origin.y}},
              {"columns", cells.grid.columns},
              {"rows", cells.grid.rows},
              {"eye_height", {cells.eye_height.lo, cells.eye_height.hi}},
              {"near", cells.near}};
  if (has_tests) out["seen_by"] = cells.seen_by;
  out["cells"] = list;
  return out;
}

void check_cells_of_scene(const CellSet& cells, const Scene& scene,
                          const std::filesystem::path& file) {
  if (cells.scene_hash != scene.hash)
    throw InputError(file.string(), "scene_hash",
                     "was made for another scene (" + cells.scene_hash + ", not " + scene.hash +
                         "); run hexcells again");
}

}  // namespace viewcell

// View cells of a scene: the grid, the eye's heights, and what stands inside each cell.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "cells/grid.h"
#include "scene/camera.h"

namespace viewcell {

struct EyeHeight {
  double lo = 16, hi = 20;  ///< above z = 0, the park's units
  double middle() const { return 0.5 * (lo + hi); }
};

struct CellSet {
  HexGrid grid;
  EyeHeight eye_height;
  double near = kNear;     ///< distance of the player's near plane
  std::string scene_hash;  ///< of the scene that it was made for
  std::string file_hash;   ///< hash_hex() of the bytes of cells.json; empty: not read from a file
  std::size_t n_objects = 0;
  std::vector<std::vector<ObjectId>> inside;  ///< per cell, ascending
  /// Per cell, ascending: objects outside that are drawn as they are, too (cells/own_materials.h).
  /// Empty: no cell has any.
  std::vector<std::vector<ObjectId>> own;
  /// Which cells were tested for what they see (visibility/seen_objects.h), and the objects outside
  /// that each of these never sees, ascending. Both empty: no cell was, and each sees all.
  std::vector<bool> is_tested;
  std::vector<std::vector<ObjectId>> unseen;
  Json seen_by;  ///< how they were tested
};

/// The convex hulls of the objects' footprints in the x-y plane, one an object.
std::vector<ConvexPolygon> make_footprints(const Scene& scene);

/// Makes a grid that covers the scene's area. An object is inside a cell when its footprint's hull
/// meets the closed hexagon widened by the corner of the near plane (docs/formats.md, cells.json).
CellSet make_cells(const Scene& scene, double size, const EyeHeight& eye_height);

bool is_inside(const CellSet& cells, CellId cell, ObjectId object);
bool is_unseen(const CellSet& cells, CellId cell, ObjectId object);
/// What is drawn as it is: what is inside, and of what is outside those of `own` that may be seen.
bool is_original(const CellSet& cells, CellId cell, ObjectId object);
std::vector<ObjectId> originals_of(const CellSet& cells, CellId cell);  ///< ascending
/// Throws InputError when some of the cells were tested for what they see, but not all of the list:
/// their captures would lack what the others see.
void check_tested(const CellSet& cells, const std::vector<CellId>& list,
                  const std::filesystem::path& file);

/// The corner points of the prism in which the eye moves: six at the low eye height, six at the
/// high.
std::vector<glm::dvec3> prism_of(const CellSet& cells, CellId cell);
/// The point that a centre's captures are seen from: mid-height.
glm::dvec3 eye_of(const CellSet& cells, CentreId centre);
/// Of the cell's own centre.
glm::dvec3 eye_of(const CellSet& cells, CellId cell);

/// cells.json, read and written.
CellSet read_cells(const std::filesystem::path& file);
Json format_cells(const CellSet& cells, const Json& provenance);
/// Throws InputError unless the cells were made for this scene.
void check_cells_of_scene(const CellSet& cells, const Scene& scene,
                          const std::filesystem::path& file);

/// Parses --cells: "all", "3,7,10-19", "@FILE" (such a list in a file) or "path:path.json" (the
/// cells that a camera path passes through), then keeps slice i of n ("I/N", 1 <= I <= N; empty:
/// all): every n-th cell of the list, from the i-th on. Throws UsageError for a malformed list,
/// InputError for a cell out of range.
std::vector<CellId> select_cells(const CellSet& cells, const std::string& list,
                                 const std::string& slice = "");

/// The centres whose captures those cells need: of their closed neighbourhoods, ascending.
std::vector<CentreId> centres_of(const CellSet& cells, const std::vector<CellId>& list);

}  // namespace viewcell

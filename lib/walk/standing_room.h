// Where one can stand in a scene, on a grid of points.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "cells/cells.h"
#include "scene/scene.h"

namespace viewcell {

/// What a walker needs, in the scene's units. Of an eye at 1.6 m: 25 cm, 35 cm and 30 cm.
struct WalkerOptions {
  double spacing = 2.8;    ///< of the grid's points
  double clearance = 3.9;  ///< nothing stands nearer, between knee and eye
  double step = 3.4;       ///< from one point to the next
};
/// Those lengths for an eye at that height.
WalkerOptions walker_of(double eye_height);

/// One number a point, row by row.
struct StandingRoom {
  static constexpr int kSightBlock = 4;
  glm::dvec2 origin{0};  ///< of point (0, 0)
  double spacing = 1;
  int columns = 0, rows = 0;
  std::vector<float> floor_z;         ///< where is_free
  std::vector<std::uint8_t> is_free;  ///< one can stand there
  /// How much there is to see, of what stands around, within 25 times the eye's height: [0, 1].
  /// One number a block of kSightBlock x kSightBlock points, row by row.
  std::vector<float> sight;
  std::vector<std::uint8_t> is_open;  ///< by block: nothing is above
  double step = 0;

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  glm::dvec2 place(std::size_t point) const;
  float sight_at(std::size_t point) const { return sight[block_of(point)]; }
  std::size_t block_of(std::size_t point) const;
  int block_columns() const { return (columns + kSightBlock - 1) / kSightBlock; }
  int block_rows() const { return (rows + kSightBlock - 1) / kSightBlock; }
  /// The points one step away: of eight neighbours those that are free, and no higher or lower than
  /// a step; a diagonal one only where both points beside it are, too.
  std::vector<std::size_t> neighbours(std::size_t point) const;
  /// The free point nearest to a place; nothing where none is.
  std::optional<std::size_t> nearest(const glm::dvec2& place) const;
};

/// Points of the cells' area where, looking down from the middle of the eye's heights, the first
/// surface faces upwards (or is the ground, where there is none; unless a tenth of the places where
/// one can stand have a surface: then bare ground is none, as it is what lies under hollow houses
/// and around levels) and is so far below that the eye
/// stays within the heights that are baked; and where nothing is near at the heights of knee, chest
/// and eye. Backs of surfaces count: an eye inside a wall does not stand. The scene's meshes must
/// be there. Same for any n_threads (0: all).
StandingRoom find_standing_room(const Scene& scene, const CellSet& cells,
                                const WalkerOptions& options, int n_threads = 0);

/// Of each point that is free, the number of its connected part, the largest one 0; others -1. A
/// point under the open sky counts five times: of a street and the hollow houses beside it one
/// walks in the street.
std::vector<int> connect_parts(const StandingRoom& room);

}  // namespace viewcell

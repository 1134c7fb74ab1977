// What the collapses of a progressive mesh do to its texture: cells that correspond.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "pm/progressive_mesh.h"

namespace viewcell {

/// A corner of cells, in texture coordinates.
struct AdaptationPoint {
  glm::vec2 before, after;  ///< the collapse
};

/// Half of a cell, which lies in one face before and in one face after the collapse: the texture is
/// affine from one to the other. It turns the same way in both.
struct AdaptationTriangle {
  std::array<std::uint16_t, 3> corners;  ///< places in the collapse's points
  std::uint16_t flags;
  std::uint32_t chart;

  /// The edge from corner k to the next is a border of the chart.
  bool is_border(std::size_t k) const { return flags >> k & 1; }
  bool has_border() const { return flags & 7; }
  /// Before the collapse the face is as in the finest mesh, so the texture there is the original.
  bool is_original() const { return flags >> 3 & 1; }
};
static_assert(sizeof(AdaptationPoint) == 16 && sizeof(AdaptationTriangle) == 12);

/// What one collapse adapts: the star of the vertex that goes.
struct Adaptation {
  std::span<const AdaptationPoint> points;
  std::span<const AdaptationTriangle> triangles;
};

/// The collapses of a progressive mesh from its finest level to its base. A collapse with no
/// triangles leaves the texture as it is. About 250 bytes a collapse.
struct AdaptationLog {
  std::vector<AdaptationPoint> points;
  std::vector<AdaptationTriangle> triangles;
  std::vector<std::uint32_t> first_point,
      first_triangle;                 ///< of each collapse; one more at the end
  std::vector<std::uint32_t> charts;  ///< of the record's faces
  std::size_t n_charts = 0;
  std::size_t n_folded = 0;    ///< collapses that turn a face over in the texture
  std::size_t n_unmapped = 0;  ///< collapses that have no map of cells
  std::size_t n_moved = 0;     ///< edges with points that had to be moved, lest cells fold
  /// Of the progressive mesh, see hash_splits().
  std::uint64_t mesh_hash = 0;

  std::size_t n_collapses() const { return first_point.empty() ? 0 : first_point.size() - 1; }
  Adaptation of(std::size_t collapse) const {
    const auto part = [&](auto& all, const std::vector<std::uint32_t>& first) {
      return std::span(all).subspan(first[collapse], first[collapse + 1] - first[collapse]);
    };
    return {part(points, first_point), part(triangles, first_triangle)};
  }
};

/// The faces of a level in the texture.
struct LevelCharts {
  std::vector<std::array<glm::vec2, 3>> faces;
  std::vector<std::uint32_t> charts;  ///< of the faces
};
LevelCharts make_level_charts(const ProgressiveMesh& mesh, const AdaptationLog& log);

/// Lays the cells of every collapse again, points matched by nearness as in the mapping metric. The
/// record must be of half-edge collapses, have texture coordinates and be sound (see check_record).
/// About 3 us a collapse. Follows: [Chen06 3.2.2].
AdaptationLog make_adaptation_log(const ProgressiveRecord& record, const Progress& progress = {});

}  // namespace viewcell

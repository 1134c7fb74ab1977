// What the collapses of a progressive mesh do to its texture: overlay cells (pm/overlay_cells.h),
// in texture coordinates before and after.
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

/// A corner of overlay cells, in texture coordinates.
struct AdaptationPoint {
  glm::vec2 before, after;  ///< the collapse
};
/// Whether both are finite and so near the texture that their texels in a map of any size can be
/// counted.
bool is_within_reach(const AdaptationPoint& point);

/// A triangle of an overlay cell, which lies in one face before and in one face after the collapse:
/// the texture is affine from one to the other. It turns the same way in both.
struct AdaptationTriangle {
  std::array<std::uint16_t, 3> corners;  ///< indices into the step's points
  std::uint16_t flags;
  std::uint32_t chart;

  /// The edge from corner k to the next is a border of the chart.
  bool is_border(std::size_t k) const { return flags >> k & 1; }
  bool has_border() const { return flags & 7; }
  /// Before the collapse the face is as in the finest mesh, so the texture there is the original.
  bool is_original() const { return flags >> 3 & 1; }
};
static_assert(sizeof(AdaptationPoint) == 16 && sizeof(AdaptationTriangle) == 12);

/// What one step adapts: the star of the vertex that is removed, or that moves.
struct Adaptation {
  std::span<const AdaptationPoint> points;
  std::span<const AdaptationTriangle> triangles;
};

/// The collapses of a progressive mesh from its finest level to its base, step by step: a half-edge
/// collapse is one step; a full-edge collapse is two, a half-edge collapse and a move of the vertex
/// that stays, in either order. A step with no triangles leaves the texture as it is: so do those
/// of a piece that vanishes. About 300 bytes a step.
struct AdaptationLog {
  std::vector<AdaptationPoint> points;
  std::vector<AdaptationTriangle> triangles;
  std::vector<std::uint32_t> first_point, first_triangle;  ///< of each step; one more at the end
  std::size_t steps_per_collapse = 1;
  /// Of the record's faces, see find_joined_charts(); kNoChart: of those that were not kept.
  std::vector<std::uint32_t> charts;
  std::size_t n_charts = 0;
  std::size_t n_folded = 0;  ///< steps that turn a face over in the texture
  /// Steps that have no overlay; steps of a vertex where a seam ends within a chart have none.
  std::size_t n_unmapped = 0;
  std::size_t n_moved = 0;  ///< edges with points that were moved so that no cell folds

  std::size_t n_steps() const { return first_point.empty() ? 0 : first_point.size() - 1; }
  std::size_t n_collapses() const { return n_steps() / steps_per_collapse; }
  Adaptation of(std::size_t step) const {
    const auto part = [&](auto& all, const std::vector<std::uint32_t>& first) {
      return std::span(all).subspan(first[step], first[step + 1] - first[step]);
    };
    return {part(points, first_point), part(triangles, first_triangle)};
  }
};

/// The faces of a level in the texture.
struct LevelCharts {
  std::vector<std::array<glm::vec2, 3>> faces;
  std::vector<std::uint32_t> charts;  ///< of the faces
};
/// Those with a chart alone.
LevelCharts make_level_charts(const ProgressiveMesh& mesh, const AdaptationLog& log);
/// And those of pieces that have vanished, as they were then: their texels wait for them.
LevelCharts make_owner_charts(const ProgressiveMesh& mesh, const AdaptationLog& log);

/// Rebuilds the overlay cells of every collapse, points matched by nearness as in the mapping
/// metric. The record must have texture coordinates and be sound (see check_record). Throws
/// InputError for a split that does not keep to texture charts. About 3 us a step.
/// groups: of the record's faces, or empty; faces of different groups are in different charts, for
/// keep_faces(). Follows: [Chen06 3.2.2].
AdaptationLog make_adaptation_log(const ProgressiveRecord& record, const Progress& progress = {},
                                  std::span<const std::int32_t> groups = {});

/// What the collapses do to the texture of some of the faces: those of one picture, where the
/// others have another. is_kept: of the record's faces, all of a chart or none.
AdaptationLog keep_faces(const AdaptationLog& log, const std::vector<bool>& is_kept);

}  // namespace viewcell

// What the collapses of a progressive mesh do to its texture: pairs of triangles that correspond.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "pm/progressive_mesh.h"

namespace viewcell {

/// A part of the texture before a collapse, and where it stands after it. Texture coordinates; both
/// turn the same way.
struct TexturePair {
  std::array<glm::vec2, 3> before, after;
};

/// The collapses of a progressive mesh from its finest level to its base. What a collapse adapts is
/// the star of the vertex that goes; a collapse with no pairs leaves the texture as it is.
struct AdaptationLog {
  std::vector<TexturePair> pairs;
  std::vector<std::uint32_t> first;  ///< of each collapse's pairs; one more at the end
  std::size_t n_folded = 0;          ///< collapses whose cells would fold in the texture
  std::size_t n_unmapped = 0;        ///< collapses that have no map of cells

  std::size_t n_collapses() const { return first.empty() ? 0 : first.size() - 1; }
  std::span<const TexturePair> of(std::size_t collapse) const {
    return std::span(pairs).subspan(first[collapse], first[collapse + 1] - first[collapse]);
  }
};

/// Lays the cells of every collapse again, points matched by nearness as in the mapping metric. The
/// record must be of half-edge collapses, have texture coordinates and be sound (see check_record).
/// Follows: [Chen06 3.2.2].
AdaptationLog make_adaptation_log(const ProgressiveRecord& record, const Progress& progress = {});

}  // namespace viewcell

// How far two indexing maps are from each other, in texels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "image/index_map.h"

namespace viewcell {

/// Of a texel: the length of (difference of u times width, difference of v times height).
struct IndexMapDistance {
  double rms_texels = 0, max_texels = 0;
  double share_within = 1;   ///< of the texels counted, those at most within_texels apart, 0 to 1
  std::size_t n_texels = 0;  ///< counted; with none the maps count as equal
};

struct CompareIndexMapsOptions {
  double within_texels = 1;  ///< for share_within, >= 0
  /// Texels to count: those that are not 0 here (make_chart_map, say); of the maps' size, or empty:
  /// all are counted.
  Image<std::uint32_t> counted;
};

/// Sizes must agree, numbers must be finite. One thread; sums in the order of texels.
IndexMapDistance compare_index_maps(const IndexMap& reference, const IndexMap& tested,
                                    const CompareIndexMapsOptions& options = {});

}  // namespace viewcell

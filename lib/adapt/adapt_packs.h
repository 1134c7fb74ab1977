// Groups of adaptations that touch disjoint parts of a texture and may run in parallel.
#pragma once

#include <cstdint>
#include <vector>

#include "adapt/adaptation.h"

namespace viewcell {

/// Steps of a log, pack by pack: no adaptation of a pack writes a texel that another one of it
/// reads or writes. Each comes after all that it depends on.
struct AdaptPacks {
  std::vector<std::uint32_t> order;
  std::vector<std::size_t> first;  ///< of each pack's in order; one more at the end

  std::size_t size() const { return first.size() - 1; }
};

/// The way from `from` to `to` steps made; back when to < from. Steps that adapt nothing are left
/// out. pack: false makes packs of one. Follows: [Chen06 3.3]. Differs: each adaptation
/// goes into the first pack that it may, so packs are as few as the order of dependencies allows.
/// What an adaptation touches is measured in tiles of the texture.
AdaptPacks pack_adaptations(const AdaptationLog& log, std::size_t from, std::size_t to,
                            int width_px, int height_px, bool pack = true);

}  // namespace viewcell

// Every number of a bundle's section files, before it is used. Private to this room.
#pragma once

#include "base/section_file.h"
#include "bundle/bundle.h"

namespace viewcell {

/// Counts, indices, boxes and masks; every outside object of the cell once, no other. Throws
/// InputError.
void check_geometry(const CellGeometry& geometry, const Scene& scene, const CellSet& cells,
                    CellId cell, const SectionReader& reader);

/// Tiles that lie one after another in n_texels texels, seen from the centre, each of an object of
/// its own, their numbers finite and in range. Throws InputError.
void check_tiles(const std::vector<BundleTile>& tiles, std::uint64_t n_texels, const Scene& scene,
                 const CellSet& cells, CentreId centre, const SectionReader& reader);

/// The texels of all tiles, whose sizes are checked. Throws InputError.
std::uint64_t count_texels(const std::vector<BundleTile>& tiles, const SectionReader& reader);

}  // namespace viewcell

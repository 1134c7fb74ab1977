// What stands for an object in a view cell.
#pragma once

#include <cstdint>

namespace viewcell {

/// original: as it is, in its own materials; single_view: an SVMesh; multi_view: an MVMesh
/// [Chen06 5.2.1]; unseen: what no eye in the cell was found to see, a coarse level without
/// textures, drawn where nothing else is. The numbers are those of bundle files.
enum class Representation : std::uint8_t { original, single_view, multi_view, unseen };

}  // namespace viewcell

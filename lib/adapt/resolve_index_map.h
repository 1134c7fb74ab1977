// Ordinary textures from indexing maps.
#pragma once

#include "adapt/adaptation.h"
#include "image/index_map.h"

namespace viewcell {

/// The texture as an index map shows it: a texture of the map's size, which may differ from the
/// texture's. Texels that hold their own texture coordinates keep the original's bits. Fetches find
/// texels of charts, which are continued a few texels outwards, not what lies around them. finest,
/// level: the faces before the first collapse and now. What charts have left behind takes the
/// colour of the nearest texel of a chart; what none ever covered stays as it was. The same bytes
/// for any n_threads (0: all).
ImageRgba8 resolve_index_map(const IndexMap& map, const ImageRgba8& texture,
                             const LevelCharts& finest, const LevelCharts& level,
                             int n_threads = 0);

}  // namespace viewcell

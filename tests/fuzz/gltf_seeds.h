// GLB files with all that is read of them, and what Draco packs.
#pragma once

#include "seeds.h"

namespace viewcell {

void add_gltf_files(const Seeds& seeds);

}  // namespace viewcell

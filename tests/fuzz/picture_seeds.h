// Pictures of all formats, indexing maps and captures.
#pragma once

#include "seeds.h"

namespace viewcell {

void add_pictures(const Seeds& seeds);

}  // namespace viewcell

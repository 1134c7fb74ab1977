// The dragon's parts that stand in files of their own.
#pragma once

#include "park/implicit.h"

namespace viewcell {

/// In its own frame: the nape at the origin, the snout along +x.
Figure make_dragon_head();

}  // namespace viewcell

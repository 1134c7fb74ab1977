// A checker board: a texture on which distortion is seen.
#pragma once

#include "image/image.h"

namespace viewcell {

/// n_squares x n_squares squares, dark and light gray, alpha 255. From the centre on, light squares
/// are red to the right (+u) and green upwards (+v): how the texture lies is seen too. BugError
/// unless 2 <= n_squares <= size_px.
ImageRgba8 make_checker(int size_px, int n_squares);

}  // namespace viewcell

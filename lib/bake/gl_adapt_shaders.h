// The programs that draw adaptations of a texture (vertices: bake/gl_adapt_batch.h).
#pragma once

#include "gl/objects.h"

namespace viewcell {

/// Texture units: 0 the texture that is read, 1 who owns its texels, 2 the stars' corners. Colour 0
/// gets the values, 1 the owners (where the program has any).
struct AdaptPrograms {
  GlProgram copy_owned, copy_values, sample, sample_owned;
};

/// n_channels: 2 for coordinates, 4 for colours. rounds_to_half: values are rounded to the nearest
/// 16-bit float, which GL leaves to the driver.
AdaptPrograms make_adapt_programs(const Gl& gl, int width_px, int height_px, int n_channels,
                                  bool rounds_to_half);

}  // namespace viewcell

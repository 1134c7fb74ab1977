// The programs that draw adaptations of a texture (vertices: adapt/gl_adapt_batch.h).
#pragma once

#include "gl/objects.h"

namespace viewcell {

/// Texture units: 0 the texture that is read, 1 who owns its texels, 2 the stars' corners. Colour 0
/// gets the values, 1 the owners (where the program has any).
struct AdaptPrograms {
  GlProgram copy_owned, copy_values, sample, sample_owned;
};

struct AdaptShaderOptions {
  int n_channels = 2;           ///< 2 for coordinates, 4 for colours
  bool rounds_to_half = false;  ///< to the nearest 16-bit float, which GL leaves to the driver
  bool filters = false;         ///< by the sampler (gl/filter_precision.h); false: by hand
};

AdaptPrograms make_adapt_programs(const Gl& gl, int width_px, int height_px,
                                  const AdaptShaderOptions& options);

}  // namespace viewcell

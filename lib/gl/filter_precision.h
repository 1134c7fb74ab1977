// Whether a driver's own bilinear filter is as good as one made by hand.
#pragma once

#include "gl/gl.h"

namespace viewcell {

/// GL leaves the precision of a filter's weights to the driver; graphics cards often have 8 bits.
/// True when those of a texture of this format (one that can be drawn to) have 10 or more, as drawn
/// and read back once. A format that itself has fewer counts as less. Waits; some milliseconds.
/// Leaves a program, a vertex array and a framebuffer bound that are gone.
bool filters_precisely(const Gl& gl, GLenum internal_format);

}  // namespace viewcell

// Pictures with their mips on the graphics card.
#pragma once

#include "gl/objects.h"
#include "image/mip_texture.h"

namespace viewcell {

/// In sRGB, as sample_mips_glsl() looks it up, with the wraps of the texture. Throws MachineError
/// when a side is beyond the driver's limit, or GL memory runs out.
GlTexture upload_mips(const Gl& gl, const MipTexture& texture);

}  // namespace viewcell

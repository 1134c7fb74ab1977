// The floor under every frame time: a clear and one full-screen quad with a bilinear texture.
#pragma once

#include "gl/framebuffer.h"

namespace viewcell {

/// No image-based renderer on this machine can be faster.
class FloorQuad {
 public:
  /// A texture of the frame's size, filled with a pattern. gl must outlive this.
  FloorQuad(const Gl& gl, int width_px, int height_px);
  void draw(const GlFramebuffer& target) const;

 private:
  const Gl& gl_;
  GlProgram program_;
  GlVertexArray array_;
  GlTexture texture_;
};

}  // namespace viewcell

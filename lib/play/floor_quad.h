// A lower bound of the frame time: clearing the frame and drawing one full-screen textured quad.
#pragma once

#include "gl/framebuffer.h"

namespace viewcell {

/// The least work that an image-based renderer does for a frame, drawn to be timed: none can be
/// faster on the same machine. Reported as "floor"; unrelated to the ground plane
/// (draw/ground.h).
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

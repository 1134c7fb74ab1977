// Draws what a cell is not expected to show, where nothing else was drawn.
#pragma once

#include "gl/objects.h"
#include "play/hybrid_renderer.h"

namespace viewcell {

/// The objects of a cell that no eye in it was found to see (Representation::unseen): one draw of
/// coarse levels in one colour a vertex, behind everything. So where the bake was wrong about one
/// there is no hole, and where it was right nothing changes.
class UnseenRenderer {
 public:
  explicit UnseenRenderer(const Gl& gl);

  /// Into the bound framebuffer, after all that hides it. Alpha: 254/255, as what is lit. Relies
  /// on, and leaves, the state of GlContext.
  void draw(const Camera& camera, const ResidentCell& cell, const HybridPlan& plan,
            HybridStyle style) const;

 private:
  const Gl& gl_;
  GlProgram program_;
};

}  // namespace viewcell

// Draws a cell's outside objects with projective textures.
#pragma once

#include "gl/framebuffer.h"
#include "play/residency.h"

namespace viewcell {

enum class HybridStyle {
  textured,
  kinds,      ///< SVMesh violet, MVMesh blue, lit (Figures 5.15 to 5.18)
  wireframe,  ///< kinds, with edges
};

struct HybridOptions {
  /// A texel counts for a fragment when their depths differ by at most this share of the object's
  /// depth range (trap 29: texels of another layer).
  float depth_tolerance = 0.08f;
};

/// Follows: [Chen06 5.2.2]. Differs: which view a point may be textured from is decided for each
/// fragment, by comparing its depth with its texels', and not for each polygon by its corners' view
/// sets; a fragment that no view shows is lit from its normal.
/// Alpha: 1 textured, 254/255 lit. Relies on, and leaves, the state of GlContext.
class HybridRenderer {
 public:
  HybridRenderer(const Gl& gl, const Scene& scene, const HybridOptions& options = {});

  /// Into the bound framebuffer: the plan's outside objects.
  void draw(const glm::dmat4& clip_from_world, const ResidentCell& cell, GLuint texels,
            const HybridPlan& plan, HybridStyle style = HybridStyle::textured);

 private:
  struct DrawBlock;
  void upload_blocks(const ResidentCell& cell, const HybridPlan& plan, HybridStyle style);
  void draw_one(const ResidentCell& cell, const HybridPlan& plan, std::size_t i) const;
  void draw_edges(const ResidentCell& cell, const HybridPlan& plan) const;

  const Gl& gl_;
  const Scene& scene_;
  GlProgram two_views_, one_view_, lit_, edges_;
  GlBuffer blocks_;
  std::size_t block_stride_ = 0;
  std::vector<char> staged_;
};

}  // namespace viewcell

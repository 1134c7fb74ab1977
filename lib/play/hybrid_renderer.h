// Draws a cell's outside objects with projective textures.
#pragma once

#include <map>

#include "gl/framebuffer.h"
#include "play/hybrid_shaders.h"
#include "play/residency.h"

namespace viewcell {

enum class HybridStyle {
  textured,
  kinds,      ///< SVMesh violet, MVMesh blue, lit (Figures 5.15 to 5.18); unseen red
  wireframe,  ///< kinds, with edges
};

/// In pictures of kinds: what stands for an object (linear).
glm::vec3 kind_color(Representation kind);

struct HybridOptions {
  /// A texel counts for a fragment when their depths differ by at most this share of the object's
  /// depth range (others are texels of another layer), or by so little that the eye and the view
  /// see the two within shift_px texels of each other: errors of far depths are not
  /// visible.
  float depth_tolerance = 0.08f;
  float shift_px = 1;
};

/// The difference of depth codes, in [0, 1], up to which a texel of the view counts for the frame's
/// eye. middle: of the object; all cell-local.
float depth_tolerance(const ViewProjection& view, const glm::vec3& eye, const glm::vec3& middle,
                      const HybridOptions& options);

/// Follows: [Chen06 5.2.2]. Differs: which view a point may be textured from is decided for each
/// fragment, by comparing its depth with its texels', and not for each polygon by its corners' view
/// sets; a fragment that no view shows is lit from its normal.
/// Alpha: 1 textured, 254/255 lit. Relies on, and leaves, the state of GlContext.
class HybridRenderer {
 public:
  HybridRenderer(const Gl& gl, const Scene& scene, const HybridOptions& options = {});

  /// Into the bound framebuffer: the plan's outside objects.
  void draw(const Camera& camera, const ResidentCell& cell, GLuint texels, const HybridPlan& plan,
            HybridStyle style = HybridStyle::textured);

 private:
  struct DrawBlock;
  struct Programs {
    GlProgram two_views, one_view, lit;
  };
  Programs make_programs(DrawnSides sides) const;
  const Programs& programs_for(const SceneObject& object) const;
  void upload_blocks(const ResidentCell& cell, const HybridPlan& plan, const glm::vec3& eye,
                     HybridStyle style);
  void draw_one(const ResidentCell& cell, const HybridPlan& plan, std::size_t i) const;
  void draw_edges(const ResidentCell& cell, const HybridPlan& plan) const;

  const Gl& gl_;
  const Scene& scene_;
  HybridOptions options_;
  std::map<DrawnSides, Programs> programs_;  // those that some object needs
  GlProgram edges_;
  GlBuffer blocks_;
  std::size_t block_stride_ = 0;
  std::vector<char> staged_;
};

}  // namespace viewcell

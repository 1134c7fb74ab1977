// One GL context for all tests of the program but those that make a player, which has its own.
#pragma once

#include "draw/scene_renderer.h"
#include "gl/context.h"
#include "gl/framebuffer.h"
#include "image/metrics.h"

namespace viewcell {

inline const GlContext& shared_context() {
  static GlContext context(GlEngine::kOsmesa);
  context.make_current();  // again, after a player's
  return context;
}

inline ImageRgba8 draw_frame(const SceneRenderer& renderer, const GlFramebuffer& target,
                             const glm::dmat4& clip_from_world,
                             const std::vector<ObjectDraw>& draws) {
  renderer.draw_background(target, clip_from_world);
  renderer.draw_objects(clip_from_world, draws);
  return target.read_rgba8();
}

/// Of two pictures' luminance, over the whole frame.
inline double psnr_db(const ImageRgba8& a, const ImageRgba8& b) {
  return compare_images(a, b, {.ssim = false}).psnr_db;
}

}  // namespace viewcell

// One GL context for all tests of the program but those that make a player, which has its own.
#pragma once

#include "draw/scene_renderer.h"
#include "gl/context.h"
#include "gl/framebuffer.h"

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

/// dB of luminance over the whole frame; 100 for equal pictures.
inline double luminance_psnr_db(const ImageRgba8& a, const ImageRgba8& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const auto luminance = [](const Rgba8& p) {
      return 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
    };
    const double d = luminance(a.pixels[i]) - luminance(b.pixels[i]);
    sum += d * d;
  }
  if (sum == 0) return 100;
  return 10 * std::log10(255.0 * 255.0 / (sum / static_cast<double>(a.pixels.size())));
}

}  // namespace viewcell

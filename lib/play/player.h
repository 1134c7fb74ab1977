// The modes of play over one bundle: each draws any camera, timed as a user would see it.
#pragma once

#include <memory>
#include <vector>

#include "draw/raycast.h"
#include "draw/scene_renderer.h"
#include "gl/context.h"
#include "play/floor_quad.h"
#include "play/hybrid_renderer.h"
#include "play/modes.h"
#include "play/unseen_renderer.h"

namespace viewcell {

struct PlayerOptions {
  int width_px = 1024, height_px = 1024;
  double fov_y_deg = 0;  ///< of the frames; 0: the path's
  GlEngine engine = GlEngine::kOsmesa;
  int n_threads = 0;
  ResidencyOptions residency;
  HybridOptions hybrid;
  bool with_lod = false;      ///< a mode that draws levels will be drawn: build them
  bool with_raycast = false;  ///< a mode of rays will be drawn: build their hierarchies
};

/// What drawing one frame took. Times are wall clock until the picture is complete; what a mode
/// must load or upload counts.
struct DrawnFrame {
  double ms = 0;
  std::size_t n_triangles = 0;
  std::size_t n_draws = 0;
  std::size_t texture_bytes = 0;     ///< resident
  StandIn stand_in = StandIn::none;  ///< of mode hybrid
};

class Player {
 public:
  /// The bundle must outlive this.
  Player(const Bundle& bundle, const PlayerOptions& options);

  DrawnFrame draw(Mode mode, const Camera& camera);
  /// The picture that draw() made last. Not part of its time.
  ImageRgba8 read(Mode mode) const;
  /// The frustum mode's picture moved by some pixels, for the yardstick (play/timeline.h).
  ImageRgba8 draw_shifted(const Camera& camera, const glm::dvec2& shift_px);
  /// Hybrid, outside objects in colours of their kind.
  ImageRgba8 draw_kinds(const Camera& camera, HybridStyle style);

  /// A clear and a full-screen textured quad: a lower bound of frame times (play/floor_quad.h).
  void draw_floor();

  const PlayerOptions& options() const { return options_; }
  const GlContext& context() const { return context_; }
  const Residency& residency() const { return residency_; }

 private:
  DrawnFrame draw_plan(const FramePlan& plan, const glm::dmat4& clip, const DrawStyle& style = {});
  std::size_t count_hybrid(const Camera& camera);
  DrawnFrame draw_hybrid(const Camera& camera, HybridStyle style);
  DrawnFrame draw_resident(const Camera& camera, const ResidentCell& cell, HybridStyle style);
  DrawnFrame draw_stand_in(const Camera& camera, StandIn why, HybridStyle style);

  const Bundle& bundle_;
  PlayerOptions options_;
  GlContext context_;
  std::vector<MeshLevels> levels_;
  PlanScene plan_scene_;
  GlFramebuffer target_;
  SceneRenderer scene_renderer_;
  Residency residency_;
  HybridRenderer hybrid_renderer_;
  UnseenRenderer unseen_renderer_;
  FloorQuad floor_;
  std::unique_ptr<RayCaster> ray_caster_;
  Camera hybrid_camera_;  // of the last hybrid frame
  std::size_t n_hybrid_triangles_ = 0;
  ImageRgba8 ray_image_;
};

}  // namespace viewcell

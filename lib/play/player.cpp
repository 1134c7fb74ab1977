#include "play/player.h"

#include <chrono>
#include <optional>

#include "base/error.h"

namespace viewcell {
Player::Player(const Bundle& bundle, const PlayerOptions& options)
    : bundle_(bundle),
      options_(options),
      context_(options.engine),
      levels_(build_scene_levels(bundle.scene(), options.with_lod, {}, options.n_threads)),
      plan_scene_(make_plan_scene(bundle.scene(), levels_)),
      target_(context_.gl(), options.width_px, options.height_px),
      scene_renderer_(context_.gl(), bundle.scene(), levels_),
      residency_(context_.gl(), bundle, options.residency),
      hybrid_renderer_(context_.gl(), bundle.scene(), options.hybrid),
      unseen_renderer_(context_.gl()),
      floor_(context_.gl(), options.width_px, options.height_px),
      ray_image_(options.width_px, options.height_px) {
  if (options.with_raycast)
    ray_caster_ = std::make_unique<RayCaster>(bundle.scene(), options.n_threads);
}

DrawnFrame Player::draw_plan(const FramePlan& plan, const glm::dmat4& clip,
                             const DrawStyle& style) {
  scene_renderer_.draw_background(target_, clip);
  scene_renderer_.draw_objects(clip, plan.draws, style);
  return {0, plan.n_triangles, plan.n_calls, 0};
}

DrawnFrame Player::draw_resident(const Camera& camera, const ResidentCell& cell,
                                 HybridStyle style) {
  const HybridPlan plan =
      plan_hybrid(plan_scene_, bundle_.cells(), *cell.ready, cell.views, camera);
  scene_renderer_.draw_background(target_, clip_from_world(camera));
  DrawStyle inside_style;
  if (style != HybridStyle::textured)
    inside_style.base_color = kind_color(Representation::original);
  const SceneRenderer::Drawn originals =
      scene_renderer_.draw_clusters(camera, plan.originals, inside_style);
  hybrid_renderer_.draw(camera, cell, residency_.texel_texture(), plan, style);
  unseen_renderer_.draw(camera, cell, plan, style);
  const std::size_t n_draws =
      originals.n_calls + plan.outside.size() + (plan.unseen.empty() ? 0 : 1);
  return {0, originals.n_triangles + plan.n_triangles, n_draws, residency_.texture_bytes(),
          cell.stand_in};
}

DrawnFrame Player::draw_stand_in(const Camera& camera, StandIn why, HybridStyle style) {
  DrawStyle look;
  if (style != HybridStyle::textured) look.base_color = kind_color(Representation::original);
  DrawnFrame frame =
      draw_plan(plan_lod(plan_scene_, camera, options_.height_px), clip_from_world(camera), look);
  frame.texture_bytes = residency_.texture_bytes();
  frame.stand_in = why;
  return frame;
}

DrawnFrame Player::draw_hybrid(const Camera& camera, HybridStyle style) {
  StandIn why = find_off_bake(bundle_, camera);
  const ResidentCell* cell = why == StandIn::none ? &residency_.enter(camera) : nullptr;
  if (cell != nullptr && !cell->ready) why = cell->stand_in;
  const DrawnFrame frame = why == StandIn::none ? draw_resident(camera, *cell, style)
                                                : draw_stand_in(camera, why, style);
  hybrid_camera_ = camera;
  n_hybrid_triangles_ = frame.n_triangles;
  return frame;
}

std::size_t Player::count_hybrid(const Camera& camera) {
  if (n_hybrid_triangles_ == 0 || camera.eye != hybrid_camera_.eye ||
      camera.forward != hybrid_camera_.forward)
    draw_hybrid(camera, HybridStyle::textured);
  return n_hybrid_triangles_;
}

DrawnFrame Player::draw(Mode mode, const Camera& camera) {
  const ModeRow& row = row_of(mode);
  PlanInputs inputs{plan_scene_, camera, options_.height_px, 0};
  std::optional<FramePlan> plan;
  if (row.asks_hybrid) {
    inputs.n_hybrid_triangles = count_hybrid(camera);
    plan = row.plan(inputs);
    context_.gl().Finish();
  }
  const auto start = std::chrono::steady_clock::now();
  DrawnFrame frame;
  switch (row.engine) {
    case ModeEngine::objects:
      if (!plan) plan = row.plan(inputs);
      frame = draw_plan(*plan, clip_from_world(camera),
                        {.base_color = {}, .cull_back_faces = row.culls_back_faces});
      break;
    case ModeEngine::hybrid:
      frame = draw_hybrid(camera, HybridStyle::textured);
      break;
    case ModeEngine::rays:
      VIEWCELL_CHECK(ray_caster_ != nullptr);
      ray_caster_->draw(camera, ray_image_);
      break;
  }
  if (row.engine != ModeEngine::rays) context_.gl().Finish();
  const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
  frame.ms = ms.count();
  return frame;
}

ImageRgba8 Player::read(Mode mode) const {
  return row_of(mode).engine == ModeEngine::rays ? ray_image_ : target_.read_rgba8();
}

void Player::draw_floor() {
  floor_.draw(target_);
  context_.gl().Finish();
}

ImageRgba8 Player::draw_shifted(const Camera& camera, const glm::dvec2& shift_px) {
  const glm::dmat4 clip =
      shift_pixels(clip_from_world(camera), shift_px, options_.width_px, options_.height_px);
  draw_plan(plan_frustum(plan_scene_, camera), clip);
  return target_.read_rgba8();
}

ImageRgba8 Player::draw_kinds(const Camera& camera, HybridStyle style) {
  draw_hybrid(camera, style);
  return target_.read_rgba8();
}

}  // namespace viewcell

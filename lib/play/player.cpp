#include "play/player.h"

#include <chrono>

#include "base/error.h"

namespace viewcell {
namespace {

constexpr const char* kModeNames[] = {
    "geometry",           "frustum",          "lod", "hybrid", "raycast", "lod-equal",
    "geometry-two-sided", "frustum-two-sided"};

// The bundle's grey-and-original style for objects inside the cell in pictures of kinds.
const glm::vec3 kOriginalColor{0.55f, 0.5f, 0.42f};

}  // namespace

Mode parse_mode(const std::string& name) {
  for (std::size_t i = 0; i < std::size(kModeNames); ++i)
    if (name == kModeNames[i]) return static_cast<Mode>(i);
  std::string names;
  for (const char* known : kModeNames) names += (names.empty() ? "" : ", ") + std::string(known);
  throw UsageError("'" + name + "' is no mode: " + names);
}

const char* mode_name(Mode mode) {
  return kModeNames[static_cast<std::size_t>(mode)];
}

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
      floor_(context_.gl(), options.width_px, options.height_px),
      ray_image_(options.width_px, options.height_px) {
  if (options.with_raycast)
    ray_caster_ = std::make_unique<RayCaster>(bundle.scene(), options.n_threads);
}

DrawnFrame Player::draw_plan(const FramePlan& plan, const glm::dmat4& clip,
                             const DrawStyle& style) {
  scene_renderer_.draw_background(target_, clip);
  scene_renderer_.draw_objects(clip, plan.draws, style);
  return {0, plan.n_triangles, plan.draws.size(), 0};
}

DrawnFrame Player::draw_hybrid(const Camera& camera, HybridStyle style) {
  const ResidentCell& cell = residency_.enter(camera);
  const HybridPlan plan =
      plan_hybrid(plan_scene_, bundle_.cells(), *cell.ready, cell.views, camera);
  scene_renderer_.draw_background(target_, clip_from_world(camera));
  DrawStyle inside_style;
  if (style != HybridStyle::textured) inside_style.base_color = kOriginalColor;
  const std::size_t n_inside = scene_renderer_.draw_clusters(camera, plan.inside, inside_style);
  hybrid_renderer_.draw(camera, cell, residency_.texel_texture(), plan, style);
  hybrid_camera_ = camera;
  n_hybrid_triangles_ = n_inside + plan.n_triangles;
  return {0, n_hybrid_triangles_, plan.inside.size() + plan.outside.size(),
          residency_.texture_bytes()};
}

std::size_t Player::count_hybrid(const Camera& camera) {
  if (n_hybrid_triangles_ == 0 || camera.eye != hybrid_camera_.eye ||
      camera.forward != hybrid_camera_.forward)
    draw_hybrid(camera, HybridStyle::textured);
  return n_hybrid_triangles_;
}

DrawnFrame Player::draw(Mode mode, const Camera& camera) {
  FramePlan lod_equal;  // made before the clock starts: a user would choose an error, not a count
  if (mode == Mode::lod_equal) {
    lod_equal = plan_lod_within(plan_scene_, camera, options_.height_px, count_hybrid(camera));
    context_.gl().Finish();
  }
  const DrawStyle two_sided{.base_color = {}, .cull_back_faces = false};
  const auto start = std::chrono::steady_clock::now();
  DrawnFrame frame;
  switch (mode) {
    case Mode::geometry:
      frame = draw_plan(plan_geometry(plan_scene_), clip_from_world(camera));
      break;
    case Mode::frustum:
      frame = draw_plan(plan_frustum(plan_scene_, camera), clip_from_world(camera));
      break;
    case Mode::lod:
      frame = draw_plan(plan_lod(plan_scene_, camera, options_.height_px), clip_from_world(camera));
      break;
    case Mode::lod_equal:
      frame = draw_plan(lod_equal, clip_from_world(camera));
      break;
    case Mode::geometry_two_sided:
      frame = draw_plan(plan_geometry(plan_scene_), clip_from_world(camera), two_sided);
      break;
    case Mode::frustum_two_sided:
      frame = draw_plan(plan_frustum(plan_scene_, camera), clip_from_world(camera), two_sided);
      break;
    case Mode::hybrid:
      frame = draw_hybrid(camera, HybridStyle::textured);
      break;
    case Mode::raycast:
      VIEWCELL_CHECK(ray_caster_ != nullptr);
      ray_caster_->draw(camera, ray_image_);
      break;
  }
  if (mode != Mode::raycast) context_.gl().Finish();
  const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
  frame.ms = ms.count();
  return frame;
}

ImageRgba8 Player::read(Mode mode) const {
  return mode == Mode::raycast ? ray_image_ : target_.read_rgba8();
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

#include "capture/ray_capture.h"

#include "rays/ray_scene.h"
#include "scene/surface.h"

namespace viewcell {

namespace {

// A ray passes through this many backs and holes at most; then the last one is seen.
constexpr int kMostPassed = 64;

// Whether rays must meet the object's backs, too.
bool needs_both_sides(const ObjectSurface& surface) {
  return surface.is_double_sided() || surface.needs_passing();
}

}  // namespace

struct RayCapture::Scenes {
  std::vector<RayScene> fronts, both_sides;  // by mesh, where some object needs it

  RayScene& of(const SceneObject& object, const ObjectSurface& surface) {
    return (needs_both_sides(surface) ? both_sides : fronts)[index(object.mesh)];
  }
};

RayCapture::RayCapture(const Scene& scene, int n_threads, std::size_t budget_bytes)
    : scene_(scene), scenes_(std::make_unique<Scenes>()) {
  const RayDevice device({n_threads, budget_bytes});
  scenes_->fronts.resize(scene.meshes.size());
  scenes_->both_sides.resize(scene.meshes.size());
  for (const SceneObject& object : scene.objects) {
    const ObjectSurface surface(scene, object);
    const TriMesh& mesh = scene.mesh_of(object).mesh;
    RayScene& built = scenes_->of(object, surface);
    if (!built)
      built = RayScene(device, mesh.positions, mesh.triangles,
                       {.fronts_only = !needs_both_sides(surface)});
  }
}

RayCapture::~RayCapture() = default;

namespace {

// One object seen in one view: rays in model space, hits shaded in the world.
class ObjectCaster {
 public:
  ObjectCaster(const SceneObject& object, const ObjectSurface& surface, const RayScene& rays,
               const CaptureView& view)
      : surface_(surface), rays_(rays), view_(view), origin_(object.model_from_world(view.eye)) {
    const auto to_model = [&](const glm::dvec3& v) {
      return glm::conjugate(object.rotation) * v / object.scale;
    };
    right_ = to_model(view.right), up_ = to_model(view.up), forward_ = to_model(view.forward);
  }

  // The block of 4 x 4 pixels at (x0, y0) of the tile.
  void cast_block(CaptureTile& tile, int x0, int y0) const {
    RayPacket packet;
    RayMask mask;
    packet.start(glm::vec3(origin_), 0);
    for (int i = 0; i < RayPacket::kSize; ++i) {
      const int x = x0 + i % 4, y = y0 + i / 4;
      mask.set(i, x < tile.crop.width_px && y < tile.crop.height_px);
      packet.set_direction(i, direction(tile.crop, x, y));
    }
    rays_.intersect(mask, packet);
    if (surface_.needs_passing()) pass_what_is_not_there(tile.crop, x0, y0, packet);
    for (int i = 0; i < RayPacket::kSize; ++i)
      if (mask[i] && packet.has_hit(i)) store(tile, x0 + i % 4, y0 + i / 4, packet, i);
  }

 private:
  // It has 1 along the view's axis, so the ray's parameter is the depth.
  glm::vec3 direction(const Crop& crop, int x, int y) const {
    const double half = 0.5 * view_.source_px, x_px = crop.x + x + 0.5, y_px = crop.y + y + 0.5;
    return glm::vec3(forward_ + ((x_px - half) / view_.focal_px) * right_ +
                     ((half - y_px) / view_.focal_px) * up_);
  }
  PixelRays rays_of(const Crop& crop, int x, int y) const {
    if (!surface_.has_pictures()) return {};
    return {glm::vec3(origin_), direction(crop, x, y), direction(crop, x + step_in_block(x), y),
            direction(crop, x, y + step_in_block(y))};
  }
  static SurfacePoint point_of(const RayPacket& packet, int lane) {
    const auto i = static_cast<std::size_t>(lane);
    return {packet.triangle[i], packet.u[i], packet.v[i]};
  }

  void pass_what_is_not_there(const Crop& crop, int x0, int y0, RayPacket& packet) const {
    for (int round = 0; round < kMostPassed; ++round) {
      RayMask again;
      bool any = false;
      for (int i = 0; i < RayPacket::kSize; ++i) {
        if (!packet.has_hit(i) || !surface_.is_passed(point_of(packet, i), packet.hits_back(i),
                                                      rays_of(crop, x0 + i % 4, y0 + i / 4)))
          continue;
        again.set(i, true);
        any = true;
        packet.pass_hit(i);
      }
      if (!any) return;
      rays_.intersect(again, packet);
    }
  }

  void store(CaptureTile& tile, int x, int y, const RayPacket& packet, int i) const {
    // Turned to the eye where it is the far side of a double-sided surface.
    const glm::vec3 color =
        surface_.color(point_of(packet, i), packet.hits_back(i), rays_of(tile.crop, x, y));
    tile.color.at(x, y) = {color.x, color.y, color.z, 1};
    tile.inverse_depth.at(x, y) = 1 / packet.far[static_cast<std::size_t>(i)];
  }

  const ObjectSurface& surface_;
  const RayScene& rays_;
  const CaptureView& view_;
  glm::dvec3 origin_, right_, up_, forward_;  // in model space
};

}  // namespace

CaptureTile RayCapture::capture(ObjectId id, const CaptureView& view, const Crop& crop) const {
  const SceneObject& object = scene_.objects[index(id)];
  CaptureTile tile{id, view, crop, ImageRgbaFloat(crop.width_px, crop.height_px),
                   Image<float>(crop.width_px, crop.height_px)};
  const ObjectSurface surface(scene_, object);
  const ObjectCaster caster(object, surface, scenes_->of(object, surface), view);
  for (int y = 0; y < crop.height_px; y += 4)
    for (int x = 0; x < crop.width_px; x += 4) caster.cast_block(tile, x, y);
  return tile;
}

}  // namespace viewcell

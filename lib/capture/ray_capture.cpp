#include "capture/ray_capture.h"

#include "rays/ray_scene.h"

namespace viewcell {

struct RayCapture::Scenes {
  std::vector<RayScene> fronts, both_sides;  // by mesh, where some object needs it

  RayScene& of(const SceneObject& object, bool double_sided) {
    return (double_sided ? both_sides : fronts)[index(object.mesh)];
  }
};

RayCapture::RayCapture(const Scene& scene, int n_threads, std::size_t budget_bytes)
    : scene_(scene), scenes_(std::make_unique<Scenes>()) {
  const RayDevice device({n_threads, budget_bytes});
  scenes_->fronts.resize(scene.meshes.size());
  scenes_->both_sides.resize(scene.meshes.size());
  for (const SceneObject& object : scene.objects) {
    const bool both = scene.material_of(object).double_sided;
    const TriMesh& mesh = scene.mesh_of(object).mesh;
    RayScene& built = scenes_->of(object, both);
    if (!built) built = RayScene(device, mesh.positions, mesh.triangles, {.fronts_only = !both});
  }
}

RayCapture::~RayCapture() = default;

namespace {

// One object seen in one view: rays in model space, hits shaded in the world.
class ObjectCaster {
 public:
  ObjectCaster(const Scene& scene, const SceneObject& object, const RayScene& rays,
               const CaptureView& view)
      : scene_(scene),
        object_(object),
        mesh_(scene.mesh_of(object).mesh),
        material_(scene.material_of(object)),
        rays_(rays),
        view_(view),
        origin_(object.model_from_world(view.eye)),
        world_from_model_(glm::mat3_cast(object.rotation)) {
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
      packet.set_direction(i, direction(tile.crop.x + x + 0.5, tile.crop.y + y + 0.5));
    }
    rays_.intersect(mask, packet);
    for (int i = 0; i < RayPacket::kSize; ++i)
      if (mask[i] && packet.has_hit(i)) store(tile, x0 + i % 4, y0 + i / 4, packet, i);
  }

 private:
  // It has 1 along the view's axis, so the ray's parameter is the depth.
  glm::vec3 direction(double x_px, double y_px) const {
    const double half = 0.5 * view_.source_px;
    return glm::vec3(forward_ + ((x_px - half) / view_.focal_px) * right_ +
                     ((half - y_px) / view_.focal_px) * up_);
  }

  void store(CaptureTile& tile, int x, int y, const RayPacket& packet, int lane) const {
    const auto i = static_cast<std::size_t>(lane);
    const Triangle& t = mesh_.triangles[packet.triangle[i]];
    const float u = packet.u[i], v = packet.v[i];
    const glm::vec3 normal_model =
        (1 - u - v) * mesh_.normals[t[0]] + u * mesh_.normals[t[1]] + v * mesh_.normals[t[2]];
    glm::vec3 normal = glm::normalize(glm::mat3(world_from_model_) * normal_model);
    if (packet.hits_back(lane)) normal = -normal;  // the far side of a double-sided surface
    const glm::vec3 color = shade(scene_.lighting, material_.base_color, normal);
    tile.color.at(x, y) = {color.x, color.y, color.z, 1};
    tile.inverse_depth.at(x, y) = 1 / packet.far[i];
  }

  const Scene& scene_;
  const SceneObject& object_;
  const TriMesh& mesh_;
  const Material& material_;
  const RayScene& rays_;
  const CaptureView& view_;
  glm::dvec3 origin_, right_, up_, forward_;  // in model space
  glm::dmat3 world_from_model_;
};

}  // namespace

CaptureTile RayCapture::capture(ObjectId id, const CaptureView& view, const Crop& crop) const {
  const SceneObject& object = scene_.objects[index(id)];
  CaptureTile tile{id, view, crop, ImageRgbaFloat(crop.width_px, crop.height_px),
                   Image<float>(crop.width_px, crop.height_px)};
  const bool both = scene_.material_of(object).double_sided;
  const ObjectCaster caster(scene_, object, scenes_->of(object, both), view);
  for (int y = 0; y < crop.height_px; y += 4)
    for (int x = 0; x < crop.width_px; x += 4) caster.cast_block(tile, x, y);
  return tile;
}

}  // namespace viewcell

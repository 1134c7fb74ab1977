#include "capture/ray_capture.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"

namespace viewcell {
namespace {

constexpr int kPacket = 16;  // 4 x 4 pixels

// Turns away hits on the back of a triangle: Embree's Ng points to the side from which the corners
// run counter-clockwise.
void reject_back_faces(const RTCFilterFunctionNArguments* args) {
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const float along = RTCRayN_dir_x(args->ray, args->N, i) * RTCHitN_Ng_x(args->hit, args->N, i) +
                        RTCRayN_dir_y(args->ray, args->N, i) * RTCHitN_Ng_y(args->hit, args->N, i) +
                        RTCRayN_dir_z(args->ray, args->N, i) * RTCHitN_Ng_z(args->hit, args->N, i);
    if (along >= 0) args->valid[i] = 0;
  }
}

RTCScene build_mesh_scene(RTCDevice device, const TriMesh& mesh, bool double_sided) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<glm::vec3*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              sizeof(glm::vec3), mesh.positions.size()));
  auto* triangles = static_cast<Triangle*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              sizeof(Triangle), mesh.triangles.size()));
  if (!positions || !triangles) throw MachineError("Embree: out of memory");
  std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
  if (!double_sided) rtcSetGeometryIntersectFilterFunction(geometry, reject_back_faces);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

}  // namespace

struct RayCapture::Device {
  RTCDevice device = nullptr;
  std::vector<RTCScene> scenes;  // by mesh, then again double-sided where some object needs it
  std::vector<RTCScene> double_sided;

  ~Device() {
    for (RTCScene scene : scenes)
      if (scene) rtcReleaseScene(scene);
    for (RTCScene scene : double_sided)
      if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

RayCapture::RayCapture(const Scene& scene, int n_threads)
    : scene_(scene), device_(std::make_unique<Device>()) {
  const int threads = n_threads > 0 ? n_threads : hardware_threads();
  device_->device = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
  if (!device_->device) throw MachineError("Embree: cannot start");
  device_->scenes.resize(scene.meshes.size());
  device_->double_sided.resize(scene.meshes.size());
  for (const SceneObject& object : scene.objects) {
    const bool both = scene.materials[static_cast<std::size_t>(object.material)].double_sided;
    RTCScene& built = (both ? device_->double_sided : device_->scenes)[index(object.mesh)];
    if (!built) built = build_mesh_scene(device_->device, scene.mesh_of(object).mesh, both);
  }
}

RayCapture::~RayCapture() = default;

namespace {

// One object seen in one view: rays in model space, hits shaded in the world.
class ObjectCaster {
 public:
  ObjectCaster(const Scene& scene, const SceneObject& object, RTCScene rtc, const CaptureView& view)
      : scene_(scene),
        object_(object),
        mesh_(scene.mesh_of(object).mesh),
        material_(scene.materials[static_cast<std::size_t>(object.material)]),
        rtc_(rtc),
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
    RTCRayHit16 packet;
    alignas(64) int valid[kPacket];
    for (int i = 0; i < kPacket; ++i) {
      const int x = x0 + i % 4, y = y0 + i / 4;
      valid[i] = x < tile.crop.width_px && y < tile.crop.height_px ? -1 : 0;
      set_ray(packet, i, tile.crop.x + x + 0.5, tile.crop.y + y + 0.5);
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid, rtc_, &context, &packet);
    for (int i = 0; i < kPacket; ++i)
      if (valid[i] && packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID)
        store(tile, x0 + i % 4, y0 + i / 4, packet, i);
  }

 private:
  // The direction has 1 along the view's axis, so the ray's parameter is the depth.
  void set_ray(RTCRayHit16& packet, int i, double x_px, double y_px) const {
    const double half = 0.5 * view_.source_px;
    const glm::vec3 dir(forward_ + ((x_px - half) / view_.focal_px) * right_ +
                        ((half - y_px) / view_.focal_px) * up_);
    packet.ray.org_x[i] = static_cast<float>(origin_.x);
    packet.ray.org_y[i] = static_cast<float>(origin_.y);
    packet.ray.org_z[i] = static_cast<float>(origin_.z);
    packet.ray.dir_x[i] = dir.x;
    packet.ray.dir_y[i] = dir.y;
    packet.ray.dir_z[i] = dir.z;
    packet.ray.tnear[i] = 0;
    packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
    packet.ray.time[i] = 0;
    packet.ray.mask[i] = ~0u;
    packet.ray.id[i] = 0;
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }

  void store(CaptureTile& tile, int x, int y, const RTCRayHit16& packet, int i) const {
    const Triangle& t = mesh_.triangles[packet.hit.primID[i]];
    const float u = packet.hit.u[i], v = packet.hit.v[i];
    const glm::vec3 normal_model =
        (1 - u - v) * mesh_.normals[t[0]] + u * mesh_.normals[t[1]] + v * mesh_.normals[t[2]];
    glm::vec3 normal = glm::normalize(glm::mat3(world_from_model_) * normal_model);
    const glm::vec3 ng(packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]);
    const glm::vec3 dir(packet.ray.dir_x[i], packet.ray.dir_y[i], packet.ray.dir_z[i]);
    if (glm::dot(ng, dir) > 0) normal = -normal;  // the far side of a double-sided surface
    const glm::vec3 color = shade(scene_.lighting, material_.base_color, normal);
    tile.color.at(x, y) = {color.x, color.y, color.z, 1};
    tile.inverse_depth.at(x, y) = 1 / packet.ray.tfar[i];
  }

  const Scene& scene_;
  const SceneObject& object_;
  const TriMesh& mesh_;
  const Material& material_;
  RTCScene rtc_;
  const CaptureView& view_;
  glm::dvec3 origin_, right_, up_, forward_;  // in model space
  glm::dmat3 world_from_model_;
};

}  // namespace

CaptureTile RayCapture::capture(ObjectId id, const CaptureView& view, const Crop& crop) const {
  const SceneObject& object = scene_.objects[index(id)];
  const bool both = scene_.materials[static_cast<std::size_t>(object.material)].double_sided;
  RTCScene rtc = (both ? device_->double_sided : device_->scenes)[index(object.mesh)];
  CaptureTile tile{id, view, crop, ImageRgbaFloat(crop.width_px, crop.height_px),
                   Image<float>(crop.width_px, crop.height_px)};
  const ObjectCaster caster(scene_, object, rtc, view);
  for (int y = 0; y < crop.height_px; y += 4)
    for (int x = 0; x < crop.width_px; x += 4) caster.cast_block(tile, x, y);
  return tile;
}

}  // namespace viewcell

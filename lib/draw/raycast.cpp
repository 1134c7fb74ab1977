#include "draw/raycast.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <type_traits>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "base/srgb.h"
#include "draw/ground.h"

namespace viewcell {
namespace {

constexpr int kBlock = 4;  // a packet is 4 x 4 pixels
constexpr int kPacket = 16;
constexpr int kTile = 32;  // pixels a side; one task
// Linear [0, 1] to 8-bit sRGB by table: 0.1 of a level off where the curve is steepest.
constexpr int kTableSize = 1 << 15;
// A ray that meets the back of a surface goes on from there. After so many backs in a row the last
// one is shown.
constexpr int kMostBackFaces = 64;

template <typename Handle, void (*Release)(Handle)>
struct Releaser {
  using pointer = Handle;
  void operator()(Handle handle) const { Release(handle); }
};
using Device = std::unique_ptr<RTCDevice, Releaser<RTCDevice, rtcReleaseDevice>>;
using RayScene = std::unique_ptr<RTCScene, Releaser<RTCScene, rtcReleaseScene>>;

void check_embree(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw MachineError("Embree: out of memory");
  throw_bug(__FILE__, __LINE__, "rtcGetDeviceError(device) == RTC_ERROR_NONE", "error =", error);
}

RayScene build_mesh_scene(RTCDevice device, const TriMesh& mesh) {
  RayScene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);  // no cracks, at no cost that shows
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree reads 16 bytes at the last vertex, so its buffer is its own, padded, not ours.
  void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                            sizeof(glm::vec3), mesh.positions.size());
  void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(Triangle), mesh.triangles.size());
  if (positions && triangles) {
    std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<glm::vec3*>(positions));
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), static_cast<Triangle*>(triangles));
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  check_embree(device);
  return scene;
}

void attach_instance(RTCDevice device, RTCScene top, RTCScene mesh, const SceneObject& object) {
  const RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(instance, mesh);
  const glm::mat4 world_from_model(object.matrix_world_from_model());
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                          glm::value_ptr(world_from_model));
  rtcCommitGeometry(instance);
  rtcAttachGeometry(top, instance);  // in the scene's order: geomID is the object's id
  rtcReleaseGeometry(instance);
}

struct ShadedObject {
  const TriMesh* mesh;
  glm::mat3 rotation;
  glm::vec3 base_color;
  bool double_sided;
};

// Directions of a frame's rays: eye + t * (corner + x * right + y * down).
struct RayFrame {
  glm::vec3 eye, corner, right, down;
  float near;
};

RayFrame make_ray_frame(const Camera& camera, int width_px, int height_px) {
  const glm::dmat3 axes = glm::transpose(glm::dmat3(view_from_world(camera)));
  const double half = std::tan(glm::radians(camera.fov_y_deg) / 2);
  const glm::dvec3 right = axes[0] * (2 * half * camera.aspect / width_px);
  const glm::dvec3 down = -axes[1] * (2 * half / height_px);
  const glm::dvec3 corner = camera.forward - right * (0.5 * width_px) - down * (0.5 * height_px);
  return {glm::vec3(camera.eye), glm::vec3(corner), glm::vec3(right), glm::vec3(down),
          static_cast<float>(camera.near)};
}

// Rays of the block of 4 x 4 pixels at (x0, y0). The frame is a copy, so that the compiler knows it
// apart from the packet and fills 8 lanes at a time.
void set_rays(const RayFrame frame, int x0, int y0, RTCRayHit16& packet) {
  for (int i = 0; i < kPacket; ++i) {
    const float x = static_cast<float>(x0 + i % kBlock) + 0.5f;
    const float y = static_cast<float>(y0 + i / kBlock) + 0.5f;
    packet.ray.dir_x[i] = frame.corner.x + x * frame.right.x + y * frame.down.x;
    packet.ray.dir_y[i] = frame.corner.y + x * frame.right.y + y * frame.down.y;
    packet.ray.dir_z[i] = frame.corner.z + x * frame.right.z + y * frame.down.z;
  }
  std::fill_n(packet.ray.org_x, kPacket, frame.eye.x);
  std::fill_n(packet.ray.org_y, kPacket, frame.eye.y);
  std::fill_n(packet.ray.org_z, kPacket, frame.eye.z);
  std::fill_n(packet.ray.tnear, kPacket, frame.near);  // directions have 1 along the view axis
  std::fill_n(packet.ray.tfar, kPacket, std::numeric_limits<float>::infinity());
  std::fill_n(packet.ray.time, kPacket, 0.0f);
  std::fill_n(packet.ray.mask, kPacket, ~0u);
  std::fill_n(packet.ray.id, kPacket, 0u);
  std::fill_n(packet.ray.flags, kPacket, 0u);
  std::fill_n(packet.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(packet.hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
}

}  // namespace

struct RayCaster::Impl {
  const Scene& scene;
  int n_threads;
  Device device;
  std::vector<RayScene> meshes;
  RayScene top;
  std::vector<ShadedObject> objects;
  std::vector<std::uint8_t> srgb_table;
  Rgba8 sky, ground;
  glm::vec3 ground_middle;

  explicit Impl(const Scene& scene_in, int n_threads_in);
  std::uint8_t encode(float linear) const {
    return srgb_table[static_cast<std::size_t>(std::clamp(linear, 0.0f, 1.0f) * (kTableSize - 1) +
                                               0.5f)];
  }
  Rgba8 encode(const glm::vec3& c, std::uint8_t alpha) const {
    return {encode(c.x), encode(c.y), encode(c.z), alpha};
  }
  void cast_tile(const RayFrame& frame, int x0, int y0, ImageRgba8& image) const;
  void cast_packet(const RayFrame& frame, int x0, int y0, ImageRgba8& image) const;
  void pass_back_faces(RTCRayHit16& packet, RTCIntersectContext& context) const;
  bool is_back_face(const RTCRayHit16& packet, int i) const;
  Rgba8 shade_hit(const RTCRayHit16& packet, int i) const;
  Rgba8 background(const RayFrame& frame, const glm::vec3& direction) const;
};

RayCaster::Impl::Impl(const Scene& scene_in, int n_threads_in)
    : scene(scene_in),
      n_threads(n_threads_in > 0 ? n_threads_in : hardware_threads()),
      device(rtcNewDevice(("threads=" + std::to_string(n_threads)).c_str())),
      srgb_table(kTableSize),
      sky(),
      ground(),
      ground_middle(ground_centre(scene_in)) {
  if (!device) throw MachineError("Embree: cannot start");
  for (int i = 0; i < kTableSize; ++i)
    srgb_table[static_cast<std::size_t>(i)] =
        srgb8_from_linear(static_cast<float>(i) / (kTableSize - 1));
  sky = encode(scene.lighting.sky_color, 0);
  ground = encode(scene.lighting.ground_color, 0);
  for (const SceneMesh& mesh : scene.meshes)
    meshes.push_back(build_mesh_scene(device.get(), mesh.mesh));
  top.reset(rtcNewScene(device.get()));
  for (const SceneObject& object : scene.objects) {
    attach_instance(device.get(), top.get(), meshes[index(object.mesh)].get(), object);
    const Material& material = scene.materials[static_cast<std::size_t>(object.material)];
    objects.push_back({&scene.mesh_of(object).mesh, glm::mat3(glm::mat3_cast(object.rotation)),
                       material.base_color, material.double_sided});
  }
  rtcCommitScene(top.get());
  check_embree(device.get());
}

// Sky or ground: what is not an object.
Rgba8 RayCaster::Impl::background(const RayFrame& frame, const glm::vec3& direction) const {
  const float height = frame.eye.z - ground_middle.z;
  if (!(height * direction.z < 0)) return sky;
  const glm::vec3 offset = frame.eye - (height / direction.z) * direction - ground_middle;
  const float reach = std::max(std::abs(offset.x), std::abs(offset.y));
  return reach <= static_cast<float>(kGroundReach) ? ground : sky;
}

// Normals of hits are in model space, and so must the ray be.
bool RayCaster::Impl::is_back_face(const RTCRayHit16& packet, int i) const {
  const ShadedObject& object = objects[packet.hit.instID[0][i]];
  const glm::vec3 normal(packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]);
  const glm::vec3 direction(packet.ray.dir_x[i], packet.ray.dir_y[i], packet.ray.dir_z[i]);
  return glm::dot(object.rotation * normal, direction) > 0;
}

// The nearest hit of most rays is a front. Casting the others again is much cheaper than a filter
// that Embree would call at every hit.
void RayCaster::Impl::pass_back_faces(RTCRayHit16& packet, RTCIntersectContext& context) const {
  for (int round = 0; round < kMostBackFaces; ++round) {
    alignas(64) int again[kPacket];
    bool any = false;
    for (int i = 0; i < kPacket; ++i) {
      again[i] = 0;
      if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      if (objects[packet.hit.instID[0][i]].double_sided || !is_back_face(packet, i)) continue;
      again[i] = -1;
      any = true;
      packet.ray.tnear[i] =
          std::nextafter(packet.ray.tfar[i], std::numeric_limits<float>::infinity());
      packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    if (!any) return;
    rtcIntersect16(again, top.get(), &context, &packet);
  }
}

Rgba8 RayCaster::Impl::shade_hit(const RTCRayHit16& packet, int i) const {
  const ShadedObject& object = objects[packet.hit.instID[0][i]];
  const Triangle& t = object.mesh->triangles[packet.hit.primID[i]];
  const std::vector<glm::vec3>& normals = object.mesh->normals;
  const float u = packet.hit.u[i], v = packet.hit.v[i];
  const glm::vec3 model = (1 - u - v) * normals[t[0]] + u * normals[t[1]] + v * normals[t[2]];
  glm::vec3 normal = glm::normalize(object.rotation * model);
  if (object.double_sided && is_back_face(packet, i)) normal = -normal;
  return encode(shade(scene.lighting, object.base_color, normal), 255);
}

void RayCaster::Impl::cast_packet(const RayFrame& frame, int x0, int y0, ImageRgba8& image) const {
  RTCRayHit16 packet;
  set_rays(frame, x0, y0, packet);
  const int width = std::min(kBlock, image.width_px - x0);
  const int height = std::min(kBlock, image.height_px - y0);
  alignas(64) int valid[kPacket];
  for (int i = 0; i < kPacket; ++i) valid[i] = i % kBlock < width && i / kBlock < height ? -1 : 0;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, top.get(), &context, &packet);
  pass_back_faces(packet, context);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int i = y * kBlock + x;
      const bool hit = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      image.at(x0 + x, y0 + y) =
          hit ? shade_hit(packet, i)
              : background(frame, {packet.ray.dir_x[i], packet.ray.dir_y[i], packet.ray.dir_z[i]});
    }
}

void RayCaster::Impl::cast_tile(const RayFrame& frame, int x0, int y0, ImageRgba8& image) const {
  for (int y = y0; y < std::min(y0 + kTile, image.height_px); y += kBlock)
    for (int x = x0; x < std::min(x0 + kTile, image.width_px); x += kBlock)
      cast_packet(frame, x, y, image);
}

RayCaster::RayCaster(const Scene& scene, int n_threads)
    : impl_(std::make_unique<Impl>(scene, n_threads)) {}

RayCaster::~RayCaster() = default;

void RayCaster::draw(const Camera& camera, ImageRgba8& image) const {
  const RayFrame frame = make_ray_frame(camera, image.width_px, image.height_px);
  const int columns = (image.width_px + kTile - 1) / kTile;
  const int rows = (image.height_px + kTile - 1) / kTile;
  parallel_for(static_cast<std::size_t>(columns * rows), impl_->n_threads, [&](std::size_t i) {
    const int tile = static_cast<int>(i);
    impl_->cast_tile(frame, tile % columns * kTile, tile / columns * kTile, image);
  });
}

}  // namespace viewcell

#include "draw/raycast.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "base/srgb.h"
#include "draw/ground.h"
#include "rays/ray_scene.h"

namespace viewcell {
namespace {

constexpr int kBlock = 4;  // a packet is 4 x 4 pixels
static_assert(kBlock * kBlock == RayPacket::kSize);
constexpr int kTile = 32;  // pixels a side; one task
// Linear [0, 1] to 8-bit sRGB by table: 0.1 of a level off where the curve is steepest.
constexpr int kTableSize = 1 << 15;
// A ray that hits a back face continues from there. After this many back faces in a row the last
// one is shown.
constexpr int kMostBackFaces = 64;

// Directions of a frame's rays: eye + t * (corner + x * right + y * down).
struct RayFrame {
  glm::vec3 eye, corner, right, down;
  float near;
};

RayFrame make_ray_frame(const Camera& camera, int width_px, int height_px) {
  const PictureAxes axes = picture_axes(camera.forward);
  const double half = std::tan(glm::radians(camera.fov_y_deg) / 2);
  const glm::dvec3 right = axes.right * (2 * half * camera.aspect / width_px);
  const glm::dvec3 down = -axes.up * (2 * half / height_px);
  const glm::dvec3 corner = camera.forward - right * (0.5 * width_px) - down * (0.5 * height_px);
  return {glm::vec3(camera.eye), glm::vec3(corner), glm::vec3(right), glm::vec3(down),
          static_cast<float>(camera.near)};
}

// Rays of the block of 4 x 4 pixels at (x0, y0). The frame is a copy, so that the compiler knows it
// apart from the packet and fills 8 lanes at a time.
void set_rays(const RayFrame frame, int x0, int y0, RayPacket& packet) {
  for (int i = 0; i < RayPacket::kSize; ++i) {
    const float x = static_cast<float>(x0 + i % kBlock) + 0.5f;
    const float y = static_cast<float>(y0 + i / kBlock) + 0.5f;
    packet.set_direction(i, frame.corner + x * frame.right + y * frame.down);
  }
  packet.start(frame.eye, frame.near);  // directions have 1 along the view axis
}

}  // namespace

struct RayCaster::Impl {
  struct ShadedObject {
    const TriMesh* mesh;
    glm::mat3 rotation;
    glm::vec3 base_color;
    bool double_sided;
  };
  const Scene& scene;
  int n_threads;
  RayScene top;  // an instance an object, by id
  std::vector<ShadedObject> objects;
  std::vector<std::uint8_t> srgb_table;
  Rgba8 sky, ground;
  glm::vec3 ground_middle;

  Impl(const Scene& scene_in, int n_threads_in, std::size_t budget_bytes);
  std::uint8_t encode(float linear) const {
    return srgb_table[static_cast<std::size_t>(std::clamp(linear, 0.0f, 1.0f) * (kTableSize - 1) +
                                               0.5f)];
  }
  Rgba8 encode(const glm::vec3& c, std::uint8_t alpha) const {
    return {encode(c.x), encode(c.y), encode(c.z), alpha};
  }
  void cast_tile(const RayFrame& frame, int x0, int y0, ImageRgba8& image) const;
  void cast_packet(const RayFrame& frame, int x0, int y0, ImageRgba8& image) const;
  void build_top(std::size_t budget_bytes);
  const ShadedObject& object_hit(const RayPacket& packet, int i) const {
    return objects[packet.instance[static_cast<std::size_t>(i)]];
  }
  void pass_back_faces(RayPacket& packet) const;
  bool is_back_face(const RayPacket& packet, int i) const;
  Rgba8 shade_hit(const RayPacket& packet, int i) const;
  Rgba8 background(const RayFrame& frame, const glm::vec3& direction) const;
};

RayCaster::Impl::Impl(const Scene& scene_in, int n_threads_in, std::size_t budget_bytes)
    : scene(scene_in),
      n_threads(n_threads_in > 0 ? n_threads_in : hardware_threads()),
      srgb_table(kTableSize),
      sky(),
      ground(),
      ground_middle(ground_centre(scene_in)) {
  build_top(budget_bytes);
  for (int i = 0; i < kTableSize; ++i)
    srgb_table[static_cast<std::size_t>(i)] =
        srgb8_from_linear(static_cast<float>(i) / (kTableSize - 1));
  sky = encode(scene.lighting.sky_color, 0);
  ground = encode(scene.lighting.ground_color, 0);
  for (const SceneObject& object : scene.objects) {
    const Material& material = scene.material_of(object);
    objects.push_back({&scene.mesh_of(object).mesh, glm::mat3(glm::mat3_cast(object.rotation)),
                       material.base_color, material.double_sided});
  }
}

void RayCaster::Impl::build_top(std::size_t budget_bytes) {
  const RayDevice device({n_threads, budget_bytes});
  std::vector<RayScene> meshes;
  for (const SceneMesh& mesh : scene.meshes)
    meshes.emplace_back(device, mesh.mesh.positions, mesh.mesh.triangles);
  std::vector<RayScene::Instance> instances;
  for (const SceneObject& object : scene.objects)
    instances.push_back({&meshes[index(object.mesh)], glm::mat4(object.matrix_world_from_model())});
  top = RayScene(device, instances);
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
bool RayCaster::Impl::is_back_face(const RayPacket& packet, int i) const {
  return glm::dot(object_hit(packet, i).rotation * packet.normal(i), packet.direction(i)) > 0;
}

// The nearest hit of most rays is a front. Casting the others again is much cheaper than a filter
// that Embree would call at every hit.
void RayCaster::Impl::pass_back_faces(RayPacket& packet) const {
  for (int round = 0; round < kMostBackFaces; ++round) {
    RayMask again;
    bool any = false;
    for (int i = 0; i < RayPacket::kSize; ++i) {
      if (!packet.has_hit(i)) continue;
      if (object_hit(packet, i).double_sided || !is_back_face(packet, i)) continue;
      again.set(i, true);
      any = true;
      packet.pass_hit(i);
    }
    if (!any) return;
    top.intersect(again, packet);
  }
}

Rgba8 RayCaster::Impl::shade_hit(const RayPacket& packet, int lane) const {
  const auto i = static_cast<std::size_t>(lane);
  const ShadedObject& object = object_hit(packet, lane);
  const Triangle& t = object.mesh->triangles[packet.triangle[i]];
  const std::vector<glm::vec3>& normals = object.mesh->normals;
  const float u = packet.u[i], v = packet.v[i];
  const glm::vec3 model = (1 - u - v) * normals[t[0]] + u * normals[t[1]] + v * normals[t[2]];
  glm::vec3 normal = glm::normalize(object.rotation * model);
  if (object.double_sided && is_back_face(packet, lane)) normal = -normal;
  return encode(shade(scene.lighting, object.base_color, normal), 255);
}

void RayCaster::Impl::cast_packet(const RayFrame& frame, int x0, int y0, ImageRgba8& image) const {
  RayPacket packet;
  set_rays(frame, x0, y0, packet);
  const int width = std::min(kBlock, image.width_px - x0);
  const int height = std::min(kBlock, image.height_px - y0);
  RayMask mask;
  for (int i = 0; i < RayPacket::kSize; ++i) mask.set(i, i % kBlock < width && i / kBlock < height);
  top.intersect(mask, packet);
  pass_back_faces(packet);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int i = y * kBlock + x;
      image.at(x0 + x, y0 + y) =
          packet.has_hit(i) ? shade_hit(packet, i) : background(frame, packet.direction(i));
    }
}

void RayCaster::Impl::cast_tile(const RayFrame& frame, int x0, int y0, ImageRgba8& image) const {
  for (int y = y0; y < std::min(y0 + kTile, image.height_px); y += kBlock)
    for (int x = x0; x < std::min(x0 + kTile, image.width_px); x += kBlock)
      cast_packet(frame, x, y, image);
}

RayCaster::RayCaster(const Scene& scene, int n_threads, std::size_t budget_bytes)
    : impl_(std::make_unique<Impl>(scene, n_threads, budget_bytes)) {}

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

#include "draw/raycast.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "base/srgb.h"
#include "draw/ground.h"
#include "rays/ray_scene.h"
#include "scene/surface.h"

namespace viewcell {
namespace {

constexpr int kBlock = 4;  // a packet is 4 x 4 pixels
static_assert(kBlock * kBlock == RayPacket::kSize);
constexpr int kTile = 32;  // pixels a side; one task
// Linear [0, 1] to 8-bit sRGB by table: 0.1 of a level off where the curve is steepest.
constexpr int kTableSize = 1 << 15;
// A ray that hits a back face, or a hole, continues from there. After this many in a row the last
// one is shown.
constexpr int kMostPassed = 64;

// Directions of a frame's rays: eye + t * (corner + x * right + y * down).
struct RayFrame {
  glm::vec3 eye, corner, right, down;
  float near;
  glm::dvec3 eye_world;

  glm::vec3 through(int x, int y) const {
    return corner + (static_cast<float>(x) + 0.5f) * right + (static_cast<float>(y) + 0.5f) * down;
  }
};

RayFrame make_ray_frame(const Camera& camera, int width_px, int height_px) {
  const PictureAxes axes = picture_axes(camera.forward);
  const double half = std::tan(glm::radians(camera.fov_y_deg) / 2);
  const glm::dvec3 right = axes.right * (2 * half * camera.aspect / width_px);
  const glm::dvec3 down = -axes.up * (2 * half / height_px);
  const glm::dvec3 corner = camera.forward - right * (0.5 * width_px) - down * (0.5 * height_px);
  return {glm::vec3(camera.eye),           glm::vec3(corner), glm::vec3(right), glm::vec3(down),
          static_cast<float>(camera.near), camera.eye};
}

// Rays of the block of 4 x 4 pixels at (x0, y0). The frame is a copy, so that the compiler knows it
// apart from the packet and fills 8 lanes at a time.
void set_rays(const RayFrame frame, int x0, int y0, RayPacket& packet) {
  for (int i = 0; i < RayPacket::kSize; ++i)
    packet.set_direction(i, frame.through(x0 + i % kBlock, y0 + i / kBlock));
  packet.start(frame.eye, frame.near);  // directions have 1 along the view axis
}

SurfacePoint surface_point(const RayPacket& packet, int lane) {
  const auto i = static_cast<std::size_t>(lane);
  return {packet.triangle[i], packet.u[i], packet.v[i]};
}

}  // namespace

struct RayCaster::Impl {
  struct ShadedObject {
    const SceneObject* object;
    ObjectSurface surface;
    glm::mat3 rotation;
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
  // A packet and the pixel of its first ray.
  struct Block {
    const RayFrame& frame;
    int x0, y0;
    RayPacket packet;
  };
  void pass_what_is_not_there(Block& block) const;
  bool is_back_face(const RayPacket& packet, int i) const;
  bool is_passed(const Block& block, int i) const;
  PixelRays rays_of(const Block& block, int i) const;
  Rgba8 shade_hit(const Block& block, int i) const;
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
  for (const SceneObject& object : scene.objects)
    objects.push_back(
        {&object, ObjectSurface(scene, object), glm::mat3(glm::mat3_cast(object.rotation))});
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

// The object's pictures are looked up by them, so others do without.
PixelRays RayCaster::Impl::rays_of(const Block& block, int i) const {
  const ShadedObject& hit = object_hit(block.packet, i);
  if (!hit.surface.has_pictures()) return {};
  const int x = block.x0 + i % kBlock, y = block.y0 + i / kBlock;
  const auto to_model = [&](int to_x, int to_y) {
    return glm::transpose(hit.rotation) * block.frame.through(to_x, to_y);
  };
  return {glm::vec3(hit.object->model_from_world(block.frame.eye_world)), to_model(x, y),
          to_model(x + step_in_block(x), y), to_model(x, y + step_in_block(y))};
}

bool RayCaster::Impl::is_passed(const Block& block, int i) const {
  const ObjectSurface& surface = object_hit(block.packet, i).surface;
  if (!surface.needs_passing()) return !surface.is_double_sided() && is_back_face(block.packet, i);
  return surface.is_passed(surface_point(block.packet, i), is_back_face(block.packet, i),
                           rays_of(block, i));
}

// The nearest hit of most rays is a front. Casting the others again is much cheaper than a filter
// that Embree would call at every hit.
void RayCaster::Impl::pass_what_is_not_there(Block& block) const {
  for (int round = 0; round < kMostPassed; ++round) {
    RayMask again;
    bool any = false;
    for (int i = 0; i < RayPacket::kSize; ++i) {
      if (!block.packet.has_hit(i) || !is_passed(block, i)) continue;
      again.set(i, true);
      any = true;
      block.packet.pass_hit(i);
    }
    if (!any) return;
    top.intersect(again, block.packet);
  }
}

Rgba8 RayCaster::Impl::shade_hit(const Block& block, int i) const {
  const ObjectSurface& surface = object_hit(block.packet, i).surface;
  const bool is_back = surface.is_double_sided() && is_back_face(block.packet, i);
  return encode(surface.color(surface_point(block.packet, i), is_back, rays_of(block, i)), 255);
}

void RayCaster::Impl::cast_packet(const RayFrame& frame, int x0, int y0, ImageRgba8& image) const {
  Block block{frame, x0, y0, {}};
  set_rays(frame, x0, y0, block.packet);
  const int width = std::min(kBlock, image.width_px - x0);
  const int height = std::min(kBlock, image.height_px - y0);
  RayMask mask;
  for (int i = 0; i < RayPacket::kSize; ++i) mask.set(i, i % kBlock < width && i / kBlock < height);
  top.intersect(mask, block.packet);
  pass_what_is_not_there(block);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int i = y * kBlock + x;
      image.at(x0 + x, y0 + y) = block.packet.has_hit(i)
                                     ? shade_hit(block, i)
                                     : background(frame, block.packet.direction(i));
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

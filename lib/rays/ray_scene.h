// Embree behind one door: hierarchies of triangles, asked by packets of rays and for what is near a
// point. Whatever Embree reports, a build throws.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>

namespace viewcell {

/// 16 rays and what each hits first. Lane i of every array is ray i; the layout is Embree's.
struct alignas(64) RayPacket {
  static constexpr int kSize = 16;
  template <typename T>
  using Lanes = std::array<T, kSize>;

  Lanes<float> origin_x, origin_y, origin_z, near;
  Lanes<float> direction_x, direction_y, direction_z, time;
  Lanes<float> far;  ///< where the ray ends; after a hit, where it hits: origin + far * direction
  Lanes<std::uint32_t> mask, id, flags;
  Lanes<float> normal_x, normal_y, normal_z;  ///< of the hit, in its mesh's space, of any length
  Lanes<float> u, v;                          ///< weights of the triangle's corners 1 and 2
  Lanes<std::uint32_t> triangle, geometry;
  Lanes<std::uint32_t> instance;  ///< number among the instances, where there are any

  /// Rays without directions, from one point, from `near_in` to infinity, that have hit nothing.
  void start(const glm::vec3& origin, float near_in);
  void set_direction(int i, const glm::vec3& d) {
    direction_x[at(i)] = d.x, direction_y[at(i)] = d.y, direction_z[at(i)] = d.z;
  }
  /// The ray has hit nothing and starts just beyond where it did.
  void pass_hit(int i);
  bool has_hit(int i) const { return geometry[at(i)] != kNothing; }
  glm::vec3 direction(int i) const {
    return {direction_x[at(i)], direction_y[at(i)], direction_z[at(i)]};
  }
  glm::vec3 normal(int i) const { return {normal_x[at(i)], normal_y[at(i)], normal_z[at(i)]}; }
  /// Triangles run counter-clockwise around their fronts.
  bool hits_back(int i) const { return glm::dot(normal(i), direction(i)) > 0; }

 private:
  static constexpr std::uint32_t kNothing = 0xffffffffu;
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
};

/// -1: the lane takes part; 0: it does not.
struct alignas(64) RayMask {
  std::array<int, RayPacket::kSize> lanes{};
  void set(int i, bool takes_part) { lanes[static_cast<std::size_t>(i)] = takes_part ? -1 : 0; }
  bool operator[](int i) const { return lanes[static_cast<std::size_t>(i)] != 0; }
};

struct RayDeviceOptions {
  int n_threads = 0;             ///< that build; 0: all
  std::size_t budget_bytes = 0;  ///< that Embree may hold at once; 0: as many as there are
};

/// An Embree of its own. Scenes keep alive what they need of it. Move-only.
class RayDevice {
 public:
  /// Throws MachineError when Embree cannot start.
  explicit RayDevice(const RayDeviceOptions& options = {});
  ~RayDevice();
  RayDevice(RayDevice&&) noexcept;
  RayDevice& operator=(RayDevice&&) noexcept;

 private:
  friend class RayScene;
  struct State;
  std::shared_ptr<State> state_;
};

struct RaySceneOptions {
  bool fronts_only = false;  ///< rays pass through the backs of triangles
  bool robust = true;        ///< no ray slips between two triangles that share an edge
};

/// A hierarchy. Asking is const and may be done from many threads at once. Move-only.
class RayScene {
 public:
  using Corners = std::array<std::uint32_t, 3>;  // mesh.h's Triangle
  struct Instance {
    const RayScene* mesh = nullptr;
    glm::mat4 world_from_mesh{1};
  };
  /// Whether the triangle shrank the radius within which others still count.
  using VisitNear = bool (*)(void* user, std::uint32_t triangle, float& radius);

  /// Nothing, to be assigned to; a built one is true.
  RayScene();
  /// Copies what it is given; indices must be in range. Throws MachineError when memory runs out
  /// and BugError for whatever else Embree reports.
  RayScene(const RayDevice& device, std::span<const glm::vec3> positions,
           std::span<const Corners> triangles, const RaySceneOptions& options = {});
  /// Meshes of the same device, placed; Embree shares their hierarchies, so they may go.
  RayScene(const RayDevice& device, std::span<const Instance> instances);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;
  explicit operator bool() const { return scene_ != nullptr; }

  /// The first hits of rays that run much alike.
  void intersect(const RayMask& mask, RayPacket& packet) const;
  /// Calls visit(user, triangle, radius) for every triangle whose box comes within the radius of p,
  /// and maybe for others, in any order.
  void visit_near(const glm::vec3& p, float radius, VisitNear visit, void* user) const;

 private:
  struct Release {
    void operator()(void* scene) const;
  };
  std::shared_ptr<RayDevice::State> state_;  // outlives the scene
  std::unique_ptr<void, Release> scene_;     // an RTCScene
};

}  // namespace viewcell

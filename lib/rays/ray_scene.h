// Embree behind one door: hierarchies of triangles, asked by packets of rays and for what is near a
// point. Whatever Embree reports, a build throws.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>

#include "rays/ray_packet.h"

struct RTCPointQueryFunctionArguments;

namespace viewcell {

/// A triangle that may be near a point. Visitors get Embree's own arguments, as they are: a call of
/// ours in between, some hundred for each point, would cost 5 %.
struct NearTriangle {
  struct Ball {
    float x, y, z, time, radius;
  };
  Ball* ball;  ///< others still count within it: a visitor may shrink its radius
  void* user;
  std::uint32_t triangle, geometry;

  static NearTriangle& of(RTCPointQueryFunctionArguments* arguments) {
    return *reinterpret_cast<NearTriangle*>(arguments);  // laid out alike
  }
};
/// Whether it shrank the radius.
using VisitNear = bool (*)(RTCPointQueryFunctionArguments*);

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
  /// Visits every triangle whose box comes within the radius of p, and maybe others, in any order.
  void visit_near(const glm::vec3& p, float radius, VisitNear visit, void* user) const;

 private:
  struct Release {
    void operator()(void* scene) const;
  };
  std::shared_ptr<RayDevice::State> state_;  // outlives the scene
  std::unique_ptr<void, Release> scene_;     // an RTCScene
};

}  // namespace viewcell

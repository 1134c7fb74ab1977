// Packets of rays, as hierarchies are asked by (rays/ray_scene.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

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

}  // namespace viewcell

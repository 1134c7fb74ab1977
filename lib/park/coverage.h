// How much of a frame objects cover, estimated without drawing them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// Points spread evenly over a mesh's surface, and the half side of the squares that, set at them,
/// look like the mesh from afar.
struct CoverageSamples {
  std::vector<glm::vec3> points;
  float radius = 0;
};

/// n points, by area; the same for the same mesh.
CoverageSamples sample_surface(const TriMesh& mesh, int n);

/// Everything around an eye, as bits: columns half a degree apart, rows by the slope up or down.
class Panorama {
 public:
  explicit Panorama(const glm::dvec3& eye) : eye_(eye) {}
  /// Draws samples turned by yaw_rad about z, then moved.
  void draw(const CoverageSamples& samples, double yaw_rad, const glm::dvec3& translation);
  /// The share of a square frame, kFovYDeg wide, level and centred on yaw_rad, that is covered.
  /// Within about a tenth of itself on the average of many frames.
  double coverage(double yaw_rad) const;

  static constexpr int kColumns = 720;

 private:
  static constexpr int kRows = 128;             // of slopes from -kMaxSlope to kMaxSlope
  static constexpr double kMaxSlope = 0.6;      // just over tan(30 deg), the frame's upper edge
  using Column = std::array<std::uint64_t, 2>;  // the rows below the horizon, then above
  void cover(double angle_rad, double slope, double half_angle, double half_slope);

  glm::dvec3 eye_;
  std::array<Column, kColumns> columns_{};
};

}  // namespace viewcell

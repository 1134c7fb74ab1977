// The point of a triangle mesh that is nearest to a given point.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "mesh/mesh.h"

namespace viewcell {

/// The point of the triangle a, b, c nearest to p. A triangle that is (almost) a segment or a point
/// counts as its edges; the error is then below 1e-8 of the longest edge, otherwise it is rounding.
glm::dvec3 closest_point_on_triangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                                     const glm::dvec3& c);

/// Weights of the corners at p, a point of the triangle a, b, c; none is negative, their sum is 1.
/// In a triangle that is (almost) a segment the corner off its longest edge has none.
glm::dvec3 corner_weights(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                          const glm::dvec3& c);

struct ClosestPoint {
  glm::dvec3 point{0};         ///< on the mesh
  double distance = 0;         ///< in the mesh's units
  std::uint32_t triangle = 0;  ///< the lowest number among the nearest
};

/// Nearest points by a bounding volume hierarchy (rays/ray_scene.h). The hierarchy is in float;
/// what it leaves over is measured in double precision, and it leaves over no triangle that could
/// be the nearest, so results are those of trying every triangle, whatever the hierarchy is like.
/// Coordinates may have any size and lie anywhere.
class ClosestPointFinder {
 public:
  /// domain: a box that holds the mesh and all points that will be asked about; the hierarchy works
  /// in it, and is slow for meshes below 1e-5 of it. mesh must have a triangle, finite positions
  /// and indices in range, and must outlive the finder. n_threads (0: all) build, in budget_bytes
  /// at most (0: as many as there are). Throws MachineError when that is not enough.
  ClosestPointFinder(const TriMesh& mesh, const Box& domain, int n_threads = 0,
                     std::size_t budget_bytes = 0);
  ~ClosestPointFinder();
  ClosestPointFinder(const ClosestPointFinder&) = delete;
  ClosestPointFinder& operator=(const ClosestPointFinder&) = delete;

  /// hint: a triangle that is probably near, such as the one found for a neighbouring point. It
  /// changes the time only. May be called from several threads; about a microsecond.
  ClosestPoint find(const glm::dvec3& p, std::uint32_t hint = 0) const;

  /// The same among triangles whose normals make less than a right angle with direction: one side
  /// of a sheet. Nothing when none of them is within the distance given.
  std::optional<ClosestPoint> find_facing(const glm::dvec3& p, const glm::dvec3& direction,
                                          double within) const;

 private:
  struct Hierarchy;
  std::unique_ptr<Hierarchy> hierarchy_;
};

}  // namespace viewcell

// Back-faces of a whole region: triangles that face away from every point where the eye may be.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// A convex region given by its corners, in the mesh's own space.
using RegionCorners = std::vector<glm::dvec3>;

/// Whether the triangle is back-facing to every point of the region's hull [Chen06 5.2.1]: with the
/// outward normal n and a point p of its plane, dot(n, p - eye) >= 0 is linear in the eye, so the
/// corners decide. A prism needs its twelve corners, not a hexagon's six.
/// margin: a triangle seen at an angle of less than asin(margin) counts as front-facing; it covers
/// the rounding of single-precision positions. A triangle without area is back-facing.
bool is_back_facing(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                    std::span<const glm::dvec3> region, double margin = 1e-5);

/// One flag a triangle. Valid for single-sided materials only: of others both sides are seen.
std::vector<bool> find_regional_back_faces(std::span<const glm::vec3> positions,
                                           std::span<const Triangle> triangles,
                                           std::span<const glm::dvec3> region);

}  // namespace viewcell

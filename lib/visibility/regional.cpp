#include "visibility/regional.h"

#include <algorithm>

namespace viewcell {

// Follows: [Chen06 5.2.1], with the printed sign turned: the vector goes from the corner to
// the triangle, so it agrees with an outward normal where the face is turned away.
bool is_back_facing(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                    std::span<const glm::dvec3> region, double margin) {
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double length = glm::length(normal);
  if (!(length > 0)) return true;
  return std::all_of(region.begin(), region.end(), [&](const glm::dvec3& corner) {
    const glm::dvec3 to = a - corner;
    return glm::dot(normal, to) > margin * length * glm::length(to);
  });
}

std::vector<bool> find_regional_back_faces(std::span<const glm::vec3> positions,
                                           std::span<const Triangle> triangles,
                                           std::span<const glm::dvec3> region) {
  std::vector<bool> back(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto corner = [&](std::size_t k) { return glm::dvec3(positions[triangles[t][k]]); };
    back[t] = is_back_facing(corner(0), corner(1), corner(2), region);
  }
  return back;
}

}  // namespace viewcell

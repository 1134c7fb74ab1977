// Areas in the texture of what a log of adaptations holds.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "adapt/adaptation.h"

namespace viewcell {

inline double area(const std::array<glm::vec2, 3>& p) {
  const glm::dvec2 a = glm::dvec2(p[1]) - glm::dvec2(p[0]), b = glm::dvec2(p[2]) - glm::dvec2(p[0]);
  return (a.x * b.y - a.y * b.x) / 2;
}

inline double area(const Adaptation& adaptation, const AdaptationTriangle& t,
                   glm::vec2 AdaptationPoint::*place) {
  std::array<glm::vec2, 3> p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = adaptation.points[t.corners[k]].*place;
  return area(p);
}

// The area in the texture of the faces of a vertex that are as in the finest mesh.
inline double original_area(const ProgressiveMesh& mesh, const ProgressiveMesh& finest,
                            std::uint32_t v) {
  double sum = 0;
  const ProgressiveRecord &now = mesh.record(), &first = finest.record();
  const std::size_t n = now.attributes.positions.size();
  for (std::size_t f = 0; f < now.faces.size(); ++f) {
    if (!mesh.has_face(f) || now.faces[f] != first.faces[f]) continue;
    bool is_of_star = false;
    std::array<glm::vec2, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t w = now.faces[f][k];
      p[k] = now.texcoords[w];
      is_of_star = is_of_star || now.vertex_of[w < n ? w : now.extra_sources[w - n]] == v;
    }
    if (is_of_star) sum += std::abs(area(p));
  }
  return sum;
}

inline double original_area(const Adaptation& adaptation) {
  double sum = 0;
  for (const AdaptationTriangle& t : adaptation.triangles)
    sum += t.is_original() ? std::abs(area(adaptation, t, &AdaptationPoint::before)) : 0;
  return sum;
}

}  // namespace viewcell

// A closed bumpy torus: a mesh with flat and curved parts, at any fineness.
#pragma once

#include <cmath>

#include "mesh/mesh.h"

namespace viewcell {

/// n_around x n_along quads, two triangles each; outward; offset is added to every position.
inline TriMesh make_bumpy_torus(std::uint32_t n_around, std::uint32_t n_along,
                                glm::vec3 offset = glm::vec3(0), float size = 1) {
  constexpr double kTurn = 6.283185307179586;
  TriMesh mesh;
  for (std::uint32_t i = 0; i < n_along; ++i)
    for (std::uint32_t j = 0; j < n_around; ++j) {
      const double u = kTurn * i / n_along, v = kTurn * j / n_around;
      const double r = 0.3 + 0.03 * std::sin(5 * u) * std::cos(3 * v);
      const glm::dvec3 p((1 + r * std::cos(v)) * std::cos(u), (1 + r * std::cos(v)) * std::sin(u),
                         r * std::sin(v));
      mesh.positions.push_back(size * glm::vec3(p) + offset);
    }
  for (std::uint32_t i = 0; i < n_along; ++i)
    for (std::uint32_t j = 0; j < n_around; ++j) {
      const std::uint32_t i1 = (i + 1) % n_along, j1 = (j + 1) % n_around;
      const std::uint32_t a = i * n_around + j, b = i1 * n_around + j;
      const std::uint32_t c = i1 * n_around + j1, d = i * n_around + j1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

}  // namespace viewcell

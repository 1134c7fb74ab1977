// A mesh to measure on, of any size, the same on every machine.
#pragma once

#include <cmath>

#include "base/random.h"
#include "mesh/mesh.h"

namespace viewcell {

/// A torus with bumps and jitter, of 4 n^2 triangles, with texture coordinates in one chart that is
/// cut along both ways around. Closed, without two vertices at one place.
inline TriMesh make_bumpy_torus(std::uint32_t n) {
  constexpr double kTurn = 6.283185307179586;
  const std::uint32_t n_round = 2 * n, n_tube = n;
  Random random(1);
  TriMesh mesh;
  for (std::uint32_t i = 0; i < n_round; ++i)
    for (std::uint32_t j = 0; j < n_tube; ++j) {
      const double a = kTurn * (i + random.uniform(-0.2, 0.2)) / n_round;
      const double b = kTurn * (j + random.uniform(-0.2, 0.2)) / n_tube;
      const double bumps = std::sin(9 * a) * std::cos(7 * b) + 0.4 * std::sin(31 * a + 23 * b);
      const double tube = 0.4 + 0.03 * bumps + random.uniform(-0.02, 0.02) / n;
      const double radius = 1 + tube * std::cos(b);
      mesh.positions.emplace_back(radius * std::cos(a), radius * std::sin(a), tube * std::sin(b));
    }
  const auto add = [&](std::uint32_t i, std::uint32_t j) {
    mesh.texcoords.emplace_back(float(i) / float(n_round), float(j) / float(n_tube));
    return i % n_round * n_tube + j % n_tube;
  };
  for (std::uint32_t i = 0; i < n_round; ++i)
    for (std::uint32_t j = 0; j < n_tube; ++j) {
      mesh.triangles.push_back({add(i, j), add(i + 1, j), add(i + 1, j + 1)});
      mesh.triangles.push_back({add(i, j), add(i + 1, j + 1), add(i, j + 1)});
    }
  return mesh;
}

}  // namespace viewcell

// Surfaces to cut disks from.
#pragma once

#include <cmath>

#include "base/random.h"
#include "mesh/mesh.h"

namespace viewcell {

/// n x n squares, two triangles each, counter-clockwise from above; vertex (i, j) is i + (n + 1) j.
/// Inner vertices are moved by up to `jitter` < 0.25 of a square's side, in the plane.
//   6---7---8
//   | / | / |
//   3---4---5
//   | / | / |
//   0---1---2
inline TriMesh make_grid(std::uint32_t n, double jitter = 0, std::uint64_t seed = 0) {
  Random random(seed);
  TriMesh mesh;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const bool is_inner = i > 0 && j > 0 && i < n && j < n;
      const double amount = is_inner ? jitter : 0;
      const double dx = random.uniform(-amount, amount), dy = random.uniform(-amount, amount);
      mesh.positions.emplace_back((i + dx) / n, (j + dy) / n, 0);
    }
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = i + (n + 1) * j, b = a + 1, c = b + n + 1, d = a + n + 1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

/// A closed ball of n rings of 2 n squares, poles cut to triangles: 4 n (n - 1) triangles, outward.
/// Vertex 0 is the top.
inline TriMesh make_ball(std::uint32_t n, glm::dvec3 centre = {}, double radius = 1) {
  constexpr double kTurn = 6.283185307179586;
  const std::uint32_t m = 2 * n, last = 1 + (n - 1) * m;
  TriMesh mesh;
  mesh.positions.emplace_back(centre + glm::dvec3(0, 0, radius));
  for (std::uint32_t i = 1; i < n; ++i)
    for (std::uint32_t j = 0; j < m; ++j) {
      const double a = kTurn / 2 * i / n, b = kTurn * j / m;
      mesh.positions.emplace_back(centre + radius * glm::dvec3(std::sin(a) * std::cos(b),
                                                               std::sin(a) * std::sin(b),
                                                               std::cos(a)));
    }
  mesh.positions.emplace_back(centre - glm::dvec3(0, 0, radius));
  for (std::uint32_t j = 0; j < m; ++j) mesh.triangles.push_back({0, 1 + j, 1 + (j + 1) % m});
  for (std::uint32_t i = 0; i + 2 < n; ++i)
    for (std::uint32_t j = 0; j < m; ++j) {
      const std::uint32_t a = 1 + i * m + j, b = 1 + i * m + (j + 1) % m;
      mesh.triangles.push_back({a, a + m, b + m});
      mesh.triangles.push_back({a, b + m, b});
    }
  for (std::uint32_t j = 0; j < m; ++j)
    mesh.triangles.push_back({last, 1 + (n - 2) * m + (j + 1) % m, 1 + (n - 2) * m + j});
  return mesh;
}

/// Both meshes as one; positions stay apart.
inline TriMesh join_meshes(TriMesh a, const TriMesh& b) {
  const auto n = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const Triangle& t : b.triangles) a.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  return a;
}

/// Every triangle with vertices of its own, each coordinate off by up to `noise`.
inline TriMesh make_noisy_soup(const TriMesh& mesh, double noise, std::uint64_t seed) {
  Random random(seed);
  TriMesh out;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    out.triangles.push_back({first, first + 1, first + 2});
    for (const std::uint32_t v : t) {
      glm::dvec3 p(mesh.positions[v]);
      for (int k = 0; k < 3; ++k) p[k] += random.uniform(-noise, noise);
      out.positions.emplace_back(p);
    }
  }
  return out;
}

}  // namespace viewcell

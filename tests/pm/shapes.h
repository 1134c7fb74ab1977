// Small meshes with known answers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/random.h"
#include "mesh/mesh.h"

namespace viewcell {

/// n x n unit squares in the plane z = 0, two triangles each; vertex (x, y) is y * (n + 1) + x.
//
//   6---7---8
//   | / | / |
//   3---4---5      n = 2
//   | / | / |
//   0---1---2
inline TriMesh make_flat_grid(std::uint32_t n) {
  TriMesh mesh;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) mesh.positions.emplace_back(x, y, 0);
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

/// Regular octahedron: 0 +x, 1 +y, 2 -x, 3 -y, 4 +z, 5 -z.
inline TriMesh make_octahedron() {
  TriMesh mesh;
  mesh.positions = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t i = 0; i < 4; ++i) {
    mesh.triangles.push_back({i, (i + 1) % 4, 4});
    mesh.triangles.push_back({(i + 1) % 4, i, 5});
  }
  return mesh;
}

inline TriMesh make_tetrahedron() {
  TriMesh mesh;
  mesh.positions = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

/// Every triangle cut into four, `times` times.
inline void subdivide(TriMesh& mesh, int times) {
  for (; times > 0; --times) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto next = static_cast<std::uint32_t>(mesh.positions.size());
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), next);
      if (is_new) mesh.positions.push_back(0.5f * (mesh.positions[a] + mesh.positions[b]));
      return at->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : std::vector<Triangle>(mesh.triangles)) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Triangle& t : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
        finer.push_back(t);
    }
    mesh.triangles = std::move(finer);
  }
}

/// An octahedron blown up to a sphere of 8 * 4^times triangles, radii within 1 +- noise.
inline TriMesh make_noisy_sphere(int times, double noise, std::uint64_t seed) {
  Random random(seed);
  TriMesh mesh = make_octahedron();
  subdivide(mesh, times);
  for (glm::vec3& p : mesh.positions)
    p = glm::normalize(p) * static_cast<float>(1 + random.uniform(-noise, noise));
  return mesh;
}

/// The cube [0, n]^3, each face n x n squares; corners and edges shared.
inline TriMesh make_fine_cube(int n) {
  TriMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [at, is_new] =
        numbers.try_emplace(p, static_cast<std::uint32_t>(mesh.positions.size()));
    if (is_new) mesh.positions.emplace_back(p[0], p[1], p[2]);
    return at->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto at = [&](int u, int v) {
            std::array<int, 3> p{};
            p[axis] = side, p[(axis + 1) % 3] = i + u, p[(axis + 2) % 3] = j + v;
            return vertex(p);
          };
          Triangle a{at(0, 0), at(1, 0), at(1, 1)}, b{at(0, 0), at(1, 1), at(0, 1)};
          if (side == 0) std::swap(a[1], a[2]), std::swap(b[1], b[2]);
          mesh.triangles.push_back(a);
          mesh.triangles.push_back(b);
        }
  return mesh;
}

/// Whether every directed edge occurs once and so does its opposite, and the triangles at each
/// vertex form one fan: a closed oriented 2-manifold.
inline bool is_closed_manifold(const std::vector<Triangle>& triangles) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::map<std::uint32_t, std::map<std::uint32_t, std::uint32_t>> next;  // around each vertex
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      if (!edges.emplace(t[k], t[(k + 1) % 3]).second) return false;
      next[t[k]][t[(k + 1) % 3]] = t[(k + 2) % 3];
    }
  for (const auto& [a, b] : edges)
    if (!edges.contains({b, a})) return false;
  for (const auto& [v, around] : next) {
    std::size_t n = 0;
    std::uint32_t at = around.begin()->first;
    do {
      at = around.at(at);
      ++n;
    } while (at != around.begin()->first && n <= around.size());
    if (n != around.size()) return false;
  }
  return true;
}

/// V - E + F over the vertices that triangles use.
inline int euler_characteristic(const std::vector<Triangle>& triangles) {
  std::set<std::uint32_t> vertices;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      vertices.insert(t[k]);
      edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    }
  return static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) +
         static_cast<int>(triangles.size());
}

/// The same triangles, each from its lowest corner on, sorted.
inline std::vector<Triangle> normalised(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

/// An open mesh in relief, with texture coordinates that are a little off.
inline TriMesh make_relief(std::uint64_t seed) {
  Random random(seed);
  TriMesh grid = make_flat_grid(7);
  std::vector<glm::vec2> uv;
  for (glm::vec3& p : grid.positions) {
    uv.emplace_back(p.x + random.uniform(-0.1, 0.1), p.y + random.uniform(-0.1, 0.1));
    p.z = static_cast<float>(random.uniform(0, 0.7));
  }
  for (const Triangle& t : grid.triangles)
    for (const std::uint32_t v : t) grid.texcoords.push_back(uv[v]);
  return grid;
}

}  // namespace viewcell

// Models by formula, as hard to handle as the scans that they stand in for: no test needs a file
// from outside. What is known of them is known by construction.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "mesh/mesh.h"
#include "mesh/topology.h"

namespace viewcell {

/// A closed figure of n rings of 2 n squares, poles cut to triangles: 4 n (n - 1) triangles,
/// outward, genus 0, z up, some three units high; two ears, and bumps of a hundredth all over.
/// Vertex 0 is the top pole, 1 + 2 n (i - 1) + j the one of ring i and column j, the last the
/// bottom pole.
inline TriMesh make_lumpy_figure(std::uint32_t n) {
  const std::uint32_t m = 2 * n, last = 1 + (n - 1) * m;
  const double half_turn = std::acos(-1.0);
  const auto add = [](TriMesh& mesh, const glm::dvec3& d) {
    const auto lobe = [&d](const glm::dvec3& to, double sharpness) {
      return std::exp(sharpness * (glm::dot(d, glm::normalize(to)) - 1));
    };
    const double ears = lobe({0.5, 0.1, 1.2}, 40) + lobe({-0.5, 0.1, 1.2}, 40);
    const double bumps = std::sin(31 * d.x + 5 * d.z) * std::sin(29 * d.y) * std::sin(37 * d.z);
    const double radius = 1 + 0.9 * ears + 0.25 * lobe({0, -1, 0.3}, 8) + 0.01 * bumps;
    mesh.positions.emplace_back(radius * d * glm::dvec3(1, 0.8, 1.3));
  };
  TriMesh mesh;
  add(mesh, {0, 0, 1});
  for (std::uint32_t i = 1; i < n; ++i)
    for (std::uint32_t j = 0; j < m; ++j) {
      const double a = half_turn * i / n, b = half_turn * j / n;
      add(mesh, {std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)});
    }
  add(mesh, {0, 0, -1});
  const auto at = [m](std::uint32_t i, std::uint32_t j) { return 1 + (i - 1) * m + j % m; };
  for (std::uint32_t j = 0; j < m; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    for (std::uint32_t i = 1; i + 1 < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    mesh.triangles.push_back({last, at(n - 1, j + 1), at(n - 1, j)});
  }
  return mesh;
}

/// The figure in n_charts gores, as an orange is peeled, side by side on the picture; n_charts
/// divides 2 n. Positions are shared, texture coordinates differ where gores meet.
inline TriMesh make_gored_figure(std::uint32_t n, std::uint32_t n_charts) {
  TriMesh mesh = make_lumpy_figure(n);
  const std::uint32_t m = 2 * n, width = m / n_charts, per_column = 2 * (n - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto column = static_cast<std::uint32_t>(t / per_column), chart = column / width;
    for (const std::uint32_t v : mesh.triangles[t]) {
      const bool is_pole = v == 0 || v + 1 == mesh.positions.size();
      std::uint32_t j = is_pole ? 0 : (v - 1) % m;
      if (!is_pole && j < column) j += m;  // the last column ends at the first
      const double across = is_pole ? 0.5 : double(j - chart * width) / width;
      const double down = is_pole ? (v == 0 ? 0 : 1) : double(1 + (v - 1) / m) / n;
      mesh.texcoords.emplace_back((chart + 0.05 + 0.9 * across) / n_charts, 0.95 - 0.9 * down);
    }
  }
  return mesh;
}

/// A mesh as scans are, and what measure_topology must find in it.
struct Scan {
  TriMesh mesh;
  MeshTopology topology;
};

/// The figure of n rings, n >= 10, with by turns, all over it, far enough apart: a hole of six
/// triangles; a fin, a triangle on an inner edge; two vertices that are one; two edges that are
/// one, with four triangles; a triangle that is turned over. Beside it two tetrahedra and a loose
/// vertex.
inline Scan make_rough_scan(std::uint32_t n) {
  Scan scan;
  TriMesh& mesh = scan.mesh;
  mesh = make_lumpy_figure(n);
  const std::size_t n_vertices = mesh.positions.size(), n_triangles = mesh.triangles.size();
  const std::uint32_t m = 2 * n;
  std::array<std::size_t, 5> count{};
  const auto replace = [&mesh](std::uint32_t from, std::uint32_t to) {
    for (Triangle& t : mesh.triangles) std::replace(t.begin(), t.end(), from, to);
  };
  std::size_t kind = 0;
  for (std::uint32_t i = 4; i + 4 < n; i += 5)
    for (std::uint32_t j = 1; j + 8 < m; j += 10, kind = (kind + 1) % count.size()) {
      const std::uint32_t a = 1 + (i - 1) * m + j, b = a + 1;
      ++count[kind];
      if (kind == 0)
        std::erase_if(mesh.triangles, [a](const Triangle& t) {
          return std::find(t.begin(), t.end(), a) != t.end();
        });
      if (kind == 1) {
        mesh.triangles.push_back({a, b, static_cast<std::uint32_t>(mesh.positions.size())});
        mesh.positions.push_back(1.1f * mesh.positions[a]);
      }
      if (kind == 2) replace(a + 3, a);
      if (kind == 3) replace(a + 5, a), replace(b + 5, b);
      if (kind == 4) {
        const Triangle turned{a, a + m, b + m};
        auto found = std::find(mesh.triangles.begin(), mesh.triangles.end(), turned);
        std::swap((*found)[1], (*found)[2]);
      }
    }
  for (const float x : {3.0f, -3.0f}) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& p : {glm::vec3(0), {0.2f, 0, 0}, {0, 0.2f, 0}, {0, 0, 0.2f}})
      mesh.positions.push_back(glm::vec3(x, 0, 0) + p);
    for (const Triangle& t : {Triangle{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
      mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  mesh.positions.emplace_back(0, 0, 5);

  const auto [holes, fins, pinches, seams, turned] = count;
  MeshTopology& expected = scan.topology;
  expected.n_edges = 3 * n_triangles / 2 - 6 * holes + 2 * fins - seams + 2 * 6;
  expected.n_boundary_edges = 6 * holes + 2 * fins;
  expected.n_nonmanifold_edges = fins + seams;
  expected.n_opposed_edges = 3 * turned;
  expected.n_nonmanifold_vertices = 2 * fins + pinches + 2 * seams;
  expected.n_unreferenced_vertices = holes + pinches + 2 * seams + 1;
  expected.n_components = 1 + 2;
  const std::size_t n_used = n_vertices - holes + fins - pinches - 2 * seams + 2 * 4;
  const std::size_t n_left = n_triangles - 6 * holes + fins + 2 * 4;
  expected.euler_characteristic =
      static_cast<std::int64_t>(n_used + n_left) - static_cast<std::int64_t>(expected.n_edges);
  return scan;
}

}  // namespace viewcell

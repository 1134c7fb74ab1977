// A cube with a texture chart a side.
#pragma once

#include "mesh/mesh.h"

namespace viewcell {

/// The cube [0, 1]^3, each side n x n squares of two triangles, counter-clockwise from outside.
/// Side s has chart s: a square of side 0.29 in cell (s % 3, s / 3) of a 3 x 2 grid. Vertices of
/// different sides are not shared.
inline TriMesh make_atlas_cube(std::uint32_t n) {
  TriMesh mesh;
  for (int side = 0; side < 6; ++side) {
    const int axis = side % 3;
    const bool is_far = side >= 3;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto uv = [&](std::uint32_t i, std::uint32_t j) {
      return glm::vec2(0.0231 + 0.327 * (side % 3) + 0.29 * i / n,
                       0.0757 + 0.481 * (is_far ? 1 : 0) + 0.29 * j / n);
    };
    for (std::uint32_t j = 0; j <= n; ++j)
      for (std::uint32_t i = 0; i <= n; ++i) {
        glm::vec3 p(0);
        p[axis] = is_far ? 1.0f : 0.0f;
        p[(axis + 1) % 3] = static_cast<float>(is_far ? i : n - i) / static_cast<float>(n);
        p[(axis + 2) % 3] = static_cast<float>(j) / static_cast<float>(n);
        mesh.positions.push_back(p);
      }
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::array<std::array<std::uint32_t, 2>, 4> at{
            {{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
        for (const auto& [a, b, c] : {Triangle{0, 1, 2}, Triangle{0, 2, 3}}) {
          Triangle t;
          const Triangle corners{a, b, c};
          for (std::size_t k = 0; k < 3; ++k) {
            t[k] = first + at[corners[k]][0] + (n + 1) * at[corners[k]][1];
            mesh.texcoords.push_back(uv(at[corners[k]][0], at[corners[k]][1]));
          }
          mesh.triangles.push_back(t);
        }
      }
  }
  return mesh;
}

}  // namespace viewcell

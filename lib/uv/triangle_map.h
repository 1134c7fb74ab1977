// Which triangle of a mesh each texel of its texture shows.
#pragma once

#include <array>
#include <cstdint>

#include "image/chart_reach.h"
#include "image/owner_map.h"
#include "mesh/mesh.h"

namespace viewcell {

/// The corners of triangle t in the texture (to_texels).
using Corners2 = TexelTriangleOf<double>;
Corners2 texels_of(const TriMesh& mesh, std::size_t t, int width_px, int height_px);

/// Weights of the corners at the point of a triangle that is nearest to p.
glm::dvec3 nearest_weights(const Corners2& at, const glm::dvec2& p);

template <typename Point>
Point mix(const std::array<Point, 3>& at, const glm::dvec3& w) {
  return w.x * at[0] + w.y * at[1] + w.z * at[2];
}

/// Per texel 1 + triangle, or 0.
using TriangleMap = Image<std::uint32_t>;

/// Texels whose centres lie in a triangle; of several, the lowest.
void draw_insides(const TriMesh& mesh, TriangleMap& map);

/// Free texels within kRimTexels of triangles get the nearest of these, of several the lowest.
void draw_rims(const TriMesh& mesh, TriangleMap& map);

}  // namespace viewcell

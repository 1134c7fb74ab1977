// Where a surface ends.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

struct BorderEdge {
  std::uint32_t a, b;  ///< a < b
  std::uint32_t triangle;
};

/// The edges that belong to exactly one triangle, by their ends. A triangle that is a point (see
/// without_copies) has none. O(n), sorted around vertices.
std::vector<BorderEdge> find_border_edges(std::span<const Triangle> triangles,
                                          std::size_t n_vertices);

/// The edges of several triangles of which some two are apart(a, b, triangle, other triangle), once
/// with each of their triangles. O(n), sorted around vertices.
std::vector<BorderEdge> find_edges_between(
    std::span<const Triangle> triangles, std::size_t n_vertices,
    const std::function<bool(std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t)>& apart);

/// Per vertex whether it is an end of one.
std::vector<bool> find_border_vertices(std::span<const Triangle> triangles, std::size_t n_vertices);

}  // namespace viewcell

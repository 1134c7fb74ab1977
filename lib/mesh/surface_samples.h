// Points spread over a surface: its vertices, along its edges, and evenly over its area.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// Describes the sample points; the points themselves are computed on demand, in any order.
struct SurfaceSamples {
  std::vector<std::uint32_t> vertices;              ///< those that a triangle uses, ascending
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< each pair of vertices once, ascending
  std::vector<std::uint64_t> edge_starts;  ///< edge e has samples [starts[e], starts[e + 1])
  std::vector<double> area_before;         ///< of the triangles before t; one more: all
  std::size_t n_face_samples = 0;
  double length = 0;                   ///< of all edges
  std::array<std::uint64_t, 2> shift;  ///< of the low-discrepancy sequence, 64-bit fractions
  double stratum_shift = 0;            ///< in [0, 1)

  std::size_t n_edge_samples() const { return edge_starts.back(); }
  double area() const { return area_before.back(); }
};

/// n_face_samples at least 1. Every triangle gets its share of them by area, rounded down or up.
/// Every edge has at least one sample, and one for each sqrt(area / n_face_samples) of its length,
/// as Metro has; altogether at most 3 n_face_samples and one for each edge. The seed shifts samples
/// on faces. The mesh must have an area above 0.
SurfaceSamples plan_surface_samples(const TriMesh& mesh, std::size_t n_face_samples,
                                    std::uint64_t seed = 0);

/// The area of all triangles.
double surface_area(const TriMesh& mesh);

/// Samples [first, first + points.size()) of each kind.
void sample_vertices(const SurfaceSamples& samples, const TriMesh& mesh, std::size_t first,
                     std::span<glm::dvec3> points);
/// weights: the length of edge that each sample stands for.
void sample_edges(const SurfaceSamples& samples, const TriMesh& mesh, std::size_t first,
                  std::span<glm::dvec3> points, std::span<double> weights);
void sample_faces(const SurfaceSamples& samples, const TriMesh& mesh, std::size_t first,
                  std::span<glm::dvec3> points);

}  // namespace viewcell

#include "mesh/surface_samples.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "mesh/used_vertices.h"

namespace viewcell {
namespace {

constexpr double kEdgeSamplesPerFaceSample = 3;

// The plastic number g solves g^3 = g + 1; these are 2^64 / g and 2^64 / g^2. Multiples of them
// modulo 1 are the R2 sequence. Source: M. Roberts, The unreasonable effectiveness of quasirandom
// sequences, 2018.
constexpr std::array<std::uint64_t, 2> kStep{0xc13fa9a902a6328fu, 0x91e10da5c79e7b1du};

std::vector<std::array<std::uint32_t, 2>> distinct_edges(const TriMesh& mesh) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      if (low != high) edges.push_back({low, high});
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

double edge_length(const TriMesh& mesh, const std::array<std::uint32_t, 2>& edge) {
  return glm::distance(glm::dvec3(mesh.positions[edge[0]]), glm::dvec3(mesh.positions[edge[1]]));
}

double triangle_area(const TriMesh& mesh, const Triangle& t) {
  return 0.5 * glm::length(area_normal(mesh, t));
}

void share_edge_samples(SurfaceSamples& samples, const TriMesh& mesh) {
  for (const auto& edge : samples.edges) samples.length += edge_length(mesh, edge);
  const auto n = static_cast<double>(samples.n_face_samples);
  const double spacing =
      std::max(std::sqrt(samples.area() / n), samples.length / (kEdgeSamplesPerFaceSample * n));
  samples.edge_starts.reserve(samples.edges.size() + 1);
  samples.edge_starts.push_back(0);
  for (const auto& edge : samples.edges) {
    const double share = std::floor(edge_length(mesh, edge) / spacing);
    samples.edge_starts.push_back(samples.edge_starts.back() +
                                  static_cast<std::uint64_t>(std::max(1.0, share)));
  }
}

double unit_fraction(std::uint64_t fraction) {
  return static_cast<double>(fraction >> 11) * 0x1.0p-53;
}

// The unit square onto a triangle, areas kept: square (0,0) (1,0) (1,1) (0,1) is folded along its
// diagonal, not cut, so points that are far apart stay so. Source: E. Heitz, A Low-Distortion Map
// Between Triangle and Square, 2019.
glm::dvec3 square_to_triangle(double x, double y, const glm::dvec3& a, const glm::dvec3& b,
                              const glm::dvec3& c) {
  const double offset = 0.5 * (y - x);
  const double v = 0.5 * x + (offset > 0 ? 0 : -offset), w = 0.5 * y + (offset > 0 ? offset : 0);
  return a + v * (b - a) + w * (c - a);
}

}  // namespace

double surface_area(const TriMesh& mesh) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) area += triangle_area(mesh, t);
  return area;
}

SurfaceSamples plan_surface_samples(const TriMesh& mesh, std::size_t n_face_samples,
                                    std::uint64_t seed) {
  VIEWCELL_CHECK(n_face_samples > 0);
  SurfaceSamples samples;
  samples.n_face_samples = n_face_samples;
  samples.vertices = find_used_vertices(mesh.triangles, mesh.positions.size()).source;
  samples.edges = distinct_edges(mesh);
  samples.area_before.reserve(mesh.triangles.size() + 1);
  samples.area_before.push_back(0);
  for (const Triangle& t : mesh.triangles)
    samples.area_before.push_back(samples.area_before.back() + triangle_area(mesh, t));
  VIEWCELL_CHECK(samples.area() > 0, samples.area());
  share_edge_samples(samples, mesh);
  Random random(seed);
  samples.stratum_shift = random.uniform();
  samples.shift = {random.next(), random.next()};
  return samples;
}

void sample_vertices(const SurfaceSamples& samples, const TriMesh& mesh, std::size_t first,
                     std::span<glm::dvec3> points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = glm::dvec3(mesh.positions[samples.vertices[first + i]]);
}

// An edge of n samples: at the middles of n equal parts.
void sample_edges(const SurfaceSamples& samples, const TriMesh& mesh, std::size_t first,
                  std::span<glm::dvec3> points, std::span<double> weights) {
  const std::vector<std::uint64_t>& starts = samples.edge_starts;
  auto e = static_cast<std::size_t>(std::upper_bound(starts.begin(), starts.end(), first) -
                                    starts.begin() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    while (starts[e + 1] <= first + i) ++e;
    const auto n = static_cast<double>(starts[e + 1] - starts[e]);
    const double along = (static_cast<double>(first + i - starts[e]) + 0.5) / n;
    const glm::dvec3 a(mesh.positions[samples.edges[e][0]]), b(mesh.positions[samples.edges[e][1]]);
    points[i] = a + along * (b - a);
    weights[i] = glm::distance(a, b) / n;
  }
}

// The area is cut into n equal parts, triangle after triangle; sample i is at the same fraction
// of each part, so a triangle gets its share rounded down or up. Where in the triangle: the next
// point of the R2 sequence.
void sample_faces(const SurfaceSamples& samples, const TriMesh& mesh, std::size_t first,
                  std::span<glm::dvec3> points) {
  const std::vector<double>& before = samples.area_before;
  const double part = samples.area() / static_cast<double>(samples.n_face_samples);
  const double last = std::nextafter(samples.area(), 0.0);
  const auto area_at = [&](std::size_t i) {
    return std::min((static_cast<double>(i) + samples.stratum_shift) * part, last);
  };
  auto f = static_cast<std::size_t>(std::upper_bound(before.begin(), before.end(), area_at(first)) -
                                    before.begin() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    while (before[f + 1] <= area_at(first + i)) ++f;
    const Triangle& t = mesh.triangles[f];
    const double x = unit_fraction(samples.shift[0] + (first + i + 1) * kStep[0]);
    const double y = unit_fraction(samples.shift[1] + (first + i + 1) * kStep[1]);
    points[i] =
        square_to_triangle(x, y, glm::dvec3(mesh.positions[t[0]]), glm::dvec3(mesh.positions[t[1]]),
                           glm::dvec3(mesh.positions[t[2]]));
  }
}

}  // namespace viewcell

#include "uv/texcoord_drift.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "mesh/closest_point.h"

namespace viewcell {
namespace {

bool touch(const TriMesh& mesh, std::size_t s, std::size_t t) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (mesh.positions[mesh.triangles[s][i]] == mesh.positions[mesh.triangles[t][k]] &&
          mesh.texcoords[3 * s + i] == mesh.texcoords[3 * t + k])
        return true;
  return false;
}

// Of a point in the triangle's plane, by areas.
glm::dvec2 interpolate_texcoord(const TriMesh& mesh, std::size_t t, const glm::dvec3& p) {
  const glm::dvec3 normal = area_normal(mesh, mesh.triangles[t]);
  const double square = glm::dot(normal, normal);
  const glm::dvec2 uv0 = mesh.texcoords[3 * t];
  if (!(square > 0)) return uv0;
  const auto corner = [&](std::size_t k) {
    return glm::dvec3(mesh.positions[mesh.triangles[t][k]]);
  };
  const glm::dvec3 a = corner(0);
  const double w1 = glm::dot(glm::cross(p - a, corner(2) - a), normal) / square;
  const double w2 = glm::dot(glm::cross(corner(1) - a, p - a), normal) / square;
  return uv0 + w1 * (glm::dvec2(mesh.texcoords[3 * t + 1]) - uv0) +
         w2 * (glm::dvec2(mesh.texcoords[3 * t + 2]) - uv0);
}

constexpr double kElsewhere = -1;

}  // namespace

TexcoordDrift measure_texcoord_drift(const TriMesh& coarse, const TriMesh& fine, int n_threads) {
  const std::size_t n = fine.triangles.size(), n_children = n / coarse.triangles.size();
  VIEWCELL_CHECK(n == n_children * coarse.triangles.size(), n, coarse.triangles.size());
  Box domain = bounding_box(coarse);
  for (const glm::vec3& p : fine.positions) domain.add(p);
  const ClosestPointFinder finder(coarse, domain, n_threads);
  std::vector<double> drifts(n);
  parallel_for(n, n_threads, [&](std::size_t t) {
    glm::dvec3 p(0);
    glm::dvec2 uv(0);
    for (std::size_t k = 0; k < 3; ++k) {
      p += glm::dvec3(fine.positions[fine.triangles[t][k]]) / 3.0;
      uv += glm::dvec2(fine.texcoords[3 * t + k]) / 3.0;
    }
    const std::size_t parent = t / n_children;
    const ClosestPoint nearest = finder.find(p, static_cast<std::uint32_t>(parent));
    drifts[t] =
        touch(coarse, parent, nearest.triangle)
            ? glm::length(interpolate_texcoord(coarse, nearest.triangle, nearest.point) - uv)
            : kElsewhere;
  });
  TexcoordDrift out;
  double sum = 0;
  for (const double drift : drifts) {
    if (drift == kElsewhere) continue;
    sum += drift * drift, ++out.n_compared;
    out.max = std::max(out.max, drift);
  }
  out.n_elsewhere = n - out.n_compared;
  if (out.n_compared > 0) out.rms = std::sqrt(sum / static_cast<double>(out.n_compared));
  return out;
}

}  // namespace viewcell

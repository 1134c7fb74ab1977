#include "uv/uv_stretch.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace viewcell {

TriangleStretch measure_triangle_stretch(const std::array<glm::dvec3, 3>& at,
                                         const std::array<glm::dvec2, 3>& uv) {
  const double area2 = twice_area(uv[0], uv[1], uv[2]);
  // The partial derivatives of the map from the plane to the surface.
  const glm::dvec3 du =
      (at[0] * (uv[1].y - uv[2].y) + at[1] * (uv[2].y - uv[0].y) + at[2] * (uv[0].y - uv[1].y)) /
      area2;
  const glm::dvec3 dv =
      (at[0] * (uv[2].x - uv[1].x) + at[1] * (uv[0].x - uv[2].x) + at[2] * (uv[1].x - uv[0].x)) /
      area2;
  if (area2 == 0) return {HUGE_VAL, HUGE_VAL};
  const double a = glm::dot(du, du), b = glm::dot(du, dv), c = glm::dot(dv, dv);
  return {std::sqrt((a + c) / 2), std::sqrt((a + c + std::hypot(a - c, 2 * b)) / 2)};
}

UvStretch measure_uv_stretch(const TriMesh& mesh) {
  VIEWCELL_CHECK(mesh.texcoords.size() == 3 * mesh.triangles.size(), mesh.texcoords.size());
  UvStretch out;
  double area = 0, area_uv = 0, sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::array<glm::dvec3, 3> at;
    std::array<glm::dvec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = mesh.positions[mesh.triangles[t][k]];
      uv[k] = mesh.texcoords[3 * t + k];
    }
    const double here = 0.5 * glm::length(area_normal(mesh, mesh.triangles[t]));
    const double here_uv = 0.5 * twice_area(uv[0], uv[1], uv[2]);
    out.n_flipped += !(here_uv > 0);
    area += here;
    area_uv += std::abs(here_uv);
    if (!(here > 0)) continue;
    const TriangleStretch stretch = measure_triangle_stretch(at, uv);
    sum += here * stretch.l2 * stretch.l2;
    out.max = std::max(out.max, stretch.max);
  }
  if (!(area > 0)) return out;
  const double scale = std::sqrt(area_uv / area);
  out.l2 = std::sqrt(sum / area) * scale;
  out.max *= scale;
  return out;
}

}  // namespace viewcell

#include "uv/triangle_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viewcell {
namespace {

constexpr int kMostCells = 1024;  // along each side

bool is_finite(const Corners2& p) {
  return std::isfinite(p[0].x + p[0].y + p[1].x + p[1].y + p[2].x + p[2].y);
}

}  // namespace

TriangleGrid::TriangleGrid(const TriMesh& mesh, const std::vector<std::uint32_t>& charts)
    : mesh_(mesh), charts_(charts) {
  glm::dvec2 lo(1e300), hi(-1e300);
  for (const glm::vec2& uv : mesh.texcoords)
    if (std::isfinite(uv.x + uv.y))
      lo = glm::min(lo, glm::dvec2(uv)), hi = glm::max(hi, glm::dvec2(uv));
  const double n_triangles = static_cast<double>(mesh.triangles.size());
  n_ = std::clamp(static_cast<int>(std::sqrt(n_triangles)), 1, kMostCells);
  if (lo.x <= hi.x) lo_ = lo, cell_ = glm::max((hi - lo) / double(n_), glm::dvec2(1e-12));
  cells_ = fill_buckets<std::uint32_t>(bin_index(0, n_), [&](const auto& emit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const Corners2 p = corners_of(t);
      if (!is_finite(p)) continue;
      const glm::ivec2 a = cell_of(glm::min(glm::min(p[0], p[1]), p[2]));
      const glm::ivec2 b = cell_of(glm::max(glm::max(p[0], p[1]), p[2]));
      for (int y = a.y; y <= b.y; ++y)
        for (int x = a.x; x <= b.x; ++x) emit(bin_index(x, y), t);
    }
  });
}

glm::ivec2 TriangleGrid::cell_of(const glm::dvec2& uv) const {
  const glm::dvec2 at = glm::clamp((uv - lo_) / cell_, glm::dvec2(0), glm::dvec2(n_ - 1));
  return {static_cast<int>(at.x), static_cast<int>(at.y)};
}

Corners2 TriangleGrid::corners_of(std::uint32_t t) const {
  return {mesh_.texcoords[3 * t], mesh_.texcoords[3 * t + 1], mesh_.texcoords[3 * t + 2]};
}

// Rings of cells around uv's own, until what lies beyond is farther than what was found.
TriangleGrid::Nearest TriangleGrid::find(const glm::dvec2& uv, std::uint32_t chart) const {
  Nearest best;
  double least2 = std::numeric_limits<double>::infinity();
  const auto search_bin = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= n_ || y >= n_) return;
    for (const std::uint32_t t : cells_.of(bin_index(x, y))) {
      if (charts_[t] != chart) continue;
      const Corners2 p = corners_of(t);
      const glm::dvec3 weights = nearest_weights(p, uv);
      const glm::dvec2 off = mix(p, weights) - uv;
      const double squared = glm::dot(off, off);
      if (squared > least2 || (squared == least2 && t >= best.triangle)) continue;
      least2 = squared, best = {t, weights};
    }
  };
  const glm::ivec2 c = cell_of(uv);
  for (int r = 0; r < n_; ++r) {
    for (int x = c.x - r; x <= c.x + r; ++x) {
      search_bin(x, c.y - r);
      if (r > 0) search_bin(x, c.y + r);
    }
    for (int y = c.y - r + 1; y < c.y + r; ++y) {
      search_bin(c.x - r, y);
      search_bin(c.x + r, y);
    }
    // Distance from uv, or its nearest point of the grid, to the nearest cell not yet seen.
    const glm::dvec2 in = glm::clamp((uv - lo_) / cell_, glm::dvec2(0), glm::dvec2(n_));
    const glm::dvec2 low = (in - glm::dvec2(c - r)) * cell_,
                     high = (glm::dvec2(c + r + 1) - in) * cell_;
    const double reach = std::min(std::min(low.x, low.y), std::min(high.x, high.y));
    if (least2 <= reach * reach) break;
  }
  return best;
}

}  // namespace viewcell

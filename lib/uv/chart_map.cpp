#include "uv/chart_map.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/error.h"
#include "image/owner_map.h"
#include "mesh/topology.h"
#include "uv/triangle_map.h"

namespace viewcell {
namespace {

bool has_finite_texcoords(const TriMesh& mesh, std::size_t triangle) {
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::vec2& uv = mesh.texcoords[3 * triangle + k];
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return false;
  }
  return true;
}

// A corner, and what makes it one with others.
struct Corner {
  std::uint32_t vertex;
  glm::vec2 uv;
  std::uint32_t number;

  auto texture_vertex() const { return std::tie(vertex, uv.x, uv.y); }
};

// Of triangles that may be in a chart.
std::vector<Corner> list_corners(const TriMesh& mesh) {
  const std::vector<std::uint32_t> first_at = match_positions(mesh);
  std::vector<Corner> out;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const Triangle v{first_at[a], first_at[b], first_at[c]};
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0] || !has_finite_texcoords(mesh, t)) continue;
    for (std::uint32_t k = 0; k < 3; ++k)
      out.push_back({v[k], mesh.texcoords[3 * t + k], 3 * t + k});
  }
  return out;
}

}  // namespace

Charts find_charts(const TriMesh& mesh, ChartLink link) {
  VIEWCELL_CHECK(mesh.texcoords.size() == 3 * mesh.triangles.size(), mesh.texcoords.size());
  std::vector<Corner> corners = list_corners(mesh);
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
    return a.texture_vertex() < b.texture_vertex();
  });
  constexpr Triangle kNowhere{kNoTextureVertex, kNoTextureVertex, kNoTextureVertex};
  std::vector<Triangle> texture_vertices(mesh.triangles.size(), kNowhere);
  std::uint32_t n = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    n += i == 0 || corners[i].texture_vertex() != corners[i - 1].texture_vertex();
    texture_vertices[corners[i].number / 3][corners[i].number % 3] = n - 1;
  }
  return connect_charts(texture_vertices, n, link);
}

Image<std::uint32_t> make_chart_map(const TriMesh& mesh, const Charts& charts, int width_px,
                                    int height_px) {
  Image<std::uint32_t> out(width_px, height_px);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (charts.of[t] == kNoChart) continue;
    claim_texels(texels_of(mesh, t, width_px, height_px), charts.of[t] + 1, out,
                 Claim::lowest_owner);
  }
  return out;
}

}  // namespace viewcell

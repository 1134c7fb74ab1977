#include "uv/chart_map.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/disjoint_sets.h"
#include "base/error.h"
#include "image/texel_spans.h"
#include "mesh/edges.h"
#include "mesh/topology.h"

namespace viewcell {
namespace {

TriMesh weld_triangles(const TriMesh& mesh) {
  const std::vector<std::uint32_t> first_at = match_positions(mesh);
  TriMesh out;
  out.triangles = mesh.triangles;
  for (Triangle& t : out.triangles)
    for (std::uint32_t& v : t) v = first_at[v];
  return out;
}

bool has_finite_texcoords(const TriMesh& mesh, std::size_t triangle) {
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::vec2& uv = mesh.texcoords[3 * triangle + k];
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return false;
  }
  return true;
}

// A triangle's side of an edge: the texture coordinates at the edge's lower and higher vertex.
struct Side {
  glm::vec2 lower, higher;
  std::uint32_t triangle;

  auto place() const { return std::tie(lower.x, lower.y, higher.x, higher.y); }
};

Side make_side(const TriMesh& mesh, const TriMesh& welded, std::uint32_t half) {
  const std::uint32_t t = half / 3, k = half % 3, next = (k + 1) % 3;
  const glm::vec2 &a = mesh.texcoords[3 * t + k], &b = mesh.texcoords[3 * t + next];
  const bool is_up = welded.triangles[t][k] < welded.triangles[t][next];
  return is_up ? Side{a, b, t} : Side{b, a, t};
}

}  // namespace

Charts find_charts(const TriMesh& mesh) {
  VIEWCELL_CHECK(mesh.texcoords.size() == 3 * mesh.triangles.size(), mesh.texcoords.size());
  const TriMesh welded = weld_triangles(mesh);
  const EdgeTable edges = build_edge_table(welded);
  DisjointSets sets(mesh.triangles.size());
  std::vector<Side> sides;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    sides.clear();
    for (const std::uint32_t half : edges.halves(e))
      if (has_finite_texcoords(mesh, half / 3)) sides.push_back(make_side(mesh, welded, half));
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.place() < b.place(); });
    for (std::size_t i = 1; i < sides.size(); ++i)
      if (sides[i].place() == sides[i - 1].place())
        sets.join(sides[i].triangle, sides[i - 1].triangle);
  }
  Charts charts;
  charts.of.assign(mesh.triangles.size(), kNoChart);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (edges.edge_of[3 * t] == kNoEdge || !has_finite_texcoords(mesh, t)) continue;
    const std::uint32_t root = sets.find(t);
    if (root == t) {
      charts.of[t] = static_cast<std::uint32_t>(charts.size());
      charts.first.push_back(t);
    } else {
      charts.of[t] = charts.of[root];
    }
  }
  return charts;
}

Image<std::uint32_t> make_chart_map(const TriMesh& mesh, const Charts& charts, int width_px,
                                    int height_px) {
  Image<std::uint32_t> out(width_px, height_px);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (charts.of[t] == kNoChart) continue;
    std::array<glm::dvec2, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = to_texels(mesh.texcoords[3 * t + k], width_px, height_px);
    for_each_span(p, width_px, height_px, [&](int x0, int x1, int y) {
      for (int x = x0; x < x1; ++x) {
        std::uint32_t& owner = out.at(x, y);
        if (owner == 0 || owner > charts.of[t] + 1) owner = charts.of[t] + 1;
      }
    });
  }
  return out;
}

}  // namespace viewcell

#include "mesh/edges.h"

#include <algorithm>
#include <tuple>

#include "base/buckets.h"

namespace viewcell {

EdgeTable build_edge_table(const TriMesh& mesh) {
  struct Row {
    std::uint32_t higher, half;
    bool operator<(const Row& o) const {
      return std::tie(higher, half) < std::tie(o.higher, o.half);
    }
  };
  std::uint32_t n_vertices = 0;
  for (const Triangle& t : mesh.triangles)
    n_vertices = std::max({n_vertices, t[0] + 1, t[1] + 1, t[2] + 1});
  Buckets<Row> rows = fill_buckets<Row>(n_vertices, [&](const auto& emit) {  // by lower vertices
    for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face) {
      const Triangle& t = mesh.triangles[face];
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto [lower, higher] = std::minmax(t[k], t[(k + 1) % 3]);
        emit(lower, Row{higher, 3 * face + k});
      }
    }
  });
  EdgeTable out;
  out.edge_of.assign(3 * mesh.triangles.size(), kNoEdge);
  out.sorted.reserve(out.edge_of.size());
  for (std::uint32_t v = 0; v < n_vertices; ++v) {
    const std::span<Row> own = rows.of(v);
    std::sort(own.begin(), own.end());
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (i == 0 || own[i].higher != own[i - 1].higher)
        out.starts.push_back(static_cast<std::uint32_t>(out.sorted.size()));
      out.edge_of[own[i].half] = static_cast<std::uint32_t>(out.starts.size() - 1);
      out.sorted.push_back(own[i].half);
    }
  }
  out.starts.push_back(static_cast<std::uint32_t>(out.sorted.size()));
  return out;
}

}  // namespace viewcell

#include "mesh/edges.h"

#include <algorithm>
#include <tuple>

namespace viewcell {

EdgeTable build_edge_table(const TriMesh& mesh) {
  struct Row {
    std::uint32_t lower, higher, half;
  };
  std::vector<Row> rows;
  for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face) {
    const Triangle& t = mesh.triangles[face];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto [lower, higher] = std::minmax(t[k], t[(k + 1) % 3]);
      rows.push_back({lower, higher, 3 * face + k});
    }
  }
  std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return std::tie(a.lower, a.higher, a.half) < std::tie(b.lower, b.higher, b.half);
  });
  EdgeTable out;
  out.edge_of.assign(3 * mesh.triangles.size(), kNoEdge);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    if (i == 0 || row.lower != rows[i - 1].lower || row.higher != rows[i - 1].higher)
      out.starts.push_back(static_cast<std::uint32_t>(i));
    out.edge_of[row.half] = static_cast<std::uint32_t>(out.starts.size() - 1);
    out.sorted.push_back(row.half);
  }
  out.starts.push_back(static_cast<std::uint32_t>(rows.size()));
  return out;
}

}  // namespace viewcell

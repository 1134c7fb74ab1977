#include "mesh/subset.h"

#include "base/error.h"

namespace viewcell {

TriMesh keep_triangles(const TriMesh& mesh, const std::vector<bool>& is_kept) {
  VIEWCELL_CHECK(is_kept.size() == mesh.triangles.size(), is_kept.size(), mesh.triangles.size());
  TriMesh out = mesh;
  out.triangles.clear(), out.texcoords.clear(), out.corner_normals.clear(), out.materials.clear();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!is_kept[t]) continue;
    out.triangles.push_back(mesh.triangles[t]);
    if (!mesh.materials.empty()) out.materials.push_back(mesh.materials[t]);
    for (std::size_t c = 3 * t; c < 3 * t + 3; ++c) {
      if (!mesh.texcoords.empty()) out.texcoords.push_back(mesh.texcoords[c]);
      if (!mesh.corner_normals.empty()) out.corner_normals.push_back(mesh.corner_normals[c]);
    }
  }
  return out;
}

}  // namespace viewcell

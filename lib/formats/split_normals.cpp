#include "formats/split_normals.h"

#include <array>
#include <bit>
#include <map>
#include <numeric>

#include "base/error.h"

namespace viewcell {
namespace {

// Equal normals have one: -0 is 0.
std::array<std::uint32_t, 4> normal_key(std::uint32_t vertex, const glm::vec3& normal) {
  const glm::vec3 n = normal + 0.0f;
  return {vertex, std::bit_cast<std::uint32_t>(n.x), std::bit_cast<std::uint32_t>(n.y),
          std::bit_cast<std::uint32_t>(n.z)};
}

}  // namespace

NormalSplit split_by_normals(const TriMesh& mesh, Remarks* remarks) {
  VIEWCELL_CHECK(mesh.corner_normals.size() == 3 * mesh.triangles.size(),
                 mesh.corner_normals.size());
  const std::size_t n = mesh.positions.size();
  NormalSplit out{mesh, std::vector<std::uint32_t>(n)};
  std::iota(out.source.begin(), out.source.end(), 0u);
  out.mesh.corner_normals.clear();
  out.mesh.normals.assign(n, glm::vec3(0));
  std::map<std::array<std::uint32_t, 4>, std::uint32_t> copies;
  for (std::size_t c = 0; c < mesh.corner_normals.size(); ++c) {
    const glm::vec3& normal = mesh.corner_normals[c];
    std::uint32_t& v = out.mesh.triangles[c / 3][c % 3];
    if (out.mesh.normals[v] == glm::vec3(0)) out.mesh.normals[v] = normal;
    if (out.mesh.normals[v] == normal) continue;
    const auto next = static_cast<std::uint32_t>(out.source.size());
    const auto [copy, is_new] = copies.try_emplace(normal_key(v, normal), next);
    if (is_new) {
      out.source.push_back(v);
      out.mesh.positions.push_back(mesh.positions[v]);
      out.mesh.normals.push_back(normal);
      if (!mesh.colors.empty()) out.mesh.colors.push_back(mesh.colors[v]);
    }
    v = copy->second;
  }
  for (glm::vec3& normal : out.mesh.normals)  // of vertices that no triangle uses
    if (normal == glm::vec3(0)) normal = glm::vec3(0, 0, 1);
  add_remark(remarks, "vertices added, where normals of corners differ", out.source.size() - n);
  return out;
}

}  // namespace viewcell

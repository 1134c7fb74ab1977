#include "mesh/tangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtx/exterior_product.hpp>
#include <tuple>

#include "base/error.h"
#include "mesh/split_corners.h"
#include "mesh/topology.h"

// Follows: MikkTSpace [Mikkelsen 2008, Simulation of wrinkled surfaces revisited], which glTF 2.0
// names in 3.7.2.1.
// Differs: MikkTSpace takes only corners together whose triangles are connected around the vertex;
// here two fans that touch in a vertex with the same normal, texture coordinates and side share
// their tangent.

namespace viewcell {
namespace {

// What a triangle's corner adds to a mean.
struct CornerTangent {
  glm::dvec3 sum{0};
  int side = 0;  // w; 0: the triangle has no area in the texture
};

// The direction in which u grows on a triangle, not unit, and the side.
CornerTangent tangent_of_triangle(const TriMesh& mesh, std::size_t t) {
  const Triangle& v = mesh.triangles[t];
  const glm::dvec2 uv(mesh.texcoords[3 * t]);
  const glm::dvec2 a = glm::dvec2(mesh.texcoords[3 * t + 1]) - uv;
  const glm::dvec2 b = glm::dvec2(mesh.texcoords[3 * t + 2]) - uv;
  const glm::dvec3 p(mesh.positions[v[0]]);
  const double area = glm::cross(a, b);
  if (!(std::abs(area) > 0) || !std::isfinite(area)) return {};
  const int side = area > 0 ? 1 : -1;
  const glm::dvec3 along =
      b.y * (glm::dvec3(mesh.positions[v[1]]) - p) - a.y * (glm::dvec3(mesh.positions[v[2]]) - p);
  return {double(side) * along, side};
}

// d in the plane across the unit normal n, unit; or 0.
glm::dvec3 flatten(const glm::dvec3& d, const glm::dvec3& n) {
  const glm::dvec3 flat = d - glm::dot(d, n) * n;
  const double length = glm::length(flat);
  return length > 1e-12 * glm::length(d) ? flat / length : glm::dvec3(0);
}

double angle_at(const TriMesh& mesh, const Triangle& t, std::size_t k, const glm::dvec3& n) {
  const glm::dvec3 p(mesh.positions[t[k]]);
  const glm::dvec3 a = flatten(glm::dvec3(mesh.positions[t[(k + 1) % 3]]) - p, n);
  const glm::dvec3 b = flatten(glm::dvec3(mesh.positions[t[(k + 2) % 3]]) - p, n);
  return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

std::vector<CornerTangent> make_own_tangents(const TriMesh& mesh,
                                             const std::vector<glm::vec3>& normals) {
  std::vector<CornerTangent> out(normals.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const CornerTangent of_triangle = tangent_of_triangle(mesh, t);
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 n(normals[3 * t + k]);
      out[3 * t + k] = {angle_at(mesh, mesh.triangles[t], k, n) * flatten(of_triangle.sum, n),
                        of_triangle.side};
    }
  }
  return out;
}

glm::dvec3 any_across(const glm::dvec3& n) {
  const glm::dvec3 axis = std::abs(n.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(axis - glm::dot(axis, n) * n);
}

// Of corners that look alike but for their side, the means of each side.
struct Means {
  std::array<glm::dvec3, 2> sum{glm::dvec3(0), glm::dvec3(0)};  // of sides 1 and -1

  void add(const CornerTangent& own) {
    if (own.side != 0) sum[own.side < 0] += own.sum;
  }
  glm::vec4 get(int side, const glm::dvec3& n) const {
    if (side == 0) side = sum[0] == glm::dvec3(0) && sum[1] != glm::dvec3(0) ? -1 : 1;
    const glm::dvec3 mean = flatten(sum[side < 0], n);
    return {glm::vec3(mean == glm::dvec3(0) ? any_across(n) : mean), float(side)};
  }
};

}  // namespace

std::vector<glm::vec3> make_corner_normals(const TriMesh& mesh) {
  if (!mesh.corner_normals.empty()) return mesh.corner_normals;
  if (mesh.normals.empty()) return compute_corner_normals(mesh);
  std::vector<glm::vec3> out;
  out.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) out.push_back(mesh.normals[v]);
  return out;
}

std::vector<glm::vec4> make_corner_tangents(const TriMesh& mesh,
                                            const std::vector<glm::vec3>& corner_normals) {
  const std::size_t n = 3 * mesh.triangles.size();
  VIEWCELL_CHECK(mesh.texcoords.size() == n && corner_normals.size() == n, mesh.texcoords.size(),
                 corner_normals.size());
  const std::vector<std::uint32_t> first_at = match_positions(mesh);
  const std::vector<CornerTangent> own = make_own_tangents(mesh, corner_normals);
  const auto look = [&](std::size_t c) {
    const glm::vec3& m = corner_normals[c];
    const glm::vec2& uv = mesh.texcoords[c];
    return std::tuple(first_at[mesh.triangles[c / 3][c % 3]], m.x, m.y, m.z, uv.x, uv.y);
  };
  std::vector<std::uint32_t> order;
  for (std::uint32_t c = 0; c < n; ++c) order.push_back(c);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return look(a) < look(b); });
  std::vector<glm::vec4> out(n);
  for (std::size_t begin = 0, end = 0; begin < n; begin = end) {
    Means means;
    for (; end < n && look(order[end]) == look(order[begin]); ++end) means.add(own[order[end]]);
    end = std::max(end, begin + 1);  // a number that is none equals nothing
    for (std::size_t i = begin; i < end; ++i)
      out[order[i]] = means.get(own[order[i]].side, glm::dvec3(corner_normals[order[i]]));
  }
  return out;
}

}  // namespace viewcell

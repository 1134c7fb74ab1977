// A triangle mesh as plain arrays.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace viewcell {

/// Three vertex indices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// Axis-aligned box; empty when lo > hi.
struct Box {
  glm::dvec3 lo{1e300};
  glm::dvec3 hi{-1e300};
  void add(const glm::dvec3& p) { lo = glm::min(lo, p), hi = glm::max(hi, p); }
  glm::dvec3 size() const { return hi - lo; }
  glm::dvec3 centre() const { return 0.5 * (lo + hi); }
};

/// Vertex attributes stand in arrays of positions' length, or are empty.
/// Corner attributes (texture coordinates) stand in arrays of 3 x triangles, or are empty.
/// Normals stand in one of two arrays, or in none: in corner_normals where some vertex has several.
struct TriMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;         ///< unit, per vertex
  std::vector<glm::vec3> corner_normals;  ///< unit, per corner
  std::vector<glm::vec3> colors;          ///< linear, [0, 1], per vertex
  std::vector<Triangle> triangles;
  std::vector<glm::vec2> texcoords;     ///< per corner
  std::vector<std::int32_t> materials;  ///< per triangle: index into material_names; or empty
  std::vector<std::string> material_names;
  std::vector<std::string> material_libraries;  ///< as an OBJ's lines "mtllib" name them; not read
  /// A vertex is at offset + position. Not zero where floats are too coarse for the coordinates
  /// themselves: those of maps, far from the origin.
  glm::dvec3 offset{0};
};

Box bounding_box(const TriMesh& mesh);

/// Unit normals per vertex, weighted by the angle of each triangle at the vertex (Thuermer and
/// Wuethrich 1998). A vertex with no triangle of positive area gets (0, 0, 1).
std::vector<glm::vec3> make_vertex_normals(const TriMesh& mesh);

/// Non-unit normal, twice the triangle's area long.
inline glm::dvec3 area_normal(const TriMesh& mesh, const Triangle& t) {
  const glm::dvec3 a(mesh.positions[t[0]]);
  return glm::cross(glm::dvec3(mesh.positions[t[1]]) - a, glm::dvec3(mesh.positions[t[2]]) - a);
}

}  // namespace viewcell

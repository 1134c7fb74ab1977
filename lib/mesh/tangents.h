// The frames that tangent-space normal maps are relative to.
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

/// Per corner the normal of its vertex: the mesh's, or make_vertex_normals where it has none.
std::vector<glm::vec3> make_corner_normals(const TriMesh& mesh);

/// Per corner (xyz, w), as glTF 2.0 has its TANGENT (3.7.2.1): xyz is unit, perpendicular to the
/// corner's normal, and points where u grows; w is 1 or -1, and w * cross(normal, xyz) is where v
/// grows. w is -1 where the texture lies mirrored.
///
/// corner_normals: unit, three a triangle. A corner's tangent is the mean, by angle, over all
/// corners that stand at one position with the same normal, texture coordinates and w, of their
/// triangles' directions of u: so it ends where charts meet and where a chart meets its mirror
/// image. Triangles without area in the texture take part in no mean, and take the tangent of such
/// corners; where there are none, one across the normal, and w = 1. The mesh must have texture
/// coordinates. O(n log n).
std::vector<glm::vec4> make_corner_tangents(const TriMesh& mesh,
                                            const std::vector<glm::vec3>& corner_normals);

/// A frame between corners. Its columns (tangent, bitangent, normal) are interpolated and, as
/// MikkTSpace has it, not made unit again; the bitangent is w * cross(normal, tangent).
/// A normal map's (x, y, z) means the direction of frame * (x, y, z).
inline glm::dmat3 mix_tangent_frame(const glm::vec3* normals, const glm::vec4* tangents,
                                    const glm::dvec3& weights) {
  glm::dvec3 normal(0), tangent(0);
  for (int k = 0; k < 3; ++k) {
    normal += weights[k] * glm::dvec3(normals[k]);
    tangent += weights[k] * glm::dvec3(tangents[k]);
  }
  return {tangent, double(tangents[0].w) * glm::cross(normal, tangent), normal};
}

}  // namespace viewcell

// Texture coordinates distorted on purpose, still one to one: the bad parameterisations of tests.
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace viewcell {

enum class UvDistortion {
  swirl,  ///< turns about (0.5, 0.5) by `strength` turns there, less outwards, none from radius 0.5
  stretch,  ///< u runs exponentially: e^strength times as fast at the right as at the left
};

/// Where a point of [kUvMargin, 1 - kUvMargin]^2 goes; into the same square. Strength 0 is the
/// identity. The rim of the swirl is the circle inscribed in that square.
glm::dvec2 distort_point(const glm::dvec2& p, UvDistortion distortion, double strength);

struct DistortedUv {
  std::vector<glm::dvec2> uv;  ///< per vertex
  double strength = 0;         ///< used: the one asked for, or less
};

/// Distorts per-vertex coordinates in that square. The map is one to one on points, but not
/// what is linear on triangles between them: if in single precision a triangle turns over or keeps
/// less than 1/100 of its share of the plane, strength is lowered by bisection until none does. The
/// triangles must be counter-clockwise to begin with, else BugError. O(40 triangles).
DistortedUv distort_uv(const TriMesh& mesh, const std::vector<glm::dvec2>& uv,
                       UvDistortion distortion, double strength);

}  // namespace viewcell

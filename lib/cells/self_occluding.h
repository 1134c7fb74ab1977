// The self-occluding error, which decides between one view and several.
#pragma once

#include <span>

#include "mesh/mesh.h"

namespace viewcell {

/// s = sqrt(3) c l / (2 d (d + l)) * image_res, in pixels [Chen06 5.2.1]: the widest hole that an
/// eye anywhere in the cell may see in what the cell's centre sees of an object. c: the cell's
/// size; d > 0: from the centre to the object's nearest point; l: the object's depth along that
/// ray, of its polygons that are front-facing to the cell. Infinite for d <= 0.
/// Known limits: the eye's advance, obliquity and height are not in it.
double self_occluding_error_px(double c, double d, double l, double image_res);

/// d and l of an object seen from an eye.
struct ObjectDepth {
  double nearest = 0;  ///< d: to the nearest point of a triangle that is not back-facing
  double depth = 0;    ///< l: from there to the farthest such point, along the ray to the middle
};

/// Over the triangles that are not marked back-facing. All in one space.
ObjectDepth measure_depth(const glm::dvec3& eye, std::span<const glm::vec3> positions,
                          std::span<const Triangle> triangles,
                          const std::vector<bool>& is_back_facing);

/// Pixels per unit tangent when a side face, 60 degrees wide from the cell's centre, is that wide.
double focal_of_face(int resolution_px);

}  // namespace viewcell

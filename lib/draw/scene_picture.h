// Pictures of a scene before anything is baked: from above, from a corner, from an eye.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "image/image.h"
#include "mesh/mesh.h"
#include "scene/camera.h"

namespace viewcell {

/// Looks at the box from its corner (-x, -y), 35 degrees above the ground, from as near as shows
/// all of it in a frame of that shape.
Camera look_from_corner(const Box& box, double fov_y_deg, double aspect);

/// As a map: x right, y up, all of the box in a frame of that shape, with a margin; what is higher
/// covers what is lower.
glm::dmat4 clip_from_above(const Box& box, double aspect);

/// Draws lines over a picture, width_px wide, through what is in front of them too: points are
/// joined in their order, and the last with the first where the line is closed.
void draw_over(ImageRgba8& image, const glm::dmat4& clip_from_world,
               std::span<const glm::dvec3> points, bool is_closed, const Rgba8& color,
               double width_px);

}  // namespace viewcell

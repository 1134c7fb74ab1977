// A square, and the view that it faces.
#pragma once

#include <cmath>

#include "draw/mesh_renderer.h"

namespace viewcell {

/// The square from (-1, -1) to (1, 1) in the plane y = 0, which faces the front: image x is x,
/// image y is -z. Its texture coordinates: place(uv) of (0, 0) at the lower left corner, (1, 1) at
/// the upper right one.
template <typename Place>
TriMesh make_front_square(const Place& place) {
  TriMesh mesh;
  mesh.positions = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const glm::vec2 uv[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) mesh.texcoords.push_back(place(uv[v]));
  return mesh;
}

/// Looks at the middle of the frame from the front, level.
inline Camera front_view() {
  Camera camera = make_views(1)[0];
  camera.eye = {0, -glm::length(camera.eye), 0};
  camera.forward = {0, 1, 0};
  return camera;
}

/// The pixel of a picture from there that shows (x, z) of the square.
inline Rgba8 at_square(const ImageRgba8& image, double x, double z) {
  const double radius = std::sqrt(2.0);  // of the frame
  const glm::dvec4 clip = clip_from_world(front_view()) * glm::dvec4(x / radius, 0, z / radius, 1);
  return image.at(static_cast<int>((0.5 + 0.5 * clip.x / clip.w) * image.width_px),
                  static_cast<int>((0.5 - 0.5 * clip.y / clip.w) * image.height_px));
}

/// One sample a pixel.
inline MeshStyle plain_style(int size_px) {
  MeshStyle style;
  style.size_px = size_px;
  style.samples = 1;
  return style;
}

}  // namespace viewcell

#include "uv/triangle_map.h"

#include <algorithm>
#include <cmath>

#include "mesh/closest_point.h"

namespace viewcell {
namespace {

struct TexelBox {
  int x0, y0, x1, y1;  // ends excluded
};

// Texels of the image within the rim of a triangle; empty when it is not finite.
TexelBox rim_box(const Corners2& p, int width_px, int height_px) {
  const glm::dvec2 lo = glm::min(glm::min(p[0], p[1]), p[2]) - kRimTexels;
  const glm::dvec2 hi = glm::max(glm::max(p[0], p[1]), p[2]) + kRimTexels;
  if (!std::isfinite(lo.x + lo.y + hi.x + hi.y)) return {0, 0, 0, 0};
  const auto clamp = [](double x, int size) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(size)));
  };
  return {clamp(std::ceil(lo.x), width_px), clamp(std::ceil(lo.y), height_px),
          clamp(std::floor(hi.x) + 1, width_px), clamp(std::floor(hi.y) + 1, height_px)};
}

}  // namespace

Corners2 texels_of(const TriMesh& mesh, std::size_t t, int width_px, int height_px) {
  Corners2 out;
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = to_texels(mesh.texcoords[3 * t + k], width_px, height_px);
  return out;
}

glm::dvec3 nearest_weights(const Corners2& at, const glm::dvec2& p) {
  const glm::dvec3 a(at[0], 0), b(at[1], 0), c(at[2], 0);
  return corner_weights(closest_point_on_triangle(glm::dvec3(p, 0), a, b, c), a, b, c);
}

void draw_insides(const TriMesh& mesh, TriangleMap& map) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    claim_texels(texels_of(mesh, t, map.width_px, map.height_px), t + 1, map);
}

void draw_rims(const TriMesh& mesh, TriangleMap& map) {
  constexpr float kFar = 1e30f;
  Image<float> distances(map.width_px, map.height_px, kFar);  // squared
  for (std::size_t i = 0; i < map.pixels.size(); ++i)
    if (map.pixels[i] != 0) distances.pixels[i] = -1;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Corners2 p = texels_of(mesh, t, map.width_px, map.height_px);
    const TexelBox box = rim_box(p, map.width_px, map.height_px);
    for (int y = box.y0; y < box.y1; ++y)
      for (int x = box.x0; x < box.x1; ++x) {
        float& best = distances.at(x, y);
        if (best < 0) continue;
        const glm::dvec2 off = mix(p, nearest_weights(p, {x, y})) - glm::dvec2(x, y);
        const auto squared = static_cast<float>(glm::dot(off, off));
        if (squared > kRimTexels * kRimTexels || squared >= best) continue;
        best = squared;
        map.at(x, y) = static_cast<std::uint32_t>(t + 1);
      }
  }
}

}  // namespace viewcell

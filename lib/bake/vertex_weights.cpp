#include "bake/vertex_weights.h"

#include <algorithm>
#include <cmath>

namespace viewcell {
namespace {

// The gentler of the two one-sided slopes of 1/depth along a row or column: at a jump the side that
// stays on the surface.
float slope_along(const CaptureTile& tile, int x, int y, int dx, int dy) {
  const float here = tile.inverse_depth.at(x, y);
  float least = 1e30f;
  for (const int side : {-1, 1}) {
    const int i = x + side * dx, j = y + side * dy;
    if (i < 0 || j < 0 || i >= tile.crop.width_px || j >= tile.crop.height_px) continue;
    if (tile.is_seen(i, j)) least = std::min(least, std::abs(tile.inverse_depth.at(i, j) - here));
  }
  return least < 1e30f ? least : 0.0f;
}

// Whether a point at image position `at` (relative to the crop) with that 1/depth lies on, or in
// front of, the surface that pixel (x, y) shows.
bool agrees(const ClassifiedView& view, int x, int y, const glm::dvec2& at, double inverse_depth) {
  const CaptureTile& tile = view.tile;
  // Two pixels' footprint in depth: smaller surface detail is not resolved.
  const double detail = 2 * inverse_depth / tile.view.focal_px;
  const double slope = slope_along(tile, x, y, 1, 0) * std::abs(at.x - x - 0.5) +
                       slope_along(tile, x, y, 0, 1) * std::abs(at.y - y - 0.5);
  return inverse_depth >= static_cast<double>(tile.inverse_depth.at(x, y)) - detail - slope;
}

double weight_of(PixelCategory category, const WeightOptions& options) {
  switch (category) {
    case PixelCategory::exterior_silhouette:
      return options.exterior_silhouette;
    case PixelCategory::interior_silhouette:
      return options.interior_silhouette;
    case PixelCategory::sharp_edge:
      return options.sharp_edge;
    case PixelCategory::interior:
      return options.interior;
    case PixelCategory::background:
      break;
  }
  return options.invisible;
}

// For each vertex, whether some triangle of its shows the eye a side.
std::vector<bool> find_front_vertices(std::span<const Triangle> triangles, const FaceSides& sides,
                                      const std::vector<glm::vec3>& positions,
                                      const glm::dvec3& eye) {
  std::vector<bool> front(positions.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    const glm::dvec3 a(positions[t[0]]);
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(positions[t[1]]) - a, glm::dvec3(positions[t[2]]) - a);
    const double away = glm::dot(normal, a - eye);
    if (away < 0 || (away > 0 && sides.shows_back(i)))
      for (const std::uint32_t v : t) front[v] = true;
  }
  return front;
}

}  // namespace

PixelCategory category_at(const ClassifiedView& view, const glm::dvec3& world) {
  const CaptureTile& tile = view.tile;
  const glm::dvec3 projected = tile.view.project(world);
  if (!(projected.z > 0)) return PixelCategory::background;
  const glm::dvec2 at(projected.x - tile.crop.x, projected.y - tile.crop.y);
  const int x0 = static_cast<int>(std::floor(at.x)), y0 = static_cast<int>(std::floor(at.y));
  const auto test = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= tile.crop.width_px || y >= tile.crop.height_px) return false;
    return tile.is_seen(x, y) && agrees(view, x, y, at, 1 / projected.z);
  };
  if (test(x0, y0)) return view.categories.at(x0, y0);
  PixelCategory most = PixelCategory::background;
  for (int y = y0 - 1; y <= y0 + 1; ++y)
    for (int x = x0 - 1; x <= x0 + 1; ++x)
      if (test(x, y)) most = std::max(most, view.categories.at(x, y));
  return most;
}

void weigh_vertices(std::span<const Triangle> triangles, const FaceSides& sides,
                    std::span<const ClassifiedView> views, const WeightOptions& options,
                    ViewVertices& vertices) {
  const std::size_t n = vertices.positions.size();
  std::vector<bool> is_front(n);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (!sides.is_back_facing[t])
      for (const std::uint32_t v : triangles[t]) is_front[v] = true;
  vertices.views.assign(n, 0);
  vertices.weights.resize(n);
  for (std::size_t v = 0; v < n; ++v)
    vertices.weights[v] = static_cast<float>(is_front[v] ? options.invisible : options.back_facing);
  for (const ClassifiedView& view : views) {
    const auto faces_view =
        find_front_vertices(triangles, sides, vertices.positions, view.tile.view.eye);
    for (std::size_t v = 0; v < n; ++v) {
      if (!is_front[v] || !faces_view[v]) continue;
      const PixelCategory category = category_at(view, glm::dvec3(vertices.positions[v]));
      if (category == PixelCategory::background) continue;
      vertices.views[v] |= static_cast<std::uint8_t>(1u << view.view);
      vertices.weights[v] =
          std::max(vertices.weights[v], static_cast<float>(weight_of(category, options)));
    }
  }
}

}  // namespace viewcell

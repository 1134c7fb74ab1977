#include "capture/capture_centre.h"

#include <algorithm>

#include "base/parallel.h"
#include "capture/captures.h"
#include "image/fill.h"

namespace viewcell {

std::vector<std::vector<glm::dvec3>> object_points_world(const Scene& scene) {
  std::vector<std::vector<glm::dvec3>> points;
  for (const SceneObject& object : scene.objects) {
    std::vector<glm::dvec3>& placed = points.emplace_back();
    for (const glm::vec3& p : scene.mesh_of(object).mesh.positions)
      placed.push_back(object.world_from_model(glm::dvec3(p)));
  }
  return points;
}

CentreTiles capture_centre(const CellSet& cells, CentreId centre,
                           const std::vector<std::vector<glm::dvec3>>& points,
                           const CaptureDensity& density, const CaptureEngine& engine) {
  CentreTiles out;
  for (const ObjectId object : objects_seen_from(cells, centre)) {
    const auto viewed = choose_view(eye_of(cells, centre), points[index(object)], density);
    if (!viewed) {
      ++out.n_left_out;
      continue;
    }
    CaptureTile tile = engine(object, viewed->view, viewed->crop);
    push_pull_fill(tile.color, tile.inverse_depth);
    out.tiles.push_back(std::move(tile));
  }
  return out;
}

std::size_t count_pixels(const CellSet& cells, CentreId centre,
                         const std::vector<std::vector<glm::dvec3>>& points,
                         const CaptureDensity& density) {
  std::size_t n = 0;
  for (const ObjectId object : objects_seen_from(cells, centre))
    if (const auto viewed = choose_view(eye_of(cells, centre), points[index(object)], density))
      n += static_cast<std::size_t>(viewed->crop.width_px) *
           static_cast<std::size_t>(viewed->crop.height_px);
  return n;
}

LargestCell find_largest_cell(const CellSet& cells, const std::vector<CellId>& list,
                              const std::vector<std::vector<glm::dvec3>>& points,
                              const CaptureDensity& density, int n_threads) {
  const std::vector<CentreId> centres = centres_of(cells, list);
  std::vector<std::size_t> n_pixels(centres.size());
  parallel_for(centres.size(), n_threads, [&](std::size_t i) {
    n_pixels[i] = count_pixels(cells, centres[i], points, density);
  });
  LargestCell out;
  for (const CellId cell : list) {
    std::size_t n = 0;
    for (const CentreId centre : views_of(cells.grid, cell))
      n += n_pixels[static_cast<std::size_t>(
          std::lower_bound(centres.begin(), centres.end(), centre) - centres.begin())];
    if (n > out.n_pixels) out = {cell, n};
  }
  return out;
}

}  // namespace viewcell

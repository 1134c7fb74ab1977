#include "capture/capture_centre.h"

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

}  // namespace viewcell

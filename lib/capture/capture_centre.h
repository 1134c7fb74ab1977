// All that one centre captures, by either engine.
#pragma once

#include <functional>
#include <vector>

#include "capture/tile.h"
#include "cells/cells.h"

namespace viewcell {

/// Casts or draws one object in one view: RayCapture::capture or RasterCapture::capture.
using CaptureEngine = std::function<CaptureTile(ObjectId, const CaptureView&, const Crop&)>;

/// Every object's vertices in the world, by object: 24 bytes a vertex and object.
std::vector<std::vector<glm::dvec3>> object_points_world(const Scene& scene);

struct CentreTiles {
  std::vector<CaptureTile> tiles;  ///< filled beyond the objects, ascending by object
  std::size_t n_left_out = 0;      ///< objects that the eye is inside of or too close to
};

/// points: of object_points_world.
CentreTiles capture_centre(const CellSet& cells, CentreId centre,
                           const std::vector<std::vector<glm::dvec3>>& points,
                           const CaptureDensity& density, const CaptureEngine& engine);

/// The pixels of those tiles, without casting a ray.
std::size_t count_pixels(const CellSet& cells, CentreId centre,
                         const std::vector<std::vector<glm::dvec3>>& points,
                         const CaptureDensity& density);

/// Of the cells the one whose seven centres have the most pixels, all together: an upper bound of
/// the texels that a player must hold to be in it, as an SVMesh needs its own centre's alone.
struct LargestCell {
  CellId cell{};
  std::size_t n_pixels = 0;
};
LargestCell find_largest_cell(const CellSet& cells, const std::vector<CellId>& list,
                              const std::vector<std::vector<glm::dvec3>>& points,
                              const CaptureDensity& density, int n_threads);

}  // namespace viewcell

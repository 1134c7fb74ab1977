// Weights and views of vertices from captured depth images.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "bake/view_metric.h"
#include "capture/categories.h"

namespace viewcell {

/// [Chen06 5.2.1]
struct WeightOptions {
  double exterior_silhouette = 0.5;
  double interior_silhouette = 0.4;
  double sharp_edge = 0.25;
  double interior = 0.125;
  double invisible = 0.05;
  double back_facing = 0.5;
};

/// A capture of the object with its categories; bit `view` of a view mask.
struct ClassifiedView {
  int view = 0;
  CaptureTile tile;
  Image<PixelCategory> categories;
};

/// The category of the pixel that shows the point, or background when the point is hidden there.
/// A point is shown when in the 3 x 3 pixels around its projection one has a depth that the point
/// agrees with, allowing for that pixel's slope; the pixel that it falls on comes first. By
/// that one alone vertices of silhouettes would land on the background.
PixelCategory category_at(const ClassifiedView& view, const glm::dvec3& world);

/// By triangle: from where its sides are seen.
struct FaceSides {
  std::vector<bool> is_back_facing;  ///< to the whole cell
  std::vector<bool> is_two_sided;    ///< its back is drawn too; or empty: none's is

  bool shows_back(std::size_t triangle) const {
    return !is_two_sided.empty() && is_two_sided[triangle];
  }
};

/// Fills vertices.weights and vertices.views from positions. A vertex all of whose triangles are
/// marked back-facing is back-facing; of the others each takes the largest of its weights over the
/// views, and the bits of the views that show it, facing them.
void weigh_vertices(std::span<const Triangle> triangles, const FaceSides& sides,
                    std::span<const ClassifiedView> views, const WeightOptions& options,
                    ViewVertices& vertices);

}  // namespace viewcell

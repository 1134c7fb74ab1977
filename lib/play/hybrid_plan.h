// What a hybrid frame draws of a cell, as a pure function of cell and camera.
#pragma once

#include <array>
#include <vector>

#include "draw/frame_plan.h"
#include "play/ready_cell.h"

namespace viewcell {

/// The views that an object of a cell may be textured from: bit k, of the cell's seven centres.
using ViewsAvailable = std::vector<std::uint8_t>;  // by slot

/// The two best views of an object.
struct ViewChoice {
  std::array<int, 2> view{-1, -1};    ///< 0..6; -1: none
  std::array<float, 2> weight{1, 0};  ///< they sum to 1; the second may be 0
};

/// By the angles at the object's middle between the eye and each available view [Chen06 5.2.2]:
/// weight 1 / angle - 1 / third angle, so that a view's weight vanishes before the choice changes
/// and nothing pops. Differs: the weights' contrast is raised by half, so that the second
/// view fades out altogether where the first is far better, and most draws fetch from one view.
ViewChoice choose_views(const glm::dvec3& eye, const glm::dvec3& middle,
                        const std::array<glm::dvec3, kViews>& centres, unsigned available);

struct HybridDraw {
  std::uint16_t slot = 0;
  ViewChoice views;
};

struct HybridPlan {
  std::vector<ObjectId> originals;  ///< drawn as they are, front to back
  std::vector<HybridDraw> outside;  ///< front to back
  /// Places in ReadyCell::unseen, front to back; drawn behind all, by one draw.
  std::vector<std::uint16_t> unseen;
  std::size_t n_triangles = 0;  ///< of the outside objects and the unseen ones
};

/// The side faces that a camera inside the cell may look through: bit k (window culling [Chen06
/// 5.2.2]). All six when it looks so far up or down that the horizon leaves the frame.
std::uint8_t find_visible_windows(const HexGrid& grid, CellId cell, const Camera& camera);

/// Window culling, then frustum culling, of a cell's outside objects; of originals by frustum.
HybridPlan plan_hybrid(const PlanScene& scene, const CellSet& cells, const ReadyCell& cell,
                       const ViewsAvailable& views, const Camera& camera);

}  // namespace viewcell

// The camera's walk through a park.
#pragma once

#include <array>

#include "park/scatter.h"
#include "scene/camera.h"

namespace viewcell {

/// What a walk shows, measured on its samples; arrays by ParkSize.
struct WalkReport {
  double length = 0;
  double duration_s = 0;
  int n_cells = 0;  ///< distinct view cells of size 50 that the eye passes through
  std::array<double, kParkSizes> coverage{};  ///< estimated share of the frames that objects cover
  std::array<double, kParkSizes> share_inside{};  ///< of samples whose cell meets some footprint
  /// Longest time for which a dragon or bunny of the 2M park is in the eye's cell and in view.
  double large_in_view_s = 0;
  /// Mean triangles of objects in the eye's cell that are in view.
  std::array<double, kParkSizes> triangles_inside{};
  double min_clearance = 0;  ///< from the eye to the nearest footprint of the 8M park, up to 50
};

struct Walk {
  CameraPath path;
  WalkReport report;
};

/// Two walks: one through the park and a short piece of it.
struct Walks {
  Walk whole;
  Walk brief;
};

/// A walk of 70 s at 28 units/s, turning by at most 40 degrees a second, 16 to 20 units above the
/// ground; the same for the three sizes of park. Of many random ones that pass close to statues,
/// one that is certain to show enough of them: estimated coverage at least 6 % in the 2M park and
/// 15 % in the 8M, a dragon or bunny of the 2M park in view from within a shared cell, at least 12
/// cells, an eighth of the samples in cells with objects. The brief piece crosses 12 to 14 cells.
/// objects: of the 8M park. Throws BugError when no walk is found.
Walks make_walks(const std::vector<SceneMesh>& meshes, const std::vector<SceneObject>& objects,
                 std::uint64_t seed, int n_threads = 0);

}  // namespace viewcell

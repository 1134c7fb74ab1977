// The modes of play: all that differs between them, in one table. A new mode is a new row
// there and a new value here.
#pragma once

#include <span>
#include <string>

#include "draw/frame_plan.h"

namespace viewcell {

/// Numbers of the table's rows.
enum class Mode {
  geometry,
  frustum,
  lod,
  hybrid,
  raycast,
  lod_equal,
  geometry_two_sided,
  frustum_two_sided
};

enum class ModeEngine {
  objects,  ///< the scene's objects, originals or levels, by GL, as a plan says
  hybrid,   ///< the cell's meshes outside, originals inside, by GL
  rays,     ///< the scene's objects, a ray a pixel
};

/// What a plan may depend on.
struct PlanInputs {
  const PlanScene& scene;
  const Camera& camera;
  int height_px = 0;
  std::size_t n_hybrid_triangles = 0;  ///< that hybrid draws of the camera, where the mode asks
};

struct ModeRow {
  Mode mode{};
  const char* name = "";  ///< as typed, in reports, and of the folder of its frames
  ModeEngine engine = ModeEngine::objects;
  const char* color = "#000000";                   ///< of its line in plots
  FramePlan (*plan)(const PlanInputs&) = nullptr;  ///< of engine objects
  bool draws_levels = false;                       ///< they must have been built
  /// Planned from the hybrid's triangles, and that before the clock starts: a user would choose an
  /// error, not a count.
  bool asks_hybrid = false;
  bool culls_back_faces = true;  ///< by GL; the rays' engine always passes them
  bool is_dashed = false;        ///< in plots
  bool is_variant = false;       ///< listed after the modes proper
};

/// In the order of Mode.
std::span<const ModeRow> mode_rows();
const ModeRow& row_of(Mode mode);
inline const char* mode_name(Mode mode) {
  return row_of(mode).name;
}
/// By name; throws UsageError, which lists the names, for another one.
Mode parse_mode(const std::string& name);
/// "geometry,frustum, ... , lod-equal, ...": a blank stands before the variants.
std::string list_modes();

}  // namespace viewcell

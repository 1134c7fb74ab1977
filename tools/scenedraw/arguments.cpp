#include "scenedraw/arguments.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "common/mesh_input.h"
#include "common/picture_input.h"

namespace viewcell {
namespace {

glm::dvec3 parse_place(const char* option, const std::string& text) {
  glm::dvec3 p(0);
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &p.x, &p.y, &p.z, &rest) != 3 ||
      !(glm::length(p) < 1e8))
    throw UsageError(std::string(option) + ": '" + text + "' is not X,Y,Z");
  return p;
}

// To a hundred thousandth of the path.
Camera camera_at(const CameraPath& path, double time_s) {
  const double last = path.samples.back().time_s, first = path.samples.front().time_s;
  const double share = last > first ? std::clamp((time_s - first) / (last - first), 0.0, 1.0) : 0;
  constexpr std::size_t kSteps = 100000;
  const auto step = static_cast<std::size_t>(std::lround(share * (kSteps - 1)));
  return sample_path(path, kSteps).at(step);
}

}  // namespace

void declare_arguments(Tool& tool, ScenedrawArguments& o) {
  tool.add_option("scene", &o.scene_file, "scene.json").required().reads("the scene that is read");
  tool.add_option("--from", &o.from,
                  "corner: all of it, from a corner; above: as a map; eye: as --eye or --path say")
      .show_default()
      .check(one_of({"corner", "above", "eye"}));
  tool.add_option("--eye", &o.eye, "X,Y,Z: where the eye is").excludes("--at");
  tool.add_option("--toward", &o.toward, "X,Y,Z: what it looks at").needs("--eye");
  tool.add_option("--path", &o.path_file, "path.json: drawn, or walked by the eye")
      .reads("the path that is read");
  tool.add_option("--at", &o.at_s, "seconds along --path at which the eye is")
      .needs("--path")
      .check(within(-1e9, 1e9));
  tool.add_option("--cells", &o.cells_file, "cells.json: their outlines are drawn")
      .reads("the file of cells that is read");
  tool.add_option("--size", &o.size, "WIDTHxHEIGHT in px").show_default();
  tool.add_option("--fov", &o.fov_y_deg,
                  "vertical field of view in degrees (default: the path's, or 60)")
      .check(within(kLeastFovYDeg, kMostFovYDeg));
  tool.add_option("--gl", &o.gl, "osmesa | egl").show_default();
  declare_max_pixels(tool, &o.max_pixels);
  tool.add_mesh_limit(tool);
  tool.add_output("picture to write, as PNG (-: stdout)");
}

void finish_arguments(ScenedrawArguments& o) {
  char rest = 0;
  if (std::sscanf(o.size.c_str(), "%dx%d%c", &o.width_px, &o.height_px, &rest) != 2 ||
      std::min(o.width_px, o.height_px) < 16 || std::max(o.width_px, o.height_px) > 8192)
    throw UsageError("--size: '" + o.size + "' is not WIDTHxHEIGHT within 16 to 8192");
}

Camera choose_eye(const ScenedrawArguments& o, const std::optional<CameraPath>& path) {
  if (o.eye.empty()) {
    if (!path) throw UsageError("--from eye: say --eye X,Y,Z and --toward X,Y,Z, or --path");
    return camera_at(*path, o.at_s);
  }
  if (o.toward.empty()) throw UsageError("--eye: say --toward X,Y,Z, too");
  Camera camera;
  camera.eye = parse_place("--eye", o.eye);
  const glm::dvec3 along = parse_place("--toward", o.toward) - camera.eye;
  if (!(glm::length(glm::dvec2(along)) > 1e-9 * glm::length(along)))
    throw UsageError("--toward: is straight above, below or at --eye");
  camera.forward = glm::normalize(along);
  return camera;
}

}  // namespace viewcell

// Cameras and camera paths (docs/formats.md, path.json).
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "base/json.h"

namespace viewcell {

/// The vertical field of view of frames, where nothing else is said, and what others may be. The
/// paper's are square [Chen06 5.3].
inline constexpr double kFovYDeg = 60, kLeastFovYDeg = 5, kMostFovYDeg = 120;
/// Distance of the near plane, in the park's units.
inline constexpr double kNear = 1;

/// A camera with the world's z up.
struct Camera {
  glm::dvec3 eye{0};
  glm::dvec3 forward{1, 0, 0};  ///< unit, not vertical
  double fov_y_deg = kFovYDeg;
  double aspect = 1;  ///< width / height
  double near = kNear;
};

/// Its frames with that field of view and shape. The near plane comes so near that its corner is no
/// farther from the eye than in a square frame of kFovYDeg, for which cells were widened.
Camera with_frame(Camera camera, double fov_y_deg, double aspect);

/// What is right and up in a picture taken along forward, which is unit and not vertical: right is
/// level, up is nearest to z.
struct PictureAxes {
  glm::dvec3 right, up;
};
inline PictureAxes picture_axes(const glm::dvec3& forward) {
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 0, 1)));
  return {right, glm::cross(right, forward)};
}

/// Rows: right, up, -forward (OpenGL's eye space: x right, y up, looking along -z).
glm::dmat4 view_from_world(const Camera& camera);
/// Reversed, infinite depth in [0, 1]: clip z = near, clip w = distance along forward. Needs
/// glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE) and a GL_GREATER depth test with clear 0.
glm::dmat4 clip_from_view(const Camera& camera);
inline glm::dmat4 clip_from_world(const Camera& camera) {
  return clip_from_view(camera) * view_from_world(camera);
}

/// Whether the axes of a view are unit vectors, at right angles, and right x up = -forward; up to
/// rounding. False for what is not finite.
bool is_view_frame(const glm::dvec3& right, const glm::dvec3& up, const glm::dvec3& forward);

struct PathSample {
  double time_s = 0;
  glm::dvec3 eye{0};
  glm::dvec3 forward{1, 0, 0};
};

/// Samples in order of time; the camera moves linearly between them.
struct CameraPath {
  std::vector<PathSample> samples;
  double fov_y_deg = kFovYDeg;
};

/// remarks: what was passed over, if wanted.
CameraPath read_path(const std::filesystem::path& file, Remarks* remarks = nullptr);
Json format_path(const CameraPath& path, const Json& provenance);

/// n cameras at equal steps of time over the whole path, both ends included (n = 1: the start).
/// Eyes are interpolated linearly, directions along the arc between them.
std::vector<Camera> sample_path(const CameraPath& path, std::size_t n);

}  // namespace viewcell

#include "draw/mesh_views.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <glm/gtc/constants.hpp>

#include "base/error.h"
#include "scene/scene.h"

namespace viewcell {
namespace {

constexpr double kNearPlane = 0.01;  // radii; reversed float depth is as precise for any
constexpr double kFirstElevationDeg = 20;
constexpr double kFirstAzimuthDeg = 35;
constexpr double kFrontAzimuthDeg = -90;  // of the axis -y

// Columns: the images of the mesh's axes.
glm::dmat3 turn_of(const MeshFrame& frame) {
  return {glm::dvec3(turn_up_axis(frame.up, {1, 0, 0})),
          glm::dvec3(turn_up_axis(frame.up, {0, 1, 0})),
          glm::dvec3(turn_up_axis(frame.up, {0, 0, 1}))};
}

glm::dvec3 direction_of(double z, double azimuth_rad) {
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(azimuth_rad), r * std::sin(azimuth_rad), z};
}

Camera make_view(const glm::dvec3& direction) {
  Camera camera;
  camera.eye = kViewMargin / std::sin(glm::radians(kViewFovDeg / 2)) * direction;
  camera.forward = -direction;
  camera.fov_y_deg = kViewFovDeg;
  camera.near = kNearPlane;
  return camera;
}

double height_of(std::size_t i, std::size_t n) {
  if (n == 1) return std::sin(glm::radians(kFirstElevationDeg));
  return 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n);
}

// The highest of those nearest in elevation.
std::size_t find_first(std::size_t n) {
  std::size_t best = 0;
  const auto distance = [n](std::size_t i) {
    return std::abs(std::asin(height_of(i, n)) - glm::radians(kFirstElevationDeg));
  };
  for (std::size_t i = 1; i < n; ++i)
    if (distance(i) < distance(best)) best = i;
  return best;
}

}  // namespace

Box box_of_triangles(const TriMesh& mesh) {
  Box box;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) box.add(mesh.positions[v]);
  return box;
}

Box parse_box(const std::string& text) {
  Box box;
  char rest = 0;
  const int n = std::sscanf(text.c_str(), "%lf,%lf,%lf:%lf,%lf,%lf%c", &box.lo.x, &box.lo.y,
                            &box.lo.z, &box.hi.x, &box.hi.y, &box.hi.z, &rest);
  bool is_box = n == 6;
  for (int k = 0; k < 3; ++k)
    is_box =
        is_box && std::isfinite(box.lo[k]) && std::isfinite(box.hi[k]) && box.lo[k] <= box.hi[k];
  if (!is_box) throw UsageError("box '" + text + "' is not x0,y0,z0:x1,y1,z1, low to high");
  return box;
}

std::string up_axis_of(const std::filesystem::path& mesh_file) {
  std::string extension = mesh_file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".obj" || extension == ".glb" || extension == ".gltf" ? "y" : "z";
}

MeshFrame make_frame(const Box& box, const std::string& up, const std::string& source) {
  const double radius = 0.5 * glm::length(box.size());
  if (!(radius > 0)) throw InputError(source, "", "has no extent: its triangles are one point");
  return {box.centre(), radius, up};
}

glm::dvec3 frame_from_mesh(const MeshFrame& frame, const glm::dvec3& point) {
  return turn_of(frame) * ((point - frame.centre) / frame.radius);
}

glm::dvec3 mesh_from_frame(const MeshFrame& frame, const glm::dvec3& point_frame) {
  return frame.centre + frame.radius * mesh_from_frame_direction(frame, point_frame);
}

glm::dvec3 mesh_from_frame_direction(const MeshFrame& frame, const glm::dvec3& direction_frame) {
  return glm::transpose(turn_of(frame)) * direction_frame;
}

double measure_reach(const TriMesh& mesh, const MeshFrame& frame) {
  double reach = 0;
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t)
      reach = std::max(reach, glm::distance(glm::dvec3(mesh.positions[v]), frame.centre));
  return reach / frame.radius;
}

std::vector<Camera> make_views(std::size_t n) {
  VIEWCELL_CHECK(n >= 1 && n <= kMostViews, n);
  const double golden_rad = glm::pi<double>() * (3 - std::sqrt(5.0));
  const std::size_t first = find_first(n);
  const double turn_rad =
      glm::radians(kFrontAzimuthDeg + kFirstAzimuthDeg) - golden_rad * static_cast<double>(first);
  const auto view = [&](std::size_t i) {
    return make_view(direction_of(height_of(i, n), turn_rad + golden_rad * static_cast<double>(i)));
  };
  std::vector<Camera> views{view(first)};
  for (std::size_t i = 0; i < n; ++i)
    if (i != first) views.push_back(view(i));
  return views;
}

ViewAngles angles_of(const Camera& view) {
  const glm::dvec3 d = -view.forward;
  double azimuth_deg = glm::degrees(std::atan2(d.y, d.x)) - kFrontAzimuthDeg;
  if (azimuth_deg > 180) azimuth_deg -= 360;
  return {glm::degrees(std::asin(std::clamp(d.z, -1.0, 1.0))), azimuth_deg};
}

glm::dmat3 turn_eye_to_front(const Camera& view) {
  const double angle_rad = -glm::radians(angles_of(view).azimuth_deg);
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {glm::dvec3(c, s, 0), glm::dvec3(-s, c, 0), glm::dvec3(0, 0, 1)};
}

}  // namespace viewcell

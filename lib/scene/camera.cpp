#include "scene/camera.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace viewcell {
namespace {

constexpr const char* kPathFormat = "viewcell-path";
constexpr double kMostVertical = 0.999;  // |forward.z| beyond which "up" is undefined

glm::dvec3 vec3_at(const JsonCursor& cursor) {
  const std::vector<double> x = cursor.numbers(3, -1e9, 1e9);
  return {x[0], x[1], x[2]};
}

PathSample read_sample(const JsonCursor& cursor, Remarks* remarks) {
  constexpr const char* kKeys[] = {"time_s", "eye", "forward"};
  remark_unknown_keys(cursor, "a sample", kKeys, remarks);
  PathSample sample;
  sample.time_s = cursor.at("time_s").number(0, 1e9);
  sample.eye = vec3_at(cursor.at("eye"));
  const glm::dvec3 forward = vec3_at(cursor.at("forward"));
  const double length = glm::length(forward);
  if (!(length > 1e-9)) cursor.at("forward").fail("has no length");
  sample.forward = forward / length;
  if (std::abs(sample.forward.z) > kMostVertical) cursor.at("forward").fail("is vertical");
  return sample;
}

glm::dvec3 interpolate_direction(const glm::dvec3& a, const glm::dvec3& b, double t) {
  const double angle = std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
  if (angle < 1e-9) return a;
  const double s = std::sin(angle);
  if (s < 1e-9) return t < 0.5 ? a : b;  // opposite: no arc between them
  return glm::normalize((std::sin((1 - t) * angle) * a + std::sin(t * angle) * b) / s);
}

}  // namespace

glm::dmat4 view_from_world(const Camera& camera) {
  const auto [right, up] = picture_axes(camera.forward);
  const glm::dmat3 rows(right, up, -camera.forward);  // columns; transposed below
  glm::dmat4 view(glm::transpose(rows));
  view[3] = glm::dvec4(-(glm::transpose(rows) * camera.eye), 1);
  return view;
}

glm::dmat4 clip_from_view(const Camera& camera) {
  const double f = 1 / std::tan(glm::radians(camera.fov_y_deg) / 2);
  glm::dmat4 clip(0);
  clip[0][0] = f / camera.aspect;
  clip[1][1] = f;
  clip[2][3] = -1;
  clip[3][2] = camera.near;
  return clip;
}

Camera with_frame(Camera camera, double fov_y_deg, double aspect) {
  const auto corner = [](double fov_deg, double shape) {
    const double half = std::tan(glm::radians(fov_deg) / 2);
    return std::sqrt(1 + half * half * (1 + shape * shape));
  };
  camera.fov_y_deg = fov_y_deg, camera.aspect = aspect;
  camera.near *= std::min(1.0, corner(kFovYDeg, 1) / corner(fov_y_deg, aspect));
  return camera;
}

bool is_view_frame(const glm::dvec3& right, const glm::dvec3& up, const glm::dvec3& forward) {
  constexpr double kRounding = 1e-6;
  const auto is_unit = [](const glm::dvec3& v) {
    return std::abs(glm::length(v) - 1) <= kRounding;
  };
  return is_unit(right) && is_unit(up) && is_unit(forward) &&
         std::abs(glm::dot(right, up)) <= kRounding &&
         glm::length(glm::cross(right, up) + forward) <= kRounding;
}

CameraPath read_path(const std::filesystem::path& file, Remarks* remarks) {
  constexpr const char* kKeys[] = {"format", "version", "made_by", "fov_y_deg", "samples"};
  const Json json = read_json(file, kPathFormat, 1);
  const JsonCursor root(json, file);
  remark_unknown_keys(root, "the path", kKeys, remarks);
  const JsonCursor samples = root.at("samples");
  const std::size_t n = samples.size();
  if (n == 0) samples.fail("is empty");
  CameraPath path;
  if (root.has("fov_y_deg"))
    path.fov_y_deg = root.at("fov_y_deg").number(kLeastFovYDeg, kMostFovYDeg);
  for (std::size_t i = 0; i < n; ++i) {
    path.samples.push_back(read_sample(samples.at(i), remarks));
    if (i > 0 && !(path.samples[i].time_s > path.samples[i - 1].time_s))
      samples.at(i).at("time_s").fail("is not later than the sample before");
  }
  return path;
}

Json format_path(const CameraPath& path, const Json& provenance) {
  Json samples = Json::array();
  for (const PathSample& s : path.samples)
    samples.push_back({{"time_s", s.time_s},
                       {"eye", {s.eye.x, s.eye.y, s.eye.z}},
                       {"forward", {s.forward.x, s.forward.y, s.forward.z}}});
  return {{"format", kPathFormat},
          {"version", 1},
          {"made_by", provenance},
          {"fov_y_deg", path.fov_y_deg},
          {"samples", samples}};
}

std::vector<Camera> sample_path(const CameraPath& path, std::size_t n) {
  VIEWCELL_CHECK(!path.samples.empty());
  const double start = path.samples.front().time_s;
  const double step = n > 1 ? (path.samples.back().time_s - start) / static_cast<double>(n - 1) : 0;
  std::vector<Camera> cameras(n);
  std::size_t at = 0;  // the sample at or before the time
  for (std::size_t i = 0; i < n; ++i) {
    const double time_s = start + step * static_cast<double>(i);
    while (at + 2 < path.samples.size() && path.samples[at + 1].time_s <= time_s) ++at;
    const PathSample& a = path.samples[at];
    const PathSample& b = path.samples[std::min(at + 1, path.samples.size() - 1)];
    const double span = b.time_s - a.time_s;
    const double t = span > 0 ? std::clamp((time_s - a.time_s) / span, 0.0, 1.0) : 0;
    cameras[i].fov_y_deg = path.fov_y_deg;
    cameras[i].eye = glm::mix(a.eye, b.eye, t);
    cameras[i].forward = interpolate_direction(a.forward, b.forward, t);
  }
  return cameras;
}

}  // namespace viewcell

#include "capture/view.h"

#include <algorithm>
#include <cmath>

#include "cells/self_occluding.h"
#include "scene/camera.h"

namespace viewcell {
namespace {

// A far object's source image has as many pixels and a narrower angle.
double focal_of(const glm::dvec3& eye, std::span<const glm::dvec3> points,
                const CaptureDensity& density) {
  const double focal = focal_of_face(density.resolution_px);
  const double squared = density.far_distance * density.far_distance;
  const bool is_far = std::all_of(points.begin(), points.end(), [&](const glm::dvec3& p) {
    return glm::dot(p - eye, p - eye) > squared;
  });
  return is_far ? density.far_scale * focal : focal;
}

CaptureView make_view(const glm::dvec3& eye, const glm::dvec3& forward, double focal_px,
                      int resolution_px) {
  CaptureView view;
  view.eye = eye;
  view.forward = forward;
  const PictureAxes axes = picture_axes(forward);
  view.right = axes.right, view.up = axes.up;
  view.focal_px = focal_px;
  view.source_px = resolution_px;
  return view;
}

// The cosine of the largest angle between the axis and a point.
double least_cosine(const CaptureView& view, std::span<const glm::dvec3> points) {
  double least = 1;
  for (const glm::dvec3& p : points) {
    const glm::dvec3 d = p - view.eye;
    const double length = glm::length(d);
    least = std::min(least, length > 0 ? glm::dot(d, view.forward) / length : -1.0);
  }
  return least;
}

Crop crop_of(const CaptureView& view, std::span<const glm::dvec3> points) {
  glm::dvec2 lo(1e300), hi(-1e300);
  for (const glm::dvec3& p : points) {
    const glm::dvec2 at(view.project(p));
    lo = glm::min(lo, at);
    hi = glm::max(hi, at);
  }
  Crop crop;
  crop.x = static_cast<int>(std::floor(lo.x)) - kCropMargin_px;
  crop.y = static_cast<int>(std::floor(lo.y)) - kCropMargin_px;
  crop.width_px = static_cast<int>(std::ceil(hi.x)) + kCropMargin_px - crop.x;
  crop.height_px = static_cast<int>(std::ceil(hi.y)) + kCropMargin_px - crop.y;
  return crop;
}

glm::dvec3 middle_of(std::span<const glm::dvec3> points) {
  glm::dvec3 lo(1e300), hi(-1e300);
  for (const glm::dvec3& p : points) lo = glm::min(lo, p), hi = glm::max(hi, p);
  return 0.5 * (lo + hi);
}

}  // namespace

std::optional<ViewedObject> choose_view(const glm::dvec3& eye, std::span<const glm::dvec3> points,
                                        const CaptureDensity& density) {
  if (points.empty()) return {};
  const glm::dvec3 toward = middle_of(points) - eye;
  const double azimuth_deg = glm::degrees(std::atan2(toward.y, toward.x));
  const double face_rad = glm::radians(60 * std::floor(azimuth_deg / 60) + 30);
  const double focal_px = focal_of(eye, points, density);
  CaptureView view =
      make_view(eye, {std::cos(face_rad), std::sin(face_rad), 0}, focal_px, density.resolution_px);
  if (least_cosine(view, points) < std::cos(glm::radians(kTurnDeg))) {
    const double length = glm::length(toward);
    if (!(length > 0) || std::abs(toward.z) > 0.99 * length) return {};
    view = make_view(eye, toward / length, focal_px, density.resolution_px);
    if (least_cosine(view, points) < std::cos(glm::radians(kMostDeg))) return {};
  }
  Crop crop = crop_of(view, points);
  const double area_px = static_cast<double>(crop.width_px) * crop.height_px;
  if (area_px > density.most_px) {
    view.focal_px *= std::sqrt(density.most_px / area_px);
    crop = crop_of(view, points);
  }
  return ViewedObject{view, crop};
}

}  // namespace viewcell

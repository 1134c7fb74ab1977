// The camera of a capture: an eye, and the image plane that one object is projected onto.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

namespace viewcell {

/// A pinhole with a plane. Image x runs right, y down, in pixels of a square source image of
/// source_px per side whose middle lies on the axis; pixel centres at +0.5.
struct CaptureView {
  glm::dvec3 eye{0};
  glm::dvec3 right{0, -1, 0};
  glm::dvec3 up{0, 0, 1};
  glm::dvec3 forward{1, 0, 0};
  double focal_px = 1;
  int source_px = 0;

  /// (x px, y px, depth along forward). The depth must be positive for x and y to mean anything.
  glm::dvec3 project(const glm::dvec3& world) const {
    const glm::dvec3 d = world - eye;
    const double depth = glm::dot(d, forward), half = 0.5 * source_px;
    return {half + focal_px * glm::dot(d, right) / depth, half - focal_px * glm::dot(d, up) / depth,
            depth};
  }
  /// The direction through an image point, with 1 along forward: eye + depth * ray is the point.
  glm::dvec3 ray(double x_px, double y_px) const {
    const double half = 0.5 * source_px;
    return forward + ((x_px - half) / focal_px) * right + ((half - y_px) / focal_px) * up;
  }
};

/// A crop: the rectangle of pixels that holds one object; may reach out of the source image on any
/// side.
struct Crop {
  int x = 0, y = 0, width_px = 0, height_px = 0;
};

struct ViewedObject {
  CaptureView view;
  Crop crop;
};

/// Angle between the axis and an object's farthest point beyond which the plane is turned to the
/// object, and beyond which even that plane cannot hold it. At 60 degrees a pixel of the plane is a
/// quarter of one in the middle, by area times cosine.
inline constexpr double kTurnDeg = 60;
inline constexpr double kMostDeg = 78;
/// Pixels around the object's projection, for bilinear fetches and simplified rims.
inline constexpr int kCropMargin_px = 3;

/// How densely a centre samples what it sees.
struct CaptureDensity {
  int resolution_px = 1024;   ///< per width of a side face [Chen06 5.2.1]
  double far_scale = 2;       ///< times that density for far objects (1: as the paper)
  double far_distance = 300;  ///< an object is far when its nearest point is farther
  /// Pixels that one object's crop may have: an object very close to the eye is sampled more
  /// coarsely, since the frames that it is captured for are drawn from farther away.
  int most_px = 1 << 20;
};

/// The view of an object (its points in the world) from an eye: on the plane of the side face that
/// the middle of its points lies behind, at the given density; or, when it
/// reaches more than kTurnDeg from that face's axis, on a plane turned to its middle, at the same
/// density there. Nothing when it reaches more than kMostDeg from that axis too: the eye
/// is then inside the object or all but touches it.
std::optional<ViewedObject> choose_view(const glm::dvec3& eye, std::span<const glm::dvec3> points,
                                        const CaptureDensity& density);

}  // namespace viewcell

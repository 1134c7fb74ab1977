// What one run of the player measured, frame by frame.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "image/image.h"
#include "play/modes.h"
#include "play/stand_in.h"

namespace viewcell {

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// How close a picture is to the reference's (image/metrics.h). NaN: not compared.
struct PictureQuality {
  double psnr_db = kNotMeasured, psnr_covered_db = kNotMeasured;
  double mse = kNotMeasured, mse_covered = kNotMeasured;
  std::size_t n_covered_px = 0;  ///< pixels where either shows an object
  std::size_t missing_px = 0;    ///< pixels where the reference shows an object and this does not
};

/// Sizes must agree.
PictureQuality measure_quality(const ImageRgba8& reference, const ImageRgba8& tested);

/// One frame in one mode.
struct FrameRecord {
  double ms = 0;
  std::size_t n_triangles = 0;
  std::size_t n_draws = 0;
  std::size_t texture_bytes = 0;
  PictureQuality quality;
  StandIn stand_in = StandIn::none;  ///< of mode hybrid
};

/// What a frame is, whatever draws it.
struct FrameInfo {
  double time_s = 0;               ///< along the path
  int cell = -1;                   ///< the view cell of the eye; -1: none
  double coverage = kNotMeasured;  ///< share of the reference's pixels that show an object
  PictureQuality yardstick;  ///< the reference against itself shifted by half a pixel in x and y
  /// Standard deviation of the reference's luminance over pixels that show an object, of 255: flat
  /// lighting would flatter every dB.
  double luminance_deviation = kNotMeasured;
};

struct ModeTimeline {
  Mode mode{};
  std::vector<FrameRecord> frames;  ///< one for each of Timeline::frames
};

struct Timeline {
  int width_px = 0, height_px = 0;
  std::string renderer;
  int gl_threads = 0;
  int n_threads = 0;               ///< of modes that draw without GL
  Mode reference = Mode::frustum;  ///< that the others are compared with
  std::vector<FrameInfo> frames;
  std::vector<ModeTimeline> modes;
  std::vector<BundleFault> faults = {};  ///< of the bundle's files that were needed
  std::vector<double> floor_ms;  ///< of FloorQuad, interleaved with the frames; may be empty
};

/// Frames of mode hybrid, where it was played, with that stand-in.
std::size_t count_stand_ins(const Timeline& timeline, StandIn stand_in);

/// Share of pixels that show an object.
double measure_coverage(const ImageRgba8& picture);
/// See FrameInfo; NaN when no pixel shows an object.
double measure_luminance_deviation(const ImageRgba8& picture);

}  // namespace viewcell

#include "play/timeline.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/metrics.h"
#include "image/ssim.h"

namespace viewcell {
namespace {

bool is_object(const Rgba8& pixel) {
  return pixel[3] > 0;
}

}  // namespace

PictureQuality measure_quality(const ImageRgba8& reference, const ImageRgba8& tested) {
  CompareOptions options;
  options.ssim = false;
  const ImageDistance d = compare_images(reference, tested, options);
  std::size_t missing = 0;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i)
    missing += is_object(reference.pixels[i]) && !is_object(tested.pixels[i]);
  return {d.psnr_db, d.psnr_covered_db, d.mse, d.mse_covered, d.n_covered, missing};
}

std::size_t count_stand_ins(const Timeline& timeline, StandIn stand_in) {
  std::size_t n = 0;
  for (const ModeTimeline& mode : timeline.modes)
    if (mode.mode == Mode::hybrid)
      for (const FrameRecord& frame : mode.frames) n += frame.stand_in == stand_in;
  return n;
}

double measure_coverage(const ImageRgba8& picture) {
  VIEWCELL_CHECK(!picture.empty());
  const auto n = std::count_if(picture.pixels.begin(), picture.pixels.end(), is_object);
  return static_cast<double>(n) / static_cast<double>(picture.pixels.size());
}

double measure_luminance_deviation(const ImageRgba8& picture) {
  const Image<double> y = luminance(picture);
  double n = 0, sum = 0, squares = 0;
  for (std::size_t i = 0; i < y.pixels.size(); ++i) {
    if (!is_object(picture.pixels[i])) continue;
    ++n, sum += y.pixels[i], squares += y.pixels[i] * y.pixels[i];
  }
  if (n == 0) return kNotMeasured;
  return std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n)));
}

}  // namespace viewcell

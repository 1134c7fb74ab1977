#include "play/timeline.h"

#include <algorithm>

#include "base/error.h"
#include "image/metrics.h"

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

double measure_coverage(const ImageRgba8& picture) {
  VIEWCELL_CHECK(!picture.empty());
  const auto n = std::count_if(picture.pixels.begin(), picture.pixels.end(), is_object);
  return static_cast<double>(n) / static_cast<double>(picture.pixels.size());
}

}  // namespace viewcell

#include "image/compare_index_maps.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace viewcell {

IndexMapDistance compare_index_maps(const IndexMap& reference, const IndexMap& tested,
                                    const CompareIndexMapsOptions& options) {
  const int width = reference.width_px, height = reference.height_px;
  VIEWCELL_CHECK(tested.width_px == width && tested.height_px == height, tested.width_px, width,
                 tested.height_px, height);
  const Image<std::uint32_t>& counted = options.counted;
  VIEWCELL_CHECK(counted.empty() || (counted.width_px == width && counted.height_px == height),
                 counted.width_px, width, counted.height_px, height);
  IndexMapDistance out;
  double sum = 0;
  std::size_t n_within = 0;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    if (!counted.empty() && counted.pixels[i] == 0) continue;
    const glm::dvec2 apart = (glm::dvec2(tested.pixels[i]) - glm::dvec2(reference.pixels[i])) *
                             glm::dvec2(width, height);
    const double squared = glm::dot(apart, apart), distance = std::sqrt(squared);
    sum += squared;
    out.max_texels = std::max(out.max_texels, distance);
    n_within += distance <= options.within_texels;
    ++out.n_texels;
  }
  if (out.n_texels == 0) return out;
  const auto n = static_cast<double>(out.n_texels);
  out.rms_texels = std::sqrt(sum / n);
  out.share_within = static_cast<double>(n_within) / n;
  return out;
}

}  // namespace viewcell

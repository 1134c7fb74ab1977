#include "image/half.h"

#include "base/error.h"

namespace viewcell {

std::vector<std::uint16_t> half_from_rgba(const ImageRgbaFloat& image) {
  std::vector<std::uint16_t> halves(4 * image.pixels.size());
  for (std::size_t p = 0; p < image.pixels.size(); ++p)
    for (std::size_t c = 0; c < 4; ++c) halves[4 * p + c] = half_from_float(image.pixels[p][c]);
  return halves;
}

ImageRgbaFloat rgba_from_half(const std::vector<std::uint16_t>& halves, int width_px,
                              int height_px) {
  ImageRgbaFloat image(width_px, height_px);
  VIEWCELL_CHECK(halves.size() == 4 * image.pixels.size(), halves.size(), width_px, height_px);
  for (std::size_t p = 0; p < image.pixels.size(); ++p)
    for (std::size_t c = 0; c < 4; ++c) image.pixels[p][c] = float_from_half(halves[4 * p + c]);
  return image;
}

}  // namespace viewcell
